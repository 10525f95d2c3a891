// A full-speed bus with one device on it: transactions one after the other, each for as long as its bits take, none across
// the end of a frame of 1 ms. What the device is not ready for is asked again until it is.

const FRAME_NANOS = 1e6, NUMBERS = 0x7ff;
const BYTE_NANOS = 8e9 / 12e6;
/** Bytes of a transaction beside its data: synchronisation, identifiers, address, checks, gaps (USB 2.0, 5.8.4). So a frame
 * holds 19 packets of 64 bytes. Stuffed bits are not counted. */
const OVERHEAD = 13;
/** Start of a frame, and the gap before the first transaction. */
const START_NANOS = 6 * BYTE_NANOS;
/** From "not ready" to the next question. */
const AGAIN_NANOS = OVERHEAD * BYTE_NANOS;

/**
 * The frames of a host controller by the board's clock. That is fast by `ppm`, and by up to `wander` ppm more or less in the
 * course of `period` s; frame 0 has the number `first`.
 */
export class Frames {
  constructor({ first = 0, ppm = 0, wander = 0, period = 60 } = {}) {
    Object.assign(this, { first, ppm, wander, period: period * 1e9 });
    this.running = 0;
  }

  /** When a frame starts, ns of the board. */
  startOf(frame) {
    const nanos = frame * FRAME_NANOS, { ppm, wander, period } = this;
    const turn = 2 * Math.PI * nanos / period;
    return nanos * (1 + ppm * 1e-6) + wander * 1e-6 * period / (2 * Math.PI) * (1 - Math.cos(turn));
  }

  /** Start and end of the frame that runs, ns. */
  span(now) {
    // Clocks count whole nanoseconds.
    while (this.startOf(this.running + 1) < now + 1) this.running++;
    return [this.startOf(this.running), this.startOf(this.running + 1)];
  }

  /** Number of the frame that runs. */
  get number() {
    return (this.first + this.running) & NUMBERS;
  }
}

export class Bus {
  /** `next()` gives the transaction that is to be done now, or none: `{ bytes, done() }`. `onStart(number)`: a frame starts. */
  constructor(clock, next, onStart = () => {}, frames = new Frames()) {
    Object.assign(this, { clock, next, onStart, frames, under: undefined });
    this.alarm = clock.createAlarm(() => this.ring());
    this.start = clock.createAlarm(() => this.starts());
    this.waiting = false;
  }

  /** A host drives the bus: frames start. */
  drive() {
    const [, end] = this.frames.span(this.clock.nanosCounter);
    this.start.schedule(end - this.clock.nanosCounter);
  }

  /** No host drives it any longer. */
  rest() {
    this.start.cancel();
  }

  starts() {
    this.drive();
    this.onStart(this.frames.number);
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
    const now = this.clock.nanosCounter;
    const [start, end] = this.frames.span(now);
    if (now < start + START_NANOS) return this.pause(start + START_NANOS - now);
    if (now + nanos > end) return this.pause(end - now + START_NANOS);
    this.under = transaction.done;
    this.alarm.schedule(nanos);
  }

  pause(nanos) {
    this.waiting = true;
    this.alarm.schedule(nanos);
  }
}
