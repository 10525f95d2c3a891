// What screen readers say of a stream: its changes, at a pace that can be listened to.

/** Least time between two announcements, milliseconds. */
export const PAUSE_MS = 1500;

/** Passes on the newest text. */
export class Speaker {
  constructor() {
    this.said = "";
    this.at = -PAUSE_MS;
  }

  /**
   * The text to be said at `now` ms, which stays the same until something else has been true for long enough.
   * @param {string} text
   * @param {number} now
   */
  next(text, now) {
    if (text !== this.said && now - this.at >= PAUSE_MS) {
      this.said = text;
      this.at = now;
    }
    return this.said;
  }
}
