// Afterglow of recent pressure: a touch of 61 ms stays visible for most of a second.

/** Fade time, seconds. */
export const FADE_S = 0.8;

/**
 * Returns for each taxel the greatest recent pressure, fading with its age. `images` are [values, age in seconds];
 * `into` is filled and returned.
 * @param {[ArrayLike<number>, number][]} images
 * @param {Float32Array} into
 */
export function afterglow(images, into) {
  into.fill(0);
  for (const [values, age] of images) {
    const left = 1 - age / FADE_S;
    if (left <= 0 || age < 0) continue;
    for (let taxel = 0; taxel < into.length; taxel += 1) {
      const glow = (values[taxel] ?? 0) * left;
      if (glow > (into[taxel] ?? 0)) into[taxel] = glow;
    }
  }
  return into;
}

/**
 * Opacity of a taxel's glow, 0 to 1: its excess over the present pressure, relative to the scale's end.
 * @param {number} glow
 * @param {number} value
 * @param {number} top
 */
export function opacity(glow, value, top) {
  const share = (glow - value) / top;
  return share < 0.04 ? 0 : Math.min(0.9, Math.sqrt(share));
}
