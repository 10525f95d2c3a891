// Marks of log lines on a time line.

import { colour } from "./dom.js";
import { MARKED } from "./timeline.js";

/** Name of each kind in the legend. */
export const KINDS = /** @type {const} */ ({
  onset: "contact",
  intention: "intention",
  reaction: "reaction",
  gesture: "gesture",
  gap: "gap",
});
/** Width of the widest mark, pixels. */
export const WIDE = 9;

/**
 * Draws the marks of [time, kind] around the height `y`; `x` maps a time to its place. Of coinciding marks
 * only the last is drawn.
 * @param {CanvasRenderingContext2D} context
 * @param {(readonly [number, string, string])[]} said
 * @param {(time: number) => number} x
 * @param {number} y
 */
export function marks(context, said, x, y) {
  const drawn = new Map();
  for (const [time, kind] of said) {
    const order = MARKED.indexOf(kind);
    if (order < 0) continue;
    const key = `${Math.round(x(time) / 2)} ${kind}`;
    drawn.set(key, { at: x(time), kind, order });
  }
  const list = [...drawn.values()].sort((a, b) => a.order - b.order);
  for (const { at, kind } of list) mark(context, kind, at, y);
}

/**
 * Draws one mark.
 * @param {CanvasRenderingContext2D} context
 * @param {string} kind
 * @param {number} x
 * @param {number} y
 */
export function mark(context, kind, x, y) {
  const half = WIDE / 2;
  context.fillStyle = colour(`mark-${kind}`);
  context.beginPath();
  if (kind === "onset") context.rect(x - 1, y - half, 2, WIDE);
  else if (kind === "note") context.arc(x, y, 1.5, 0, 2 * Math.PI);
  else if (kind === "gesture") context.arc(x, y, half - 0.5, 0, 2 * Math.PI);
  else if (kind === "gap") context.rect(x - 2, y - half - 2, 4, WIDE + 4);
  else if (kind === "intention") {
    context.moveTo(x - half, y - half);
    context.lineTo(x + half, y - half);
    context.lineTo(x, y + half);
  } else {
    context.moveTo(x, y - half - 1);
    context.lineTo(x + half, y);
    context.lineTo(x, y + half + 1);
    context.lineTo(x - half, y);
  }
  context.closePath();
  context.fill();
}
