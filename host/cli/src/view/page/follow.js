// A scale that fits the first touch, and afterwards grows where a touch goes beyond it.

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

/** Remembers whether anything has touched. */
export class Follow {
  constructor() {
    this.fits = false;
  }

  /**
   * The end of the scale, from the previous end and the greatest pressure shown; unchanged below `low`, where
   * nothing touches.
   * @param {number} top
   * @param {number} greatest
   * @param {number} low
   * @param {[number, number]} ends
   */
  next(top, greatest, low, ends) {
    if (greatest < low) return top;
    const wanted = endFor(greatest, ends);
    const next = this.fits ? Math.max(top, wanted) : wanted;
    this.fits = true;
    return next;
  }
}
