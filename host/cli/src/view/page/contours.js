// Contours by marching squares between the centres of taxels.

// The two sides of a square that a line crosses, by the corners above the level (1 top left, 2 top right, 4
// bottom right, 8 bottom left). Sides: 0 top, 1 right, 2 bottom, 3 left. Saddles have two lines.
/** @type {[number, number][][]} */
const SIDES = [
  [],
  [[3, 0]],
  [[0, 1]],
  [[3, 1]],
  [[1, 2]],
  [
    [3, 0],
    [1, 2],
  ],
  [[0, 2]],
  [[3, 2]],
  [[2, 3]],
  [[2, 0]],
  [
    [0, 1],
    [2, 3],
  ],
  [[2, 1]],
  [[1, 3]],
  [[1, 0]],
  [[0, 3]],
  [],
];

/**
 * Adds the lines at `level` to the path of a context in which a taxel is 1 x 1.
 * @param {CanvasRenderingContext2D} context
 * @param {ArrayLike<number>} image
 * @param {import("./types.d.ts").Panel} panel
 * @param {number} level
 */
export function trace(context, image, { rows, columns, base }, level) {
  // A border of empty taxels around the panel closes the lines.
  const value = (/** @type {number} */ row, /** @type {number} */ column) =>
    row < 0 || column < 0 || row >= rows || column >= columns ? 0 : (image[base + row * columns + column] ?? 0);
  for (let row = -1; row < rows; row += 1) {
    for (let column = -1; column < columns; column += 1) {
      const [a, b] = [value(row, column), value(row, column + 1)];
      const [d, c] = [value(row + 1, column), value(row + 1, column + 1)];
      const which = [a, b, c, d].reduce((bits, corner, at) => bits | (corner >= level ? 1 << at : 0), 0);
      for (const [from, to] of SIDES[which] ?? []) {
        context.moveTo(...point(from, row, column, [a, b, c, d], level));
        context.lineTo(...point(to, row, column, [a, b, c, d], level));
      }
    }
  }
}

/**
 * Point at which a side of a square crosses the level.
 * @param {number} side
 * @param {number} row
 * @param {number} column
 * @param {[number, number, number, number]} corners
 * @param {number} level
 * @returns {[number, number]}
 */
function point(side, row, column, [a, b, c, d], level) {
  const share = (/** @type {number} */ from, /** @type {number} */ to) => (level - from) / (to - from);
  const [x, y] = [column + 0.5, row + 0.5];
  if (side === 0) return [x + share(a, b), y];
  if (side === 1) return [x + 1, y + share(b, c)];
  if (side === 2) return [x + share(d, c), y + 1];
  return [x, y + share(a, d)];
}
