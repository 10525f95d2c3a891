// Force of a touch by hand, N: by how long it rests, how fast it moves, or how hard a pen presses.

/** @typedef {import("./messages.d.ts").HandLine["tools"][number]} Tool */

/** Greatest force of a touch, N. */
export const MOST_N = 200;
/** Time in which a short press reaches its force, for which it then keeps it, and in which a long press grows, ms. */
const [RISE_MS, KEEP_MS, GROW_MS] = [60, 400, 2000];
/** Speed below which a touch rests, mm/s. */
export const REST_MM_S = 20;
/** Speed from which a strap lashes, and at which the lash has its greatest force, mm/s; that force, N. */
const [LASH_MM_S, FULL_MM_S, LASH_N] = [600, 2000, 60];
/** Least and greatest factor of the force, and its change by a notch of the wheel. */
const [LEAST, GREATEST, NOTCH] = [0.1, 10, 1.15];

/** @param {number} value */
const share = (value) => Math.max(0, Math.min(1, value));

/**
 * The factor after so many notches of the wheel; below 0 for less force.
 * @param {number} factor
 * @param {number} notches
 */
export const turnedBy = (factor, notches) => Math.max(LEAST, Math.min(GREATEST, factor * NOTCH ** notches));

/**
 * Force of a short press, N.
 * @param {Tool} tool
 * @param {number} factor
 */
export const shortForce = ({ force_n: force }, factor) => Math.min(MOST_N, force * factor);

/**
 * True if a tool lashes at this speed, mm/s.
 * @param {Tool} tool
 * @param {number} speed
 */
export const lashes = ({ name }, speed) => name === "strap" && speed > LASH_MM_S;

/**
 * The force, 0 to 200 N.
 * @param {Tool} tool
 * @param {number} factor 0.1 to 10
 * @param {object} press
 * @param {number} press.age time since it began, ms
 * @param {number} press.rested time of it at rest, ms
 * @param {number} press.speed mm/s
 * @param {number | null} press.pressure of a pen, 0 to 1; null for other pointers
 */
export function forceOf(tool, factor, { age, rested, speed, pressure }) {
  const short = shortForce(tool, factor);
  if (pressure !== null) return Math.min(MOST_N, 2 * pressure * short);
  const long = Math.min(MOST_N, Math.max(short, tool.most_n * Math.min(1, factor)));
  const steady = short * share(age / RISE_MS) + (long - short) * share((rested - RISE_MS - KEEP_MS) / GROW_MS);
  if (!lashes(tool, speed)) return steady;
  const full = Math.min(MOST_N, LASH_N * factor);
  return Math.max(steady, short + (full - short) * share((speed - LASH_MM_S) / (FULL_MM_S - LASH_MM_S)));
}
