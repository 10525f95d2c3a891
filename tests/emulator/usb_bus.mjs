// A full-speed bus with one device on it: transactions one after the other, each for as long as its bits take, none across
// the end of a frame of 1 ms. What the device is not ready for is asked again until it is.

const FRAME_NANOS = 1e6;
const BYTE_NANOS = 8e9 / 12e6;
/** Bytes of a transaction beside its data: synchronisation, identifiers, address, checks, gaps (USB 2.0, 5.8.4). So a frame
 * holds 19 packets of 64 bytes. Stuffed bits are not counted. */
const OVERHEAD = 13;
/** Start of a frame, and the gap before the first transaction. */
const START_NANOS = 6 * BYTE_NANOS;
/** From "not ready" to the next question. */
const AGAIN_NANOS = OVERHEAD * BYTE_NANOS;

export class Bus {
  /** `next()` gives the transaction that is to be done now, or none: `{ bytes, done() }`. */
  constructor(clock, next) {
    Object.assign(this, { clock, next, under: undefined });
    this.alarm = clock.createAlarm(() => this.ring());
    this.waiting = false;
  }

  /** Something has changed: there may be a transaction to do. */
  wake() {
    if (this.under !== undefined || this.waiting) return;
    this.waiting = true;
    this.alarm.schedule(AGAIN_NANOS);
  }

  /** Whatever is under way is lost. */
  drop() {
    this.alarm.cancel();
    this.under = undefined;
    this.waiting = false;
  }

  ring() {
    const done = this.under;
    this.under = undefined;
    this.waiting = false;
    done?.();
    this.begin();
  }

  begin() {
    if (this.under !== undefined || this.waiting) return;
    const transaction = this.next();
    if (transaction === undefined) return;
    const nanos = (OVERHEAD + transaction.bytes) * BYTE_NANOS;
    const now = this.clock.nanosCounter % FRAME_NANOS;
    if (now < START_NANOS) return this.pause(START_NANOS - now);
    if (now + nanos > FRAME_NANOS) return this.pause(FRAME_NANOS - now + START_NANOS);
    this.under = transaction.done;
    this.alarm.schedule(nanos);
  }

  pause(nanos) {
    this.waiting = true;
    this.alarm.schedule(nanos);
  }
}
