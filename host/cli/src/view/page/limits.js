// Limits of the board's scene, without the page: their ranges, and what a limit changes in an image.

/** @typedef {import("./messages.d.ts").SetupLine["limits"]} Limits */

/** Name, label, range, and description of each limit. */
export const LIMITS = /** @type {const} */ ([
  ["floor", "Floor", 1, 200, "Pressure below it is 0, counts"],
  ["low", "Contact", 1, 400, "Pressure of a contact's taxels, counts"],
  ["high", "Onset", 1, 1000, "Peak with which a contact begins, counts"],
  ["min_area", "Smallest", 1, 32, "Area from which on a contact counts, taxels"],
]);

/** Name and description of each filter. */
export const FILTERS = /** @type {const} */ ([
  ["off", "Off", "each taxel as it is"],
  ["conservative", "Conservative", "single taxels that exceed their neighbours are cut"],
  ["persistent", "Persistent", "single taxels that exceed their neighbours are cut for a frame"],
  ["square", "Square", "for strong noise: lines of one taxel are halved"],
  ["median", "Median", "the median of nine: points and thin lines are lost"],
]);

/**
 * Limits with one of them changed; a contact begins with no lower peak than its taxels have.
 * @param {Limits} limits
 * @param {"floor" | "low" | "high" | "min_area"} name
 * @param {number} value
 * @returns {Limits}
 */
export function changed(limits, name, value) {
  const next = { ...limits, [name]: value };
  if (name === "low") next.high = Math.max(next.high, value);
  if (name === "high") next.low = Math.min(next.low, value);
  return next;
}

/**
 * What limits let through of an image, in words.
 * @param {ArrayLike<number>} image counts
 * @param {Limits} limits
 */
export function passed(image, { low, high }) {
  let [pressed, peaks, greatest] = [0, 0, 0];
  for (let taxel = 0; taxel < image.length; taxel += 1) {
    const value = image[taxel] ?? 0;
    pressed += Number(value >= low);
    peaks += Number(value >= high);
    greatest = Math.max(greatest, value);
  }
  if (greatest === 0) return "Nothing presses now.";
  const taxels = pressed === 1 ? "1 taxel reaches" : `${pressed} taxels reach`;
  return `The greatest pressure now is ${greatest} counts: ${taxels} ${low}, ${peaks} of them ${high}.`;
}
