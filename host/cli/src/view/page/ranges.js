// Histogram of pressure: the number of taxels in each band between the contours.

import { bandOf, css, palette } from "./colours.js";
import { colour, fit } from "./dom.js";
import { isPascal, pascalsOf } from "./units.js";

/**
 * Number of taxels at or above `low` in each band.
 * @param {ArrayLike<number>} image
 * @param {number} low
 * @param {number} top
 * @returns {number[]}
 */
export function histogram(image, low, top) {
  const counts = new Array(palette.bands).fill(0);
  for (let taxel = 0; taxel < image.length; taxel += 1) {
    const value = image[taxel] ?? 0;
    if (value >= low) counts[bandOf(value, top)] += 1;
  }
  return counts;
}

/**
 * "1.3 – 2.7 kPa"; the last band has no upper end.
 * @param {import("./types.d.ts").Garment} garment
 * @param {number} band
 * @param {number} top
 */
function name(garment, band, top) {
  const pascal = isPascal(garment);
  const unit = pascal ? pascalsOf(garment) : 1;
  const text = (/** @type {number} */ at) => ((top * unit * at) / palette.bands).toFixed(pascal ? 1 : 0);
  const from = band === 0 ? (pascal ? (garment.low * unit).toFixed(1) : garment.low) : text(band);
  const end = band === palette.bands - 1 ? "and more" : `– ${text(band + 1)}`;
  return `${from} ${end}`;
}

/**
 * Draws the bands into a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {import("./store.js").Store} store
 * @param {import("./types.d.ts").Settings} settings
 */
export function draw(canvas, store, settings) {
  const shown = store.shown();
  const context = shown && fit(canvas);
  if (!context || !store.garment) return;
  const { garment } = store;
  const { clientWidth: width, clientHeight: height } = canvas;
  const image = settings.held && store.held ? store.held : shown.image;
  const counts = histogram(image, garment.low, settings.top);
  const most = Math.max(20, ...counts);
  const row = height / palette.bands;
  const [left, right] = [96, 34];
  context.clearRect(0, 0, width, height);
  context.font = "12px system-ui, sans-serif";
  context.textBaseline = "middle";
  counts.forEach((count, band) => {
    const middle = (palette.bands - 1 - band + 0.5) * row;
    context.textAlign = "left";
    context.fillStyle = colour("quiet");
    context.fillText(name(garment, band, settings.top), 0, middle);
    const room = width - left - right;
    context.fillStyle = colour("grid");
    context.fillRect(left, middle - row / 2 + 3, room, row - 6);
    context.fillStyle = css((band + 0.5) / palette.bands);
    context.fillRect(left, middle - row / 2 + 3, (room * count) / most, row - 6);
    context.textAlign = "right";
    context.fillStyle = colour("ink");
    context.fillText(String(count), width, middle);
  });
}
