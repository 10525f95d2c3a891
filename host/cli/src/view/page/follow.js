// A scale that follows the pressure shown: it grows at once, and shrinks after a while.

/** Time of lower pressure after which the scale shrinks, milliseconds. */
export const PATIENCE_MS = 2000;

/**
 * The smallest end at or above the greatest pressure.
 * @param {number} greatest
 * @param {[number, number]} ends least and greatest, counts; each between is twice the one before
 */
export function endFor(greatest, [least, most]) {
  let end = least;
  while (end < greatest && end < most) end *= 2;
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
   * @param {[number, number]} ends
   */
  next(top, greatest, now, ends) {
    const wanted = endFor(greatest, ends);
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
