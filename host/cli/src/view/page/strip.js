// Total force, leading intentions and marks over a period.

import { colour } from "./dom.js";
import { palette } from "./colours.js";
import { marks } from "./events.js";

/** Heights of the ribbon of intentions, of the lane of marks, and of the times below. */
export const RIBBON = 18;
export const LANE = 13;
export const TIMES = 15;
/** Colour of names on the colours of intentions. */
const INK = "#000";

/**
 * Draws the greatest total of each pixel as an area; columns below 0 are unknown. `floor` is its lower edge.
 * @param {CanvasRenderingContext2D} context
 * @param {Float64Array} columns
 * @param {number} highest
 * @param {number} floor
 * @param {number} head
 */
export function area(context, columns, highest, floor, head = 18) {
  context.beginPath();
  /** @type {number | null} */
  let last = null;
  columns.forEach((total, column) => {
    if (total < 0) return;
    const y = floor - (total / highest) * (floor - head);
    if (last === null) context.moveTo(column, floor);
    context.lineTo(column, y);
    last = column;
  });
  context.lineTo(last ?? 0, floor);
  context.closePath();
  context.globalAlpha = 0.25;
  context.fillStyle = colour("force");
  context.fill();
  context.globalAlpha = 1;
  context.strokeStyle = colour("force");
  context.lineWidth = 1.5;
  context.stroke();
}

/**
 * Draws periods [from, to, leading], with names where there is room.
 * @param {CanvasRenderingContext2D} context
 * @param {[number, number, string][]} stretches
 * @param {(time: number) => number} x
 * @param {number} top
 * @param {number} height
 */
export function ribbon(context, stretches, x, top, height = RIBBON - 5) {
  context.textBaseline = "middle";
  context.textAlign = "left";
  for (const [from, to, leading] of stretches) {
    const [left, right] = [x(from), x(to)];
    context.fillStyle = palette.intentions[leading] ?? colour("quiet");
    context.fillRect(left, top, Math.max(1.5, right - left), height);
    context.fillStyle = leading in palette.intentions ? INK : colour("card");
    const from_edge = Math.max(left, 0);
    if (height > 10 && context.measureText(leading).width + 8 < right - from_edge)
      context.fillText(leading, from_edge + 4, top + height / 2 + 0.5);
  }
}

/**
 * Draws lines at times, with labels below. `lines` are [x, name, align].
 * @param {CanvasRenderingContext2D} context
 * @param {[number, string, CanvasTextAlign][]} lines
 * @param {number} height
 */
export function ruler(context, lines, height) {
  context.textBaseline = "bottom";
  for (const [at, name, align] of lines) {
    context.fillStyle = colour("grid");
    context.fillRect(Math.round(at) - 0.5, 0, 1, height - TIMES);
    context.fillStyle = colour("quiet");
    context.textAlign = align;
    context.fillText(name, at, height);
  }
}

/**
 * Draws the moment shown.
 * @param {CanvasRenderingContext2D} context
 * @param {number} at
 * @param {number} height
 */
export function cursor(context, at, height) {
  context.fillStyle = colour("ink");
  context.fillRect(Math.round(at) - 1, 0, 2, height);
  context.beginPath();
  context.moveTo(at - 5, 0);
  context.lineTo(at + 5, 0);
  context.lineTo(at, 7);
  context.fill();
}

export { marks };
