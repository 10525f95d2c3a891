// What surrounds a relief: the floor, the walls behind it, and names and numbers.

import { colour } from "./dom.js";
import { decimals, ticks } from "./mesh.js";

/**
 * @typedef {import("./mesh.js").Mesh} Mesh
 * @typedef {import("./camera.js").Sight} Sight
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {object} Height the scale of the heights
 * @property {number} highest end in the unit
 * @property {string} unit
 */

/** Rows between two marks. */
const STEP = 8;
/** Distance of texts from the edges, pixels. */
const AWAY = 8;

/**
 * Draws all of it.
 * @param {CanvasRenderingContext2D} context
 * @param {Sight} sight
 * @param {Mesh} mesh
 * @param {Height} height
 */
export function axes(context, sight, mesh, height) {
  walls(context, sight, mesh, height);
  names(context, sight, mesh, height);
}

/**
 * Draws the panels' outlines on the floor, and lines of equal height on the walls behind.
 * @param {CanvasRenderingContext2D} context
 * @param {Sight} sight
 * @param {Mesh} mesh
 * @param {Height} height
 */
function walls(context, sight, { floors, box }, { highest }) {
  const [right, front] = [box[0], box[1]];
  const [wallX, wallY] = [sight.behind[0] ? 0 : right, sight.behind[1] ? 0 : front];
  context.lineWidth = 1;
  context.strokeStyle = colour("line");
  context.beginPath();
  for (const height of ticks(highest)) {
    const z = (height / highest) * box[2];
    line(context, sight, [
      [right - wallX, wallY, z],
      [wallX, wallY, z],
      [wallX, front - wallY, z],
    ]);
  }
  for (const [x, y] of [[wallX, wallY], [right - wallX, wallY], [wallX, front - wallY]])
    line(context, sight, [[x ?? 0, y ?? 0, 0], [x ?? 0, y ?? 0, box[2]]]);
  for (const { x, y, width, depth } of floors) {
    line(context, sight, [
      [x, y, 0],
      [x + width, y, 0],
      [x + width, y + depth, 0],
      [x, y + depth, 0],
      [x, y, 0],
    ]);
  }
  context.stroke();
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Sight} sight
 * @param {Triple[]} points
 */
function line(context, sight, points) {
  points.forEach((point, at) => {
    const [x, y] = sight.place(...point);
    if (at === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
}

/**
 * Writes the panels' names, the rows, and the heights with their unit.
 * @param {CanvasRenderingContext2D} context
 * @param {Sight} sight
 * @param {Mesh} mesh
 * @param {Height} height
 */
function names(context, sight, mesh, height) {
  context.fillStyle = colour("ink");
  context.font = "600 12px system-ui, sans-serif";
  context.textBaseline = "middle";
  const { floors, box } = mesh;
  const facesFront = sight.behind[1];
  for (const { panel, x, y, width, depth } of floors) {
    const edge = facesFront ? y + depth : y;
    outside(context, sight, panel.name, [x + width / 2, edge, 0], [x + width / 2, y + depth / 2, 0], 10);
  }
  context.font = "11px system-ui, sans-serif";
  rows(context, sight, mesh);
  const edge = /** @type {[number, number]} */ ([sight.behind[0] ? 0 : box[0], facesFront ? box[1] : 0]);
  const middle = /** @type {Triple} */ ([box[0] / 2, box[1] / 2, 0]);
  const marks = ticks(height.highest);
  const digits = decimals(marks);
  for (const mark of marks.slice(1)) {
    const last = mark === marks.at(-1);
    const z = (mark / height.highest) * box[2];
    const text = mark.toFixed(digits) + (last ? ` ${height.unit}` : "");
    outside(context, sight, text, [...edge, z], [middle[0], middle[1], z], 0);
  }
}

/**
 * The rows' numbers beside the panels at the side that faces the viewer.
 * @param {CanvasRenderingContext2D} context
 * @param {Sight} sight
 * @param {Mesh} mesh
 */
function rows(context, sight, { floors, across }) {
  const right = sight.behind[0];
  floors.forEach(({ panel, x, y, width }, at) => {
    const outermost = right ? at % across === across - 1 || at === floors.length - 1 : at % across === 0;
    if (!outermost) return;
    const edge = right ? x + width : x;
    for (let row = 0; row < panel.rows; row += STEP) {
      const along = y + (row + 0.5) * panel.mm[1];
      const text = row === 0 ? "row 0" : String(row);
      outside(context, sight, text, [edge, along, 0], [x + width / 2, along, 0], 0);
    }
  });
}

/**
 * A text beside a point, away from the middle.
 * @param {CanvasRenderingContext2D} context
 * @param {Sight} sight
 * @param {string} text
 * @param {Triple} point
 * @param {Triple} middle
 * @param {number} down more pixels away
 */
function outside(context, sight, text, point, middle, down) {
  const [x, y] = sight.place(...point);
  const [mx, my] = sight.place(...middle);
  const length = Math.hypot(x - mx, y - my) || 1;
  const [ux, uy] = [(x - mx) / length, (y - my) / length];
  const half = context.measureText(text).width / 2;
  context.textAlign = "center";
  context.fillText(text, x + ux * (AWAY + Math.abs(ux) * half + down), y + uy * (AWAY + down));
}
