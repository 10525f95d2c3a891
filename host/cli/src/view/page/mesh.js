// The panels as one mesh of taxels: where each stands, which four make a face, and how high and how light they
// are.

/**
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {object} Floor a panel on the floor
 * @property {Panel} panel
 * @property {number} x of its left side, mm
 * @property {number} y of its side of row 0, mm
 * @property {number} width mm
 * @property {number} depth mm
 * @typedef {object} Mesh
 * @property {Floor[]} floors
 * @property {Triple} box extent of all, mm
 * @property {Float32Array} places x and y of each taxel's middle, mm
 * @property {Uint32Array} faces four taxels each, around the face
 * @property {number} across panels side by side
 */

/** Free space between two panels, and before a second row of panels, whose names stand there; mm. */
const [GAP, AISLE] = [24, 100];
/** Height of the scale's end, share of the longer side of the floor. */
const HIGH = 0.3;
/** Direction from which the light comes: steep, from the left and from row 0. */
const LIGHT = { x: -0.5, y: -0.35 };
const [DARKEST, SHADE] = [0.6, 0.3];

/**
 * @param {Panel[]} panels
 * @param {ArrayLike<number>} absent 1 where there is no taxel
 * @param {boolean} tall if the picture is taller than wide, the panels stand in two rows
 * @returns {Mesh}
 */
export function meshOf(panels, absent, tall) {
  const across = tall ? Math.ceil(panels.length / 2) : panels.length;
  /** @type {Floor[]} */
  const floors = [];
  let [left, front, behind, wide] = [0, 0, 0, 0];
  panels.forEach((panel, at) => {
    if (at > 0 && at % across === 0) [left, behind] = [0, front + AISLE];
    const [width, depth] = [panel.columns * panel.mm[0], panel.rows * panel.mm[1]];
    floors.push({ panel, x: left, y: behind, width, depth });
    left += width + GAP;
    front = Math.max(front, behind + depth);
    wide = Math.max(wide, left - GAP);
  });
  const taxels = panels.reduce((sum, { rows, columns }) => sum + rows * columns, 0);
  const places = new Float32Array(2 * taxels);
  /** @type {number[]} */
  const faces = [];
  for (const { panel, x, y } of floors) {
    const { base, rows, columns, mm } = panel;
    for (let at = 0; at < rows * columns; at += 1) {
      const [row, column] = [Math.floor(at / columns), at % columns];
      places[2 * (base + at)] = x + (column + 0.5) * mm[0];
      places[2 * (base + at) + 1] = y + (row + 0.5) * mm[1];
      if (row + 1 === rows || column + 1 === columns) continue;
      const corners = [0, 1, columns + 1, columns].map((step) => base + at + step);
      if (!corners.some((taxel) => absent[taxel])) faces.push(...corners);
    }
  }
  const box = /** @type {Triple} */ ([wide, front, HIGH * Math.max(wide, front)]);
  return { floors, box, places, faces: Uint32Array.from(faces), across };
}

/**
 * @typedef {object} Relief of each taxel
 * @property {Float32Array} data height in mm, share of the ramp (0 to 1), and light (1 on the flat)
 * @property {number} taxels
 */
/** Numbers of a taxel in a relief. */
export const STRIDE = 3;

/**
 * @param {number} taxels
 * @returns {Relief}
 */
export const flat = (taxels) => ({ data: new Float32Array(STRIDE * taxels).fill(0), taxels });

/**
 * Fills a relief with an image: heights up to `highest`, colours up to `top`.
 * @param {Relief} relief
 * @param {Mesh} mesh
 * @param {ArrayLike<number>} image
 * @param {{ top: number, highest: number }} scale
 */
export function raise({ data }, { floors, box }, image, { top, highest }) {
  const up = box[2] / highest;
  for (const { panel } of floors) {
    const { base, rows, columns, mm } = panel;
    for (let at = 0; at < rows * columns; at += 1) {
      const place = STRIDE * (base + at);
      const value = image[base + at] ?? 0;
      const column = at % columns;
      const [left, right] = [column > 0 ? 1 : 0, column + 1 < columns ? 1 : 0];
      const [above, below] = [at >= columns ? columns : 0, at + columns < rows * columns ? columns : 0];
      const here = base + at;
      const alongX = ((image[here + right] ?? 0) - (image[here - left] ?? 0)) / ((left + right || 1) * mm[0]);
      const steps = (above > 0 ? 1 : 0) + (below > 0 ? 1 : 0) || 1;
      const alongY = ((image[here + below] ?? 0) - (image[here - above] ?? 0)) / (steps * mm[1]);
      data[place] = Math.min(value, highest) * up;
      data[place + 1] = Math.min(1, value / top);
      data[place + 2] = light(alongX * up, alongY * up);
    }
  }
}

/**
 * Light on a slope: 1 on the flat and where it faces the light, so that colours stay those of the ramp.
 * @param {number} alongX
 * @param {number} alongY
 */
export function light(alongX, alongY) {
  const facing = (1 - LIGHT.x * alongX - LIGHT.y * alongY) / Math.hypot(alongX, alongY, 1);
  return Math.max(DARKEST, Math.min(1, 1 + SHADE * (facing - 1)));
}

/**
 * Marks of a scale from 0 to `end`: at least three, at round numbers.
 * @param {number} end
 * @returns {number[]}
 */
export function ticks(end) {
  const power = 10 ** Math.floor(Math.log10(end / 3));
  const step = [10, 5, 2.5, 2, 1].map((times) => times * power).find((step) => end / step >= 3 - 1e-9) ?? power;
  return Array.from({ length: Math.floor(end / step + 1e-9) + 1 }, (_, at) => at * step);
}

/**
 * Decimals that distinguish ticks.
 * @param {number[]} ticks
 */
export function decimals(ticks) {
  const exact = (/** @type {number} */ digits) => ticks.every((tick) => Math.abs(Number(tick.toFixed(digits)) - tick) < 1e-9);
  return [0, 1, 2, 3].find(exact) ?? 4;
}

/**
 * End of the height: a multiple of the colours' end that holds the highest pressure, so that it changes seldom.
 * @param {ArrayLike<number>} held
 * @param {number} top
 */
export function heightOf(held, top) {
  let greatest = 1;
  for (let taxel = 0; taxel < held.length; taxel += 1) greatest = Math.max(greatest, held[taxel] ?? 0);
  return top * Math.ceil(greatest / top);
}

/**
 * The taxel of the foremost face at a point of the picture; null if there is none.
 * @param {Float32Array} seen x, y and nearness of each taxel
 * @param {Uint32Array} faces
 * @param {number} x
 * @param {number} y
 * @returns {number | null}
 */
export function under(seen, faces, x, y) {
  const best = foremost(seen, faces, x, y);
  if (best < 0) return null;
  const away = (/** @type {number} */ taxel) => Math.hypot((seen[3 * taxel] ?? 0) - x, (seen[3 * taxel + 1] ?? 0) - y);
  return [...faces.subarray(best, best + 4)].reduce((nearest, taxel) => (away(taxel) < away(nearest) ? taxel : nearest));
}

/**
 * Index in `faces` of the first corner of the foremost face at a point of the picture; -1 if there is none.
 * @param {Float32Array} seen x, y and nearness of each taxel
 * @param {Uint32Array} faces
 * @param {number} x
 * @param {number} y
 */
export function foremost(seen, faces, x, y) {
  let [best, near] = [-1, -Infinity];
  for (let face = 0; face < faces.length; face += 4) {
    const nearness = seen[3 * (faces[face] ?? 0) + 2] ?? 0;
    if (nearness > near && holds(seen, faces, face, x, y)) [best, near] = [face, nearness];
  }
  return best;
}

/**
 * True if a face, as it is seen, holds a point: the number of sides to the right of it is odd.
 * @param {Float32Array} seen
 * @param {Uint32Array} faces
 * @param {number} face
 * @param {number} x
 * @param {number} y
 */
function holds(seen, faces, face, x, y) {
  let inside = false;
  for (let side = 0; side < 4; side += 1) {
    const [a, b] = [3 * (faces[face + side] ?? 0), 3 * (faces[face + ((side + 1) % 4)] ?? 0)];
    const [ax = 0, ay = 0, bx = 0, by = 0] = [seen[a], seen[a + 1], seen[b], seen[b + 1]];
    if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) inside = !inside;
  }
  return inside;
}
