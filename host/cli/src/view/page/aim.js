// Where a pointer meets the garment, in taxels of a panel, and where a place on a panel is in the picture.

import { placeOf } from "./garment.js";
import { foremost } from "./mesh.js";

/**
 * @typedef {import("./types.d.ts").Garment} Garment
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./types.d.ts").Plot} Plot
 * @typedef {import("./types.d.ts").Spot} Spot
 * @typedef {[number, number]} Point pixels
 * @typedef {Pick<Element, "getBoundingClientRect">} Stage
 * @typedef {{ panel: Panel, canvas: Stage }} Drawn a panel and its picture
 */

/** Steps of Newton's method: each doubles the digits of a place in a face. */
const STEPS = 4;

/** @type {(value: number, most: number) => number} */
const within = (value, most) => Math.max(0, Math.min(most, value));

/**
 * The place on one of the panels at a point of the page; null beside them.
 * @param {Drawn[]} parts
 * @param {Point} point
 * @returns {Spot | null}
 */
export function onPanels(parts, [x, y]) {
  for (const { panel, canvas } of parts) {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const [across, down] = [(x - left) / width, (y - top) / height];
    if (!(across >= 0 && across < 1 && down >= 0 && down < 1)) continue;
    return { panel, at: [across * panel.columns - 0.5, down * panel.rows - 0.5] };
  }
  return null;
}

/**
 * Places of a panel on the page.
 * @param {Drawn[]} parts
 * @param {Panel} panel
 * @returns {Plot}
 */
export function plotPanel(parts, panel) {
  const box = parts.find((part) => part.panel.index === panel.index)?.canvas.getBoundingClientRect();
  return ([x, y]) =>
    box
      ? [box.left + ((x + 0.5) * box.width) / panel.columns, box.top + ((y + 0.5) * box.height) / panel.rows]
      : null;
}

/**
 * The place on the foremost cloth at a point of the page; null beside it, and on the garment of another board.
 * @param {Garment} garment
 * @param {Stage} stage
 * @param {object} cloth
 * @param {Float32Array} cloth.seen x, y and nearness of each corner on the stage
 * @param {Uint32Array} cloth.faces four corners each, around the face
 * @param {Uint32Array} [cloth.taxels] of each corner, if its number is not that of the taxel
 * @param {Point} page
 * @returns {Spot | null}
 */
export function onCloth(garment, stage, { seen, faces, taxels }, page) {
  const { left, top } = stage.getBoundingClientRect();
  const point = /** @type {Point} */ ([page[0] - left, page[1] - top]);
  const face = foremost(seen, faces, ...point);
  if (face < 0) return null;
  const corners = [...faces.subarray(face, face + 4)];
  const [first = 0, second = 0] = corners.map((corner) => taxels?.[corner] ?? corner);
  if (first >= garment.taxels) return null;
  const { panel, row, column } = placeOf(garment, first);
  // All four corners of a taxel without neighbours are its own.
  if (first === second) return { panel, at: [column, row] };
  const [a, b, c, d] = corners.map((corner) => pointOf(seen, corner));
  const [across, down] = a && b && c && d ? inFace([a, b, c, d], point) : [0, 0];
  return { panel, at: [column + across, row + down] };
}

/**
 * @param {Float32Array} seen
 * @param {number} corner
 * @returns {Point}
 */
export const pointOf = (seen, corner) => [seen[3 * corner] ?? 0, seen[3 * corner + 1] ?? 0];

/**
 * The point of a face at these shares of the way from its first corner to the second, and to the fourth.
 * @param {[Point, Point, Point, Point]} face
 * @param {[number, number]} shares
 * @returns {Point}
 */
function blend([a, b, c, d], [u, v]) {
  const part = (/** @type {0 | 1} */ axis) =>
    (1 - v) * ((1 - u) * a[axis] + u * b[axis]) + v * ((1 - u) * d[axis] + u * c[axis]);
  return [part(0), part(1)];
}

/**
 * The shares, 0 to 1, at which a point lies in a face: the inverse of `blend`, by Newton's method.
 * @param {[Point, Point, Point, Point]} face
 * @param {Point} point
 * @returns {[number, number]}
 */
export function inFace(face, point) {
  const [a, b, c, d] = face;
  let [u, v] = [0.5, 0.5];
  for (let step = 0; step < STEPS; step += 1) {
    const at = blend(face, [u, v]);
    const [x, y] = [point[0] - at[0], point[1] - at[1]];
    const along = (/** @type {0 | 1} */ axis) => (1 - v) * (b[axis] - a[axis]) + v * (c[axis] - d[axis]);
    const down = (/** @type {0 | 1} */ axis) => (1 - u) * (d[axis] - a[axis]) + u * (c[axis] - b[axis]);
    const size = along(0) * down(1) - along(1) * down(0);
    if (Math.abs(size) < 1e-9) break;
    u += (x * down(1) - y * down(0)) / size;
    v += (y * along(0) - x * along(1)) / size;
  }
  return [within(u, 1), within(v, 1)];
}

/**
 * Places of a panel on cloth: between its taxels, and beyond the outermost straight on.
 * @param {Panel} panel
 * @param {Stage} stage
 * @param {(taxel: number) => Point | null} pixelOf place of a taxel on the stage; null if it has none
 * @returns {Plot}
 */
export function plotCloth({ base, rows, columns }, stage, pixelOf) {
  const { left, top } = stage.getBoundingClientRect();
  return ([x, y]) => {
    const [column, row] = [within(Math.floor(x), Math.max(0, columns - 2)), within(Math.floor(y), Math.max(0, rows - 2))];
    const [right, below] = [columns > 1 ? 1 : 0, rows > 1 ? columns : 0];
    const first = base + row * columns + column;
    const [a, b, c, d] = [first, first + right, first + right + below, first + below].map(pixelOf);
    if (!a || !b || !c || !d) return null;
    const at = blend([a, b, c, d], [x - column, y - row]);
    return [at[0] + left, at[1] + top];
  };
}
