// The view of a scene from above: turned about the vertical, tilted, in perspective, and always fitted into the
// picture. Lengths of the scene are millimetres: x along a row, y along a column, z up.

/**
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {object} Camera
 * @property {number} turn about the vertical, radians
 * @property {number} tilt above the floor, radians
 * @property {number} zoom multiple of the fitted size
 * @property {number} distance of the eye, multiples of half the scene's diagonal
 * @property {[number, number]} shift of the fitted picture, pixels
 * @typedef {object} Sight a camera that looks at a scene
 * @property {Float32Array} matrix from the scene to WebGL's clip space, by columns
 * @property {(x: number, y: number, z: number) => Triple} place pixels from the left and the top, and nearness
 * @property {[boolean, boolean]} behind whether the left side and the side of row 0 are behind the scene
 */

/** From the front, slightly from the right: row 0 is at the back. */
const HOME = { turn: 0.16, tilt: 0.6 };
/** Tilts between which the floor is seen from above, radians. */
const [LOWEST, HIGHEST] = [0.08, Math.PI / 2];
const [FARTHEST, NEAREST] = [0.5, 12];
/** Distance of the eye at home, multiples of half the scene's diagonal. */
const DISTANCE = 3.2;

/** @returns {Camera} the camera at the beginning, and after a reset */
export const home = () => ({ ...HOME, zoom: 1, shift: [0, 0], distance: DISTANCE });

/**
 * Turned and tilted by these angles.
 * @param {Camera} camera
 * @param {number} turn
 * @param {number} tilt
 * @param {number} lowest tilt
 * @returns {Camera}
 */
export const turned = (camera, turn, tilt, lowest = LOWEST) => ({
  ...camera,
  turn: (camera.turn + turn) % (2 * Math.PI),
  tilt: Math.max(lowest, Math.min(HIGHEST, camera.tilt + tilt)),
});

/**
 * Direction from the middle of the scene to the viewer, of length 1.
 * @param {Camera} camera
 * @returns {Triple}
 */
export const toward = ({ turn, tilt }) => [
  Math.sin(turn) * Math.cos(tilt),
  Math.cos(turn) * Math.cos(tilt),
  Math.sin(tilt),
];

/**
 * Nearer by a factor; what is seen at `at`, pixels from the middle, stays there.
 * @param {Camera} camera
 * @param {number} factor
 * @param {[number, number]} at
 * @returns {Camera}
 */
export function nearer(camera, factor, [x, y] = [0, 0]) {
  const zoom = Math.max(FARTHEST, Math.min(NEAREST, camera.zoom * factor));
  const by = zoom / camera.zoom;
  const [left, up] = camera.shift;
  return { ...camera, zoom, shift: [x - (x - left) * by, y - (y - up) * by] };
}

/**
 * A camera's sight of a box of this size, in a picture of this size with margins left free.
 * @param {Camera} camera
 * @param {Triple} box
 * @param {[number, number]} picture
 * @param {[number, number]} margins at the sides, above and below
 * @returns {Sight}
 */
export function sight({ turn, tilt, zoom, shift, distance }, box, [width, height], margins) {
  const [cosTurn, sinTurn, cosTilt, sinTilt] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
  const [cx, cy, cz] = [box[0] / 2, box[1] / 2, box[2] / 2];
  const reach = Math.hypot(cx, cy, cz) || 1;
  const eye = distance * reach;
  /** Right, up, and the divisor of perspective, each as a row of factors for x, y, z and 1. */
  const right = affine([cosTurn, -sinTurn, 0], [cx, cy, cz]);
  const up = affine([-sinTurn * sinTilt, -cosTurn * sinTilt, cosTilt], [cx, cy, cz]);
  const toward = affine([sinTurn * cosTilt, cosTurn * cosTilt, sinTilt], [cx, cy, cz]);
  const divisor = /** @type {Row} */ (toward.map((factor, at) => (at === 3 ? 1 : 0) - factor / eye));
  /** @type {(x: number, y: number, z: number) => Triple} */
  const flat = (x, y, z) => {
    const w = of(divisor, x, y, z);
    return [of(right, x, y, z) / w, -of(up, x, y, z) / w, w];
  };
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((at) => flat(at & 1 && box[0], at & 2 && box[1], at & 4 && box[2]));
  const ends = [0, 1].map((axis) => {
    const values = corners.map((corner) => corner[axis] ?? 0);
    return [Math.min(...values), Math.max(...values)];
  });
  const [[west = 0, east = 0] = [], [north = 0, south = 0] = []] = ends;
  const fitted = Math.min(
    Math.max(1, width - 2 * margins[0]) / (east - west || 1),
    Math.max(1, height - 2 * margins[1]) / (south - north || 1),
  );
  const scale = fitted * zoom;
  const left = width / 2 + shift[0] - (scale * (west + east)) / 2;
  const top = height / 2 + shift[1] - (scale * (north + south)) / 2;
  return {
    matrix: clip({ right, up, divisor }, { scale, left, top, width, height }, reach / eye),
    place: (x, y, z) => {
      const [u, v, w] = flat(x, y, z);
      return [left + scale * u, top + scale * v, -w];
    },
    behind: [sinTurn > 0, cosTurn > 0],
  };
}

/**
 * @typedef {[number, number, number, number]} Row
 * @param {Triple} factors
 * @param {Triple} middle which becomes 0
 * @returns {Row}
 */
const affine = ([a, b, c], [x, y, z]) => [a, b, c, -(a * x + b * y + c * z)];

/** @type {(row: Row, x: number, y: number, z: number) => number} */
const of = ([a, b, c, d], x, y, z) => a * x + b * y + c * z + d;

/**
 * Returns the same projection for WebGL: all in it is linear before the division.
 * @param {{ right: Row, up: Row, divisor: Row }} rows
 * @param {{ scale: number, left: number, top: number, width: number, height: number }} picture
 * @param {number} deep greatest change of the divisor within the scene
 */
function clip({ right, up, divisor }, { scale, left, top, width, height }, deep) {
  const matrix = new Float32Array(16);
  const slope = 2 / (1 / (1 + deep) - 1 / (1 - deep));
  const start = 1 - slope / (1 + deep);
  for (let at = 0; at < 4; at += 1) {
    const w = divisor[at] ?? 0;
    matrix[at * 4] = ((right[at] ?? 0) * 2 * scale) / width + ((2 * left) / width - 1) * w;
    matrix[at * 4 + 1] = ((up[at] ?? 0) * 2 * scale) / height + (1 - (2 * top) / height) * w;
    matrix[at * 4 + 2] = start * w + (at === 3 ? slope : 0);
    matrix[at * 4 + 3] = w;
  }
  return matrix;
}
