// The live half minute: total force, intentions and marks. A click pauses at its time.

import { colour, fit } from "./dom.js";
import { KEPT_S } from "./store.js";
import * as strip from "./strip.js";
import { force } from "./units.js";

/**
 * Draws it into a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {import("./store.js").Store} store
 */
export function draw(canvas, store) {
  const { garment, latest } = store;
  const context = garment && latest && fit(canvas);
  if (!context) return;
  const { clientWidth: width, clientHeight: height } = canvas;
  const end = store.end();
  const x = (/** @type {number} */ time) => width * (1 - (end - time) / (KEPT_S * 1e6));
  const floor = height - strip.RIBBON - strip.LANE - strip.TIMES;
  context.clearRect(0, 0, width, height);
  context.font = "11px system-ui, sans-serif";
  strip.ruler(context, lines(width, store.paused), height);
  const columns = totals(store, x, width);
  const highest = columns.reduce((most, total) => Math.max(most, total), 1000);
  strip.area(context, columns, highest, floor);
  context.fillStyle = colour("quiet");
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillText(`total force, up to ${force(garment, highest)}`, 4, 2);
  strip.ribbon(context, intentions(store), x, floor + 3);
  strip.marks(context, store.marks, x, height - strip.TIMES - strip.LANE / 2);
  if (store.paused) strip.cursor(context, x((store.shown() ?? latest).head.frame.time_us), height - strip.TIMES);
}

/**
 * A line for every five seconds.
 * @param {number} width
 * @param {boolean} paused
 * @returns {[number, string, CanvasTextAlign][]}
 */
function lines(width, paused) {
  const step = KEPT_S / 6;
  return Array.from({ length: 7 }, (_, index) => {
    const second = index * step;
    const name = second ? `−${Number(second.toFixed(1))} s` : paused ? "paused" : "now";
    return [width * (1 - second / KEPT_S), name, index === 0 ? "right" : index === 6 ? "left" : "center"];
  });
}

/**
 * The greatest total of each pixel.
 * @param {import("./store.js").Store} store
 * @param {(time: number) => number} x
 * @param {number} width
 */
function totals(store, x, width) {
  const columns = new Float64Array(Math.ceil(width) + 1).fill(-1);
  const [first, end] = store.span();
  for (let number = first; number < end; number += 1) {
    const { samples } = store.at(number).head;
    for (let at = 0; at < samples.length; at += 2) {
      const column = Math.round(x(samples[at] ?? 0));
      if (column < 0 || column >= columns.length) continue;
      columns[column] = Math.max(columns[column] ?? -1, samples[at + 1] ?? 0);
    }
  }
  return columns;
}

/**
 * Periods in which one intention leads.
 * @param {import("./store.js").Store} store
 */
function intentions(store) {
  /** @type {[number, number, string][]} */
  const found = [];
  const [first, end] = store.span();
  for (let number = first; number < end; number += 1) {
    const { time_us: time, intent } = store.at(number).head.frame;
    const last = found.at(-1);
    if (last) last[1] = time;
    if (last?.[2] !== intent.leading) found.push([time, time, intent.leading]);
  }
  return found.filter(([, , leading]) => leading !== "none");
}
