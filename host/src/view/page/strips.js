// Total force and the leading intention over the last half minute.

import { colour, fit } from "./dom.js";
import { KEPT_S } from "./store.js";
import { force } from "./units.js";

/** Height of the ribbon of intentions, and of the line of seconds below it. */
const RIBBON = 22;
const SECONDS = 15;
/** Okabe and Ito's colours; the name stands in the ribbon besides. */
const INTENTIONS = { kindness: "#0072b2", threat: "#e69f00", attack: "#d55e00" };
const INK = { kindness: "#fff", threat: "#000", attack: "#fff" };

/** Draws both into a canvas. */
export function draw(canvas, store) {
  const context = store.latest && fit(canvas);
  if (!context) return;
  const { clientWidth: width, clientHeight: height } = canvas;
  const end = store.latest.head.frame.time_us;
  const x = (time) => width * (1 - (end - time) / (KEPT_S * 1e6));
  const floor = height - RIBBON - SECONDS;
  context.clearRect(0, 0, width, height);
  context.font = "11px system-ui, sans-serif";
  lines(context, width, height);
  const highest = totals(context, store, x, width, floor);
  context.fillStyle = colour("quiet");
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillText(`total force, up to ${force(store.garment, highest)}`, 4, 2);
  ribbon(context, store, x, floor + 3);
  if (store.paused) cursor(context, x(store.shown().head.frame.time_us), height - SECONDS);
}

/** A line for every five seconds. */
function lines(context, width, height) {
  context.textBaseline = "bottom";
  for (let second = 0; second <= KEPT_S; second += KEPT_S / 6) {
    const at = Math.round(width * (1 - second / KEPT_S)) - 0.5;
    context.fillStyle = colour("grid");
    context.fillRect(at, 0, 1, height - SECONDS);
    context.fillStyle = colour("quiet");
    context.textAlign = second === 0 ? "right" : second === KEPT_S ? "left" : "center";
    context.fillText(second ? `−${Number(second.toFixed(1))} s` : "now", at, height);
  }
}

/** The greatest total of each pixel as an area; the greatest of all, counts. */
function totals(context, store, x, width, floor) {
  const columns = new Float64Array(Math.ceil(width) + 1).fill(-1);
  let highest = 1000;
  const [first, end] = store.span();
  for (let number = first; number < end; number += 1) {
    const { samples } = store.at(number).head;
    for (let at = 0; at < samples.length; at += 2) {
      const column = Math.round(x(samples[at]));
      if (column < 0 || column >= columns.length) continue;
      columns[column] = Math.max(columns[column], samples[at + 1]);
      highest = Math.max(highest, samples[at + 1]);
    }
  }
  context.beginPath();
  let last = null;
  columns.forEach((total, column) => {
    if (total < 0) return;
    const y = floor - (total / highest) * (floor - 18);
    if (last === null) context.moveTo(column, floor);
    context.lineTo(column, y);
    last = column;
  });
  context.lineTo(last ?? 0, floor);
  context.closePath();
  context.globalAlpha = 0.25;
  context.fillStyle = colour("accent");
  context.fill();
  context.globalAlpha = 1;
  context.strokeStyle = colour("accent");
  context.lineWidth = 1.5;
  context.stroke();
  return highest;
}

/** Stretches of the same leading intention, each with its name where there is room. */
function ribbon(context, store, x, top) {
  const [first, end] = store.span();
  context.textBaseline = "middle";
  context.textAlign = "left";
  let from = null;
  const close = (leading, until) => {
    if (from === null || leading === "none") return;
    const [left, right] = [x(from), x(until)];
    context.fillStyle = INTENTIONS[leading] ?? colour("quiet");
    context.fillRect(left, top, Math.max(1.5, right - left), RIBBON - 6);
    context.fillStyle = INK[leading] ?? colour("card");
    if (context.measureText(leading).width + 8 < right - left)
      context.fillText(leading, left + 4, top + RIBBON / 2 - 3);
  };
  let leading = null;
  for (let number = first; number < end; number += 1) {
    const { time_us: time, intent } = store.at(number).head.frame;
    if (intent.leading === leading) continue;
    close(leading, time);
    [leading, from] = [intent.leading, time];
  }
  close(leading, store.latest?.head.frame.time_us);
}

function cursor(context, at, height) {
  context.fillStyle = colour("ink");
  context.fillRect(Math.round(at) - 1, 0, 2, height);
}
