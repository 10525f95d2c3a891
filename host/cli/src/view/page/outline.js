// The outline of a tool that presses: of its true size on a panel, and as an icon.

/** @typedef {import("./force-law.js").Tool} Tool */

/** Points of an outline. */
const POINTS = 64;
/** Exponents of the superellipses that outline tools: 2 is an ellipse, as of the others, and a great one a rectangle. */
const EXPONENTS = /** @type {Record<string, number>} */ ({ palm: 4, forearm: 60, strap: 60 });
/** Length of the longest icon, pixels, and of its tool, mm; an icon's length goes by the square root. */
const [ICON, LENGTH] = [22, 250];

/**
 * Points around a tool, mm from its centre.
 * @param {Pick<Tool, "name" | "size_mm">} tool
 * @param {number} angle from +x towards +y, degrees
 * @returns {[number, number][]}
 */
export function outline({ name, size_mm: [length, width] }, angle = 0) {
  const exponent = EXPONENTS[name] ?? 2;
  const turn = (angle * Math.PI) / 180;
  return Array.from({ length: POINTS }, (_, at) => {
    const [cos, sin] = [Math.cos((2 * Math.PI * at) / POINTS), Math.sin((2 * Math.PI * at) / POINTS)];
    const out = (Math.abs(cos) ** exponent + Math.abs(sin) ** exponent) ** (-1 / exponent) / 2;
    const [x, y] = [length * out * cos, width * out * sin];
    return [x * Math.cos(turn) - y * Math.sin(turn), x * Math.sin(turn) + y * Math.cos(turn)];
  });
}

/**
 * A closed path of SVG.
 * @param {[number, number][]} points
 */
export const path = (points) => `M${points.map((at) => at.map((part) => part.toFixed(1)).join(" ")).join("L")}Z`;

/**
 * The path of a tool's icon around 0, 0, and its length, pixels.
 * @param {Tool} tool
 */
export function icon({ name, size_mm: size }) {
  const [length = 0, width = 0] = size.map((mm) => ICON * Math.sqrt(mm / LENGTH));
  return { d: path(outline({ name, size_mm: [length, width] })), length };
}
