// Pressure as colour. The program says which colours, and how far the scale reaches: see palette.rs.

/**
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {import("./types.d.ts").Palette} Palette
 */

/**
 * The palette of the program; empty before its first message.
 * @type {Palette & { pixels: Uint32Array }}
 */
export const palette = { ramp: [], bands: 1, start: 0, ends: [1, 1], intentions: {}, feeling: "", pixels: new Uint32Array(0) };

/** Grey where it is not known what presses: no colour of the ramp. */
export const GREY = 0.45;
/** The robot that carries the garment. */
export const ROBOT = 0.72;

/**
 * Takes the palette.
 * @param {Palette} given
 */
export function take(given) {
  // As pixels of ImageData: little-endian ABGR.
  const pixels = given.ramp.map(([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0);
  Object.assign(palette, given, { pixels: Uint32Array.from(pixels) });
}

/**
 * Step of a pressure on a scale that ends at `top`.
 * @param {number} value
 * @param {number} top
 */
export function stepOf(value, top) {
  const last = palette.ramp.length - 1;
  return Math.max(0, Math.min(last, Math.round((value / top) * last)));
}

/**
 * CSS colour of a share of the scale, 0 to 1.
 * @param {number} share
 */
export const css = (share) => `rgb(${(palette.ramp[stepOf(share, 1)] ?? []).join(" ")})`;

/**
 * Band of a pressure: contours separate them, and the histogram counts them.
 * @param {number} value
 * @param {number} top
 */
export const bandOf = (value, top) => Math.min(palette.bands - 1, Math.floor((value / top) * palette.bands));
