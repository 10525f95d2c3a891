// The scale of pressure below the picture.

import { $, colour, fit, one, say } from "./dom.js";
import { css } from "./colours.js";
import { isPascal, pressure } from "./units.js";

/** Width below which there is no label in the middle. */
const ROOM = 280;
const HEIGHT = 28;

/** Last drawing: it changes seldom, and a canvas that is drawn again costs as much as if it had changed. */
let drawn = "";

/**
 * Draws the scale.
 * @param {import("./store.js").Store} store
 * @param {import("./types.d.ts").Settings} settings
 */
export function draw({ garment }, { top }) {
  if (!garment) return;
  const labels = /** @type {const} */ ([
    [0, "left"],
    [0.5, "center"],
    [1, "right"],
  ]).map(([share, align]) => ({ share, align, text: pressure(garment, top * share) }));
  const canvas = one(HTMLCanvasElement, "ramp");
  const { clientWidth: width } = canvas;
  const { theme } = document.documentElement.dataset;
  const key = [width, theme, ...labels.map(({ text }) => text)].join();
  const context = key !== drawn && fit(canvas);
  if (!context) return;
  drawn = key;
  context.clearRect(0, 0, width, HEIGHT);
  for (let x = 0; x < width; x += 1) {
    context.fillStyle = css(x / width);
    context.fillRect(x, 0, 1, 12);
  }
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "bottom";
  context.fillStyle = colour("ink");
  for (const { share, align, text } of labels.filter(({ share }) => share !== 0.5 || width >= ROOM)) {
    context.textAlign = align;
    context.fillText(share === 1 ? `${text} and more` : text, width * share, HEIGHT);
  }
  say($("unit"), isPascal(garment) ? "kPa" : "counts");
}
