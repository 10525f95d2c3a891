// Where the garment folds: taxels that it presses by itself, and what the strokes over them mean.

/**
 * @typedef {import("./types.d.ts").Shown} Shown
 * @typedef {import("./types.d.ts").Settings} Settings
 */

/**
 * The taxels that are stroked: their numbers.
 * @param {Shown} shown
 * @param {Settings} settings
 * @returns {number[]}
 */
export const folding = ({ head }, settings) => (settings.folds && !settings.held ? (head.folding?.taxels ?? []) : []);

/**
 * Meaning of the strokes; empty if nothing is known of folds.
 * @param {Shown | null} shown
 * @param {Settings} settings
 */
export function legend(shown, settings) {
  const drawn = shown?.head.folding;
  if (!drawn || !settings.folds || settings.held) return "";
  const { followed, taxels } = drawn;
  if (!followed) return `╱ may fold: ${taxels.length} taxels, no posture is sent`;
  return taxels.length ? `╱ folds here: ${taxels.length} taxels` : "no fold presses";
}
