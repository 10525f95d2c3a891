// Arithmetic of a recording's timeline, without drawing. Times of the overview are microseconds, those of the
// player seconds.

/** @typedef {import("./types.d.ts").Said} Said */

/** Speeds on offer. */
export const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8, 16];
/** Seconds of the strip around the moment, for a recording of this length; at most half a minute. */
export const nearOf = (/** @type {number} */ duration) => Math.max(2, Math.min(30, duration / 6));

/**
 * The next speed up (+1) or down (-1) of those on offer.
 * @param {number} speed
 * @param {number} way
 */
export function nextSpeed(speed, way) {
  const further = SPEEDS.filter((other) => (way > 0 ? other > speed * 1.001 : other < speed * 0.999));
  return (way > 0 ? further[0] : further.at(-1)) ?? speed;
}

/** "0.05×", "1×" */
export const speedText = (/** @type {number} */ speed) => `${Number(speed.toPrecision(3))}×`;

/**
 * "7.25", "1:07.25", "1:02:07.25", with this many decimals.
 * @param {number} seconds
 * @param {number} decimals
 */
export function timeText(seconds, decimals = 2) {
  const scale = 10 ** decimals;
  const ticks = Math.round(Math.max(0, seconds) * scale);
  const whole = Math.floor(ticks / scale);
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const rest = decimals ? `.${String(ticks % scale).padStart(decimals, "0")}` : "";
  const two = (/** @type {number} */ number) => String(number).padStart(2, "0");
  if (h) return `${h}:${two(m)}:${two(s)}${rest}`;
  return m ? `${m}:${two(s)}${rest}` : `${s}${rest}`;
}

/**
 * Seconds between two lines of a ruler of `seconds` on `width` pixels, so that lines are at least 80 pixels
 * apart.
 * @param {number} seconds
 * @param {number} width
 */
export function rulerStep(seconds, width) {
  const least = (seconds * 80) / Math.max(width, 1);
  const steps = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200];
  return steps.find((step) => step >= least) ?? Math.ceil(least / 3600) * 3600;
}

/**
 * The window of `length` seconds around a moment, within the recording if that is longer.
 * @param {number} at
 * @param {number} duration
 * @param {number} length
 * @returns {[number, number]}
 */
export function windowAbout(at, duration, length = nearOf(duration)) {
  if (duration <= length) return [0, Math.max(duration, 0.01)];
  const from = Math.max(0, Math.min(duration - length, at - length / 2));
  return [from, from + length];
}

/**
 * The greatest total of each pixel of a window [from, to] s, counts.
 * @param {{ totals: ArrayLike<number>, width_us: number }} overview
 * @param {[number, number]} window
 * @param {number} width
 */
export function columns({ totals, width_us: place }, [from, to], width) {
  const found = new Float64Array(Math.max(1, Math.ceil(width)));
  const of = (/** @type {number} */ x) => ((from + ((to - from) * x) / found.length) * 1e6) / place;
  for (let x = 0; x < found.length; x += 1) {
    const first = Math.max(0, Math.floor(of(x)));
    const last = Math.min(totals.length - 1, Math.max(first, Math.ceil(of(x + 1)) - 1));
    for (let at = first; at <= last; at += 1) found[x] = Math.max(found[x] ?? 0, totals[at] ?? 0);
  }
  return found;
}

/**
 * Number of items at `at` or before, in a list sorted by its first field.
 * @param {readonly (readonly [number, ...unknown[]])[]} list
 * @param {number} at
 */
export function countUntil(list, at) {
  let [low, high] = [0, list.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((list[middle]?.[0] ?? 0) <= at) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * The last log lines up to `at` us, newest first.
 * @type {(said: Said[], at: number, lines?: number) => Said[]}
 */
export const logAt = (said, at, lines = 60) => {
  const end = countUntil(said, at);
  return said.slice(Math.max(0, end - lines), end).reverse();
};

/**
 * The leading intention at `at` us.
 * @type {(intentions: [number, string][], at: number) => string}
 */
export const leadingAt = (intentions, at) => intentions[countUntil(intentions, at) - 1]?.[1] ?? "none";

/**
 * Periods [from, to, leading] with a leading intention, us.
 * @param {[number, string][]} intentions
 * @param {number} end
 * @returns {[number, number, string][]}
 */
export function stretches(intentions, end) {
  /** @type {[number, number, string][]} */
  const all = intentions.map(([from, leading], index) => [from, intentions[index + 1]?.[0] ?? end, leading]);
  return all.filter(([, , leading]) => leading !== "none");
}

/** Kinds with a mark, in drawing order: the most important last. */
export const MARKED = ["note", "onset", "gesture", "intention", "reaction", "gap"];

/**
 * The marked line nearest to `at` within `reach` us, the most important of equally near ones; null if none.
 * @param {Said[]} said
 * @param {number} at
 * @param {number} reach
 */
export function nearest(said, at, reach) {
  /** @type {{ away: number, order: number, line: Said } | null} */
  let best = null;
  for (const line of said.slice(countUntil(said, at - reach), countUntil(said, at + reach))) {
    const [away, order] = [Math.abs(line[0] - at), MARKED.indexOf(line[1])];
    if (order < 0) continue;
    const nearer = !best || away < best.away || (away === best.away && order > best.order);
    if (nearer) best = { away, order, line };
  }
  return best?.line ?? null;
}

/**
 * The next (+1) or previous (-1) marked line away from `at` us, which is exact to a millisecond; null if
 * none.
 * @param {Said[]} said
 * @param {number} at
 * @param {number} way
 */
export function neighbour(said, at, way) {
  const marked = (/** @type {Said} */ line) => MARKED.includes(line[1]) && line[1] !== "note";
  if (way > 0) return said.slice(countUntil(said, at + 1000)).find(marked) ?? null;
  return said.slice(0, countUntil(said, at - 1000)).findLast(marked) ?? null;
}

/**
 * The range after one of its ends was moved to `to` seconds; the ends never meet.
 * @param {[number, number]} range
 * @param {number} which
 * @param {number} to
 * @param {number} duration
 * @returns {[number, number]}
 */
export function moved([from, end], which, to, duration) {
  const least = Math.min(0.05, duration);
  const at = Math.max(0, Math.min(duration, to));
  return which === 0 ? [Math.min(at, end - least), end] : [from, Math.max(at, from + least)];
}
