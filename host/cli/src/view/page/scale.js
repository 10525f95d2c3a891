// The scale of pressure below the picture.

import { $, colour, fit, say } from "./dom.js";
import { css } from "./colours.js";
import { isPascal, pressure } from "./units.js";

/** Width below which there is no label in the middle. */
const ROOM = 280;
const HEIGHT = 28;

/** Draws the scale. */
export function draw(store, settings) {
  const { garment } = store;
  const context = garment && fit($("ramp"));
  if (!context) return;
  const { clientWidth: width } = $("ramp");
  context.clearRect(0, 0, width, HEIGHT);
  for (let x = 0; x < width; x += 1) {
    context.fillStyle = css(x / width);
    context.fillRect(x, 0, 1, 12);
  }
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "bottom";
  context.fillStyle = colour("ink");
  const labels = [
    [0, "left"],
    [0.5, "center"],
    [1, "right"],
  ];
  for (const [share, align] of width < ROOM ? [labels[0], labels[2]] : labels) {
    context.textAlign = align;
    const text = pressure(garment, settings.top * share);
    context.fillText(share === 1 ? `${text} and more` : text, width * share, HEIGHT);
  }
  say($("unit"), isPascal(garment) ? "kPa" : "counts");
}
