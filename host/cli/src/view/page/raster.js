// A panel as pixels: one per taxel, or several with the pressure interpolated.

import { PIXELS, stepOf } from "./colours.js";

/** Pixels per taxel if interpolated. */
const FINE = 6;
/** Colour of the afterglow, which is not on the scale (ABGR without A): #ff6f91. */
const GLOW = 0x916fff;

/** Draws panels into a small canvas of its own, which is then enlarged. */
export class Raster {
  constructor() {
    this.canvas = document.createElement("canvas");
    // Filled by the processor.
    this.context = this.canvas.getContext("2d", { willReadFrequently: true });
    this.data = null;
  }

  size(width, height) {
    const { canvas } = this;
    if (this.data && canvas.width === width && canvas.height === height) return;
    Object.assign(canvas, { width, height });
    this.data = this.context.createImageData(width, height);
    this.pixels = new Uint32Array(this.data.data.buffer);
  }

  /** Returns the canvas with a panel of an image; absent taxels are transparent. */
  paint(image, panel, { top, smooth, absent }) {
    const { rows, columns, base } = panel;
    const fine = smooth ? FINE : 1;
    this.size(columns * fine, rows * fine);
    if (smooth) interpolate(this.pixels, image, panel, top);
    else for (let at = 0; at < rows * columns; at += 1) this.pixels[at] = PIXELS[stepOf(image[base + at], top)];
    this.clear(panel, absent, fine);
    this.context.putImageData(this.data, 0, 0);
    return this.canvas;
  }

  /** Returns the canvas with the glow above the present pressure; transparent elsewhere. */
  shine(glow, image, { rows, columns, base }, top, opacity) {
    this.size(columns, rows);
    for (let at = 0; at < rows * columns; at += 1) {
      const alpha = Math.round(opacity(glow[base + at], image[base + at], top) * 255);
      this.pixels[at] = ((alpha << 24) | GLOW) >>> 0;
    }
    this.context.putImageData(this.data, 0, 0);
    return this.canvas;
  }

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

/** Bilinear between the centres of taxels; beyond the outermost, their own pressure. */
function interpolate(pixels, image, { rows, columns, base }, top) {
  const width = columns * FINE;
  const clampRow = (row) => Math.max(0, Math.min(rows - 1, row));
  const clampColumn = (column) => Math.max(0, Math.min(columns - 1, column));
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
      const high = image[upper + left] * (1 - share) + image[upper + right] * share;
      const below = image[lower + left] * (1 - share) + image[lower + right] * share;
      pixels[y * width + x] = PIXELS[stepOf(high * (1 - down) + below * down, top)];
    }
  }
}
