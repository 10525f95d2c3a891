// A panel as pixels: one per taxel, or several with the pressure interpolated.

import { contextOf } from "./dom.js";
import { palette, stepOf } from "./colours.js";

/** Pixels per taxel if interpolated. */
const FINE = 6;
/** Colour of the afterglow, which is not on the scale (ABGR without A): #ff6f91. */
const GLOW = 0x916fff;

/** Draws panels into a small canvas of its own, which is then enlarged. */
export class Raster {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.context = contextOf(this.canvas);
    /** @type {ImageData | null} */
    this.data = null;
    this.pixels = new Uint32Array(0);
  }

  /**
   * @param {number} width
   * @param {number} height
   */
  size(width, height) {
    const { canvas } = this;
    if (this.data && canvas.width === width && canvas.height === height) return;
    Object.assign(canvas, { width, height });
    this.data = this.context.createImageData(width, height);
    this.pixels = new Uint32Array(this.data.data.buffer);
  }

  /**
   * Returns the canvas with a panel of an image; absent taxels are transparent.
   * @param {ArrayLike<number>} image
   * @param {import("./types.d.ts").Panel} panel
   * @param {{ top: number, smooth: boolean, absent: Uint8Array }} how
   */
  paint(image, panel, { top, smooth, absent }) {
    const { rows, columns, base } = panel;
    const fine = smooth ? FINE : 1;
    this.size(columns * fine, rows * fine);
    if (smooth) interpolate(this.pixels, image, panel, top);
    else
      for (let at = 0; at < rows * columns; at += 1)
        this.pixels[at] = palette.pixels[stepOf(image[base + at] ?? 0, top)] ?? 0;
    this.clear(panel, absent, fine);
    if (this.data) this.context.putImageData(this.data, 0, 0);
    return this.canvas;
  }

  /**
   * Returns the canvas with the glow above the present pressure; transparent elsewhere.
   * @param {ArrayLike<number>} glow
   * @param {ArrayLike<number>} image
   * @param {import("./types.d.ts").Panel} panel
   * @param {number} top
   * @param {(glow: number, value: number, top: number) => number} opacity
   */
  shine(glow, image, { rows, columns, base }, top, opacity) {
    this.size(columns, rows);
    for (let at = 0; at < rows * columns; at += 1) {
      const alpha = Math.round(opacity(glow[base + at] ?? 0, image[base + at] ?? 0, top) * 255);
      this.pixels[at] = ((alpha << 24) | GLOW) >>> 0;
    }
    if (this.data) this.context.putImageData(this.data, 0, 0);
    return this.canvas;
  }

  /**
   * @param {import("./types.d.ts").Panel} panel
   * @param {Uint8Array} absent
   * @param {number} fine
   */
  clear({ rows, columns, base }, absent, fine) {
    for (let at = 0; at < rows * columns; at += 1) {
      if (!absent[base + at]) continue;
      const [row, column] = [Math.floor(at / columns), at % columns];
      for (let y = row * fine; y < (row + 1) * fine; y += 1) {
        const start = y * columns * fine + column * fine;
        this.pixels.fill(0, start, start + fine);
      }
    }
  }
}

/**
 * Bilinear between the centres of taxels; beyond the outermost, their own pressure.
 * @param {Uint32Array} pixels
 * @param {ArrayLike<number>} image
 * @param {import("./types.d.ts").Panel} panel
 * @param {number} top
 */
function interpolate(pixels, image, { rows, columns, base }, top) {
  const width = columns * FINE;
  const clampRow = (/** @type {number} */ row) => Math.max(0, Math.min(rows - 1, row));
  const clampColumn = (/** @type {number} */ column) => Math.max(0, Math.min(columns - 1, column));
  for (let y = 0; y < rows * FINE; y += 1) {
    const v = (y + 0.5) / FINE - 0.5;
    const above = Math.floor(v);
    const [upper, lower] = [base + clampRow(above) * columns, base + clampRow(above + 1) * columns];
    const down = v - above;
    for (let x = 0; x < width; x += 1) {
      const u = (x + 0.5) / FINE - 0.5;
      const before = Math.floor(u);
      const [left, right] = [clampColumn(before), clampColumn(before + 1)];
      const share = u - before;
      const high = (image[upper + left] ?? 0) * (1 - share) + (image[upper + right] ?? 0) * share;
      const below = (image[lower + left] ?? 0) * (1 - share) + (image[lower + right] ?? 0) * share;
      pixels[y * width + x] = palette.pixels[stepOf(high * (1 - down) + below * down, top)] ?? 0;
    }
  }
}
