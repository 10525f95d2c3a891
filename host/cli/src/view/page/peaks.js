// Local maxima of a panel.

/**
 * Taxels at or above `low` without a greater neighbour, the first of a plateau, greatest first: [{ row,
 * column, value }].
 * @param {ArrayLike<number>} image
 * @param {import("./types.d.ts").Panel} panel
 * @param {number} low
 * @returns {{ row: number, column: number, value: number }[]}
 */
export function maxima(image, panel, low) {
  const { rows, columns, base } = panel;
  const found = [];
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < columns; column += 1) {
      const value = image[base + row * columns + column] ?? 0;
      if (value >= low && isMaximum(image, panel, row, column, value)) found.push({ row, column, value });
    }
  }
  return found.sort((a, b) => b.value - a.value);
}

/**
 * @param {ArrayLike<number>} image
 * @param {import("./types.d.ts").Panel} panel
 * @param {number} row
 * @param {number} column
 * @param {number} value
 */
function isMaximum(image, { rows, columns, base }, row, column, value) {
  for (let y = Math.max(0, row - 1); y <= Math.min(rows - 1, row + 1); y += 1) {
    for (let x = Math.max(0, column - 1); x <= Math.min(columns - 1, column + 1); x += 1) {
      const other = image[base + y * columns + x] ?? 0;
      const before = y < row || (y === row && x < column);
      if (other > value || (before && other === value)) return false;
    }
  }
  return true;
}
