// Texts and arrows over the picture of the robot: their places, and their elements.

import { draw } from "./dom.js";
import { NONE } from "./figure.js";

/**
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {import("./on-robot.js").Aspect} Aspect
 */

/** Height of a line of names, and width of a letter, pixels; letters of the force behind a name. */
const [LINE, LETTER, FORCE] = [14, 6.8, 7];

/**
 * Place of a point of the scene in the picture.
 * @param {Aspect} aspect
 * @param {Triple} point
 * @returns {[number, number]}
 */
export function pixel({ sight: { place }, left }, point) {
  const [x, y] = place(...point);
  return [x + left, y];
}

/**
 * The middle of a side's upper edge.
 * @param {Aspect} aspect
 * @returns {[number, number]}
 */
export const middle = ({ left, width }) => [left + width / 2, 14];

/**
 * Moves names down until none is on another.
 * @param {{ name: string, at: [number, number] }[]} names
 * @param {number} behind letters that may be written behind a name
 */
export function apart(names, behind = FORCE) {
  names.forEach(({ name, at }, index) => {
    const isOn = (/** @type {typeof names[0]} */ other) =>
      // A sum of fractions may be a little less than a line: nearly one is enough, or names would move for ever.
      Math.abs(other.at[1] - at[1]) < LINE - 0.5 &&
      Math.abs(other.at[0] - at[0]) < LETTER * ((name.length + other.name.length) / 2 + behind);
    for (let other = names.slice(0, index).find(isOn); other; other = names.slice(0, index).find(isOn))
      at[1] = other.at[1] + LINE;
  });
}

/**
 * Sets an attribute if it has changed: what has not is not drawn again.
 * @param {Element} element
 * @param {string} name
 * @param {string} value
 */
export function set(element, name, value) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/** @param {[number, number]} point to half a pixel */
export const text = ([x, y]) => `${Math.round(2 * x) / 2} ${Math.round(2 * y) / 2}`;

/**
 * The point below the cloth of a link in the picture, where its name stands; null if it carries none.
 * @param {Aspect} aspect
 * @param {import("./cloth.js").Cloth} cloth
 * @param {number} link
 * @returns {[number, number] | null}
 */
export function below({ seen }, { links, taxels }, link) {
  let [count, sum, lowest] = [0, 0, 0];
  for (let corner = 0; corner < links.length; corner += 1) {
    if (links[corner] !== link || taxels[corner] === NONE) continue;
    lowest = count ? Math.max(lowest, seen[3 * corner + 1] ?? 0) : (seen[3 * corner + 1] ?? 0);
    sum += seen[3 * corner] ?? 0;
    count += 1;
  }
  return count ? [sum / count, lowest + LINE] : null;
}

/**
 * An arrow between two points of the picture.
 * @param {[number, number]} tail
 * @param {[number, number]} tip
 */
export function arrow(tail, tip) {
  const [x, y] = [tip[0] - tail[0], tip[1] - tail[1]];
  const long = Math.hypot(x, y);
  const head = Math.min(9, 0.6 * long) / (long || 1);
  const barb = (/** @type {1 | -1} */ side) =>
    text([tip[0] - head * (x + side * 0.55 * y), tip[1] - head * (y - side * 0.55 * x)]);
  return `M${text(tail)}L${text(tip)}M${barb(1)}L${text(tip)}L${barb(-1)}`;
}

/** An arrow in white with a dark halo, and its text. */
export function marker() {
  const shape = { fill: "none", "stroke-linecap": "round", "stroke-linejoin": "round" };
  // A style, because a report has one of its own for texts.
  const style =
    "fill:var(--mark);stroke:var(--halo);stroke-width:3.5px;paint-order:stroke fill;font:650 13px system-ui,sans-serif";
  return draw(
    "g",
    {},
    draw("path", { ...shape, stroke: "var(--halo)", "stroke-width": 5 }),
    draw("path", { ...shape, stroke: "var(--mark)", "stroke-width": 2.2 }),
    draw("text", { style }),
  );
}

/**
 * The children of a group, at least so many.
 * @param {Element} group
 * @param {number} count
 * @param {() => Element} another
 */
export function grown(group, count, another) {
  while (group.children.length < count) group.append(another());
  return [...group.children];
}
