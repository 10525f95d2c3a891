// Marks over a panel: ellipses of contacts with id, axis and slip arrow, and local maxima. White with a dark
// halo, visible on every colour of the scale.

import { colour } from "./dom.js";

/** Speed below which a contact counts as still, taxels per second. */
const STILL = 1.5;
/** Length of an arrow, seconds of movement. */
const AHEAD = 0.25;

/**
 * Half axes, in taxels, of the ellipse with a contact's area and elongation.
 * @param {import("./types.d.ts").Contact} contact
 * @returns {[number, number]}
 */
export function halfAxes({ area, anisotropy }) {
  const ratio = Math.sqrt((1 - anisotropy) / (1 + anisotropy)) || 0.1;
  const major = Math.sqrt(Math.max(area, 1) / Math.PI / Math.max(ratio, 0.1));
  return [major, major * Math.max(ratio, 0.1)];
}

/**
 * Strokes the path that `path` makes, first wide and dark, then narrow and light.
 * @param {CanvasRenderingContext2D} context
 * @param {number} width
 * @param {() => void} path
 */
function stroke(context, width, path) {
  context.beginPath();
  path();
  context.strokeStyle = colour("halo");
  context.lineWidth = width + 2;
  context.stroke();
  context.strokeStyle = colour("mark");
  context.lineWidth = width;
  context.stroke();
}

/**
 * Draws a contact; `sx` and `sy` are the pixels per taxel.
 * @param {CanvasRenderingContext2D} context
 * @param {import("./types.d.ts").Contact} touch
 * @param {number} sx
 * @param {number} sy
 */
export function contact(context, touch, sx, sy) {
  const [x, y] = [(touch.column + 0.5) * sx, (touch.row + 0.5) * sy];
  const [major, minor] = halfAxes(touch);
  const angle = touch.azimuth_rad ?? 0;
  /** @type {(along: number, across: number) => [number, number]} */
  const to = (along, across) => [
    x + (along * Math.cos(angle) - across * Math.sin(angle)) * sx,
    y + (along * Math.sin(angle) + across * Math.cos(angle)) * sy,
  ];
  stroke(context, 1.5, () => {
    for (let step = 0; step <= 48; step += 1) {
      const turn = (step / 48) * 2 * Math.PI;
      context.lineTo(...to(major * Math.cos(turn), minor * Math.sin(turn)));
    }
  });
  if (touch.azimuth_rad !== null) {
    stroke(context, 1, () => {
      context.moveTo(...to(-major, 0));
      context.lineTo(...to(major, 0));
    });
  }
  if (Math.hypot(touch.columns_per_s, touch.rows_per_s) > STILL) arrow(context, touch, x, y, sx, sy);
  label(context, String(touch.id), x, y);
}

/**
 * Draws its direction; wide if it slips.
 * @param {CanvasRenderingContext2D} context
 * @param {import("./types.d.ts").Contact} touch
 * @param {number} x
 * @param {number} y
 * @param {number} sx
 * @param {number} sy
 */
function arrow(context, { columns_per_s: vx, rows_per_s: vy, slip }, x, y, sx, sy) {
  const [dx, dy] = [vx * AHEAD * sx, vy * AHEAD * sy];
  const length = Math.max(18, Math.hypot(dx, dy));
  const angle = Math.atan2(dy, dx);
  const [ex, ey] = [x + length * Math.cos(angle), y + length * Math.sin(angle)];
  /** @type {(turn: number) => [number, number]} */
  const barb = (turn) => [ex - 8 * Math.cos(angle + turn), ey - 8 * Math.sin(angle + turn)];
  stroke(context, slip ? 3.5 : 1.5, () => {
    context.moveTo(x, y);
    context.lineTo(ex, ey);
    context.moveTo(...barb(0.5));
    context.lineTo(ex, ey);
    context.lineTo(...barb(-0.5));
  });
}

/**
 * Draws centred text with a halo.
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {number} x
 * @param {number} y
 */
export function label(context, text, x, y, size = 13) {
  context.font = `650 ${size}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.strokeStyle = colour("halo");
  context.lineWidth = 3.5;
  context.strokeText(text, x, y);
  context.fillStyle = colour("mark");
  context.fillText(text, x, y);
}

/**
 * Draws a local maximum.
 * @param {CanvasRenderingContext2D} context
 * @param {{ row: number, column: number }} place
 * @param {number} sx
 * @param {number} sy
 */
export function peak(context, { row, column }, sx, sy) {
  const [x, y] = [(column + 0.5) * sx, (row + 0.5) * sy];
  stroke(context, 1.2, () => {
    context.moveTo(x - 4, y);
    context.lineTo(x + 4, y);
    context.moveTo(x, y - 4);
    context.lineTo(x, y + 4);
  });
}

/**
 * Strokes the taxels of a panel on which the garment folds.
 * @param {CanvasRenderingContext2D} context
 * @param {number[]} taxels of the garment
 * @param {import("./types.d.ts").Panel} panel
 * @param {number} sx
 * @param {number} sy
 */
export function folds(context, taxels, { base, rows, columns }, sx, sy) {
  const own = taxels.filter((taxel) => taxel >= base && taxel < base + rows * columns);
  if (!own.length) return;
  const half = Math.min(sx, sy) / 4;
  stroke(context, 1, () => {
    for (const taxel of own) {
      const at = taxel - base;
      const [x, y] = [((at % columns) + 0.5) * sx, (Math.floor(at / columns) + 0.5) * sy];
      context.moveTo(x - half, y + half);
      context.lineTo(x + half, y - half);
    }
  });
}

/**
 * Draws a local maximum of the surface.
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 */
export function diamond(context, x, y) {
  stroke(context, 1.2, () => {
    context.moveTo(x, y - 4);
    context.lineTo(x + 4, y);
    context.lineTo(x, y + 4);
    context.lineTo(x - 4, y);
    context.closePath();
  });
}

/**
 * Draws the taxel under the pointer.
 * @param {CanvasRenderingContext2D} context
 * @param {number} row
 * @param {number} column
 * @param {number} sx
 * @param {number} sy
 */
export function frame(context, row, column, sx, sy) {
  stroke(context, 1.5, () => context.rect(column * sx, row * sy, sx, sy));
}
