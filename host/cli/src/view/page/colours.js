// Pressure as colour: cividis, which is readable with any colour vision and grows evenly in lightness.

/** @type {[import("./types.d.ts").Triple, ...import("./types.d.ts").Triple[]]} */
const STOPS = [
  [0, 34, 78],
  [18, 53, 112],
  [59, 73, 108],
  [87, 93, 109],
  [112, 113, 115],
  [138, 134, 120],
  [165, 156, 116],
  [195, 179, 105],
  [225, 204, 85],
  [254, 232, 56],
];
const SIZE = 256;

/** Red, green and blue of SIZE steps. */
export const RAMP = Array.from({ length: SIZE }, (_, step) => {
  const at = (step / (SIZE - 1)) * (STOPS.length - 1);
  const low = Math.min(Math.floor(at), STOPS.length - 2);
  const [from = STOPS[0], to = from] = STOPS.slice(low, low + 2);
  const part = (/** @type {0 | 1 | 2} */ which) => Math.round(from[which] + (to[which] - from[which]) * (at - low));
  return /** @type {import("./types.d.ts").Triple} */ ([part(0), part(1), part(2)]);
});

/** The steps as pixels of ImageData (little-endian ABGR). */
export const PIXELS = new Uint32Array(RAMP.map(([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0));

/**
 * Step of a pressure on a scale that ends at `top`.
 * @param {number} value
 * @param {number} top
 */
export const stepOf = (value, top) => Math.max(0, Math.min(SIZE - 1, Math.round((value / top) * (SIZE - 1))));

/**
 * CSS colour of a share of the scale, 0 to 1.
 * @param {number} share
 */
export const css = (share) => `rgb(${(RAMP[stepOf(share, 1)] ?? []).join(" ")})`;

/** Equal bands of the scale: contours separate them, and the histogram counts them. */
export const BANDS = 5;
/**
 * @param {number} value
 * @param {number} top
 */
export const bandOf = (value, top) => Math.min(BANDS - 1, Math.floor((value / top) * BANDS));
