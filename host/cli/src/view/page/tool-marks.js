// The outlines of the tools over the picture, each with its force.

import { $, draw, say } from "./dom.js";
import { outline, path } from "./outline.js";
import { set } from "./robot-marks.js";

/**
 * @typedef {import("./types.d.ts").Plot} Plot
 * @typedef {import("./types.d.ts").Spot} Spot
 * @typedef {object} Mark
 * @property {import("./force-law.js").Tool} tool
 * @property {number} angle degrees
 * @property {Spot} spot
 * @property {string} text
 */

/** Distance of the text from the outline, pixels. */
const ABOVE = 6;

/** Draws them on a layer over the page. */
export class ToolMarks {
  constructor() {
    this.layer = $("tool-marks");
  }

  /**
   * @param {[Mark, Plot | undefined][]} marks each with the places of its panel, where a view has them
   */
  draw(marks) {
    while (this.layer.children.length < marks.length) this.layer.append(markOf());
    [...this.layer.children].forEach((group, at) => {
      const [mark, plot] = marks[at] ?? [];
      const points = mark && plot ? pointsOf(mark, plot) : [];
      set(group, "display", points.length ? "inline" : "none");
      const [halo, line, words] = group.children;
      if (!mark || !points.length || !halo || !line || !words) return;
      for (const stroke of [halo, line]) set(stroke, "d", path(points));
      set(line, "stroke-dasharray", mark.text ? "none" : "4 3");
      const [left, right] = [Math.min(...points.map(([x]) => x)), Math.max(...points.map(([x]) => x))];
      set(words, "x", ((left + right) / 2).toFixed(1));
      set(words, "y", (Math.min(...points.map(([, y]) => y)) - ABOVE).toFixed(1));
      say(words, mark.text);
    });
  }
}

/**
 * The outline on the page: what of it lies on the panel.
 * @param {Mark} mark
 * @param {Plot} plot
 */
export function pointsOf({ tool, angle, spot: { panel, at } }, plot) {
  return outline(tool, angle).flatMap(([x, y]) => {
    const { mm, columns, rows } = panel;
    const within = (/** @type {number} */ value, /** @type {number} */ count) =>
      Math.max(-0.5, Math.min(count - 0.5, value));
    const point = plot([within(at[0] + x / mm[0], columns), within(at[1] + y / mm[1], rows)]);
    return point ? [point] : [];
  });
}

/** An outline in white with a dark halo, and its text. */
function markOf() {
  const words = { "text-anchor": "middle", "font-size": 13, "font-weight": 650, "paint-order": "stroke" };
  return draw(
    "g",
    { fill: "none", "stroke-linejoin": "round" },
    draw("path", { stroke: "var(--halo)", "stroke-width": 4 }),
    draw("path", { stroke: "var(--mark)", "stroke-width": 1.8 }),
    draw("text", { ...words, fill: "var(--mark)", stroke: "var(--halo)", "stroke-width": 3.5 }),
  );
}
