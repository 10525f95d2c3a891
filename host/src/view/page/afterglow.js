// What was felt a moment ago and is not felt any more: a touch of 61 ms is seen for most of a second.

/** Seconds in which it fades. */
export const FADE_S = 0.8;

/**
 * Of each taxel the greatest of what was felt, less the longer ago it was. `images` are [values, age in seconds]; `into` is
 * filled and given back.
 */
export function afterglow(images, into) {
  into.fill(0);
  for (const [values, age] of images) {
    const left = 1 - age / FADE_S;
    if (left <= 0 || age < 0) continue;
    for (let taxel = 0; taxel < into.length; taxel += 1) {
      const glow = values[taxel] * left;
      if (glow > into[taxel]) into[taxel] = glow;
    }
  }
  return into;
}

/** How opaque a taxel's glow is, 0 to 1: what it is above the pressure that is there, by the scale's end. */
export function opacity(glow, value, top) {
  const share = (glow - value) / top;
  return share < 0.04 ? 0 : Math.min(0.9, Math.sqrt(share));
}
