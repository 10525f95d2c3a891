// A scale that follows the pressure shown: it grows at once, and shrinks after a while.

/** Ends of the scale, counts: each twice the one before. */
const [LEAST, MOST] = [25, 51_200];
/** Time of lower pressure after which the scale shrinks, milliseconds. */
export const PATIENCE_MS = 2000;

/**
 * The smallest end at or above the greatest pressure.
 * @param {number} greatest
 */
export function endFor(greatest) {
  let end = LEAST;
  while (end < greatest && end < MOST) end *= 2;
  return end;
}

/** Remembers since when the pressure is lower. */
export class Follow {
  constructor() {
    /** @type {number | null} */
    this.since = null;
    this.most = 0;
  }

  /**
   * The end of the scale at `now` ms, from the previous end and the greatest pressure shown. Unchanged at
   * rest.
   * @param {number} top
   * @param {number} greatest
   * @param {number} now
   */
  next(top, greatest, now) {
    const wanted = endFor(greatest);
    if (greatest <= 0 || wanted >= top) {
      this.since = null;
      this.most = 0;
      return greatest > 0 ? Math.max(top, wanted) : top;
    }
    this.most = Math.max(this.most, wanted);
    this.since ??= now;
    if (now - this.since < PATIENCE_MS) return top;
    const next = this.most;
    this.since = null;
    this.most = 0;
    return next;
  }
}
