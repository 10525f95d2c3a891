// The garment on the board's pins: multiplexer lines form an address word, the address and the converter's input name a
// taxel, and the taxel's code comes from a list of frames.

import { readFileSync } from 'node:fs';

const UNMAPPED = -1;
const FIRST_ADC_PIN = 26;
const SCAN_GAP_NANOS = 1e6;
// The converter's channel of its own thermometer, and its code at 27 degrees: 0.706 V of 3.3 V.
const THERMOMETER = 4, ROOM = 876;

/** Reads the wiring that the Rust host wrote; see README.md for its format. */
export function readWiring(path) {
  const wiring = JSON.parse(readFileSync(path, 'utf8'));
  for (const name of ['lines', 'inputs', 'taxels', 'count']) {
    if (wiring[name] === undefined) throw new Error(`${path}: "${name}" is missing`);
  }
  if (wiring.taxels.length > 2 ** wiring.lines.length) {
    throw new Error(`${path}: ${wiring.taxels.length} addresses do not fit ${wiring.lines.length} lines`);
  }
  return wiring;
}

/** Reads frames of `count` codes each, u16 little endian. */
export function readFrames(path, count) {
  const bytes = readFileSync(path);
  if (bytes.length === 0 || bytes.length % (2 * count) !== 0) {
    throw new Error(`${path}: ${bytes.length} bytes are no whole number of frames of ${count} codes`);
  }
  const codes = Uint16Array.from({ length: bytes.length / 2 }, (_, i) => bytes.readUInt16LE(2 * i));
  return Array.from({ length: codes.length / count }, (_, i) => codes.subarray(i * count, (i + 1) * count));
}

export class Garment {
  /**
   * `readPin(number)` is the level a pin drives, or undefined when it does not drive; `now()` is the board's time in ns.
   * Each frame is shown by `dwell` scans, or for `period` ns whatever the scans do. `playing`: whether the frames run from the first scan on, or wait for `play()` and show `idle` until then.
   */
  constructor({ wiring, frames = [], idle = 0, loop = false, dwell = 1, period, playing = true, readPin, now = () => 0, onPlay = () => {}, onScan = () => {} }) {
    Object.assign(this, { frames, idle, loop, dwell, period, readPin, now, onPlay, onScan });
    this.lines = wiring.lines;
    this.table = tableOf(wiring);
    this.seen = new Int32Array(this.table.length).fill(-1);
    this.shown = new Int32Array(wiring.count).fill(-1); // by taxel, the scan that read it last
    this.scan = 0;
    this.address = -1;
    this.last = 0;
    this.firstPlayed = playing ? 0 : Infinity;
    this.begun = 0;
    this.wanted = false;
    this.floating = 0;
  }

  /** Lets the frames begin with the next scan, once more where they have begun already. */
  play() {
    this.wanted = true;
    this.firstPlayed = Infinity;
  }

  /** The scans that have shown a frame of the list, the one under way included. */
  get played() {
    return Math.max(0, this.scan - this.firstPlayed + (this.address < 0 ? 0 : 1));
  }

  /** The code of the converter's channel under the present levels of the lines. */
  sample(channel) {
    const address = this.readAddress();
    if (address !== this.address || this.now() - this.last > SCAN_GAP_NANOS) this.moveTo(address);
    this.last = this.now();
    if (channel === THERMOMETER) return ROOM;
    const taxel = this.taxelAt(address, channel);
    if (taxel !== UNMAPPED) this.shown[taxel] = this.scan;
    return this.codeOf(taxel);
  }

  /** The same, where the board looks at its wires and does not scan. */
  peek(channel) {
    return this.codeOf(this.taxelAt(this.readAddress(), channel));
  }

  taxelAt(address, channel) {
    return channel < 4 ? this.table[(address << 2) | channel] : UNMAPPED;
  }

  codeOf(taxel) {
    if (taxel === UNMAPPED) return this.idle;
    const at = this.period === undefined ? this.frameOf(this.scan) : this.frameAt(this.now());
    return at?.[taxel] ?? this.idle;
  }

  /** The frame that a scan shows; undefined before the frames begin. */
  frameOf(scan) {
    const at = Math.floor((scan - this.firstPlayed) / this.dwell);
    if (this.frames.length === 0 || at < 0) return undefined;
    return this.frames[this.loop ? at % this.frames.length : Math.min(at, this.frames.length - 1)];
  }

  /** The frame that is shown at a time, where time and not the scans lead from one to the next. */
  frameAt(now) {
    if (this.scan < this.firstPlayed) return undefined;
    return this.frames[Math.min(Math.floor((now - this.begun) / this.period), this.frames.length - 1)];
  }

  /**
   * A scan ends where the lines come back to an address that was already converted in it, or where nothing has been
   * converted for a while (the next scan may read other blocks). Reading one address several times without leaving it
   * (averaging) stays in the scan.
   */
  moveTo(address) {
    const entry = address << 2;
    const pause = this.address >= 0 && this.now() - this.last > SCAN_GAP_NANOS;
    if (pause || this.seen[entry] === this.scan) {
      this.scan++;
      this.onScan(this.scan);
      if (this.wanted && this.firstPlayed === Infinity) {
        this.wanted = false;
        this.firstPlayed = this.scan;
        this.begun = this.now();
        this.onPlay(this.scan);
      }
    }
    this.seen[entry] = this.scan;
    this.address = address;
  }

  readAddress() {
    let address = 0;
    for (let bit = 0; bit < this.lines.length; bit++) {
      const { pin, inverted } = this.lines[bit];
      const level = this.readPin(pin);
      if (level === undefined) this.floating++;
      else if (level !== inverted) address |= 1 << bit;
    }
    return address;
  }
}

/** Taxels by address and channel (four channels an address), for every address that the lines can form. */
function tableOf({ lines, inputs, taxels, count }) {
  const table = new Int32Array(4 << lines.length).fill(UNMAPPED);
  taxels.forEach((row, address) => row.forEach((taxel, input) => {
    if (taxel === null || taxel < 0) return;
    if (taxel >= count) throw new Error(`wiring: taxel ${taxel} at address ${address} is not below ${count}`);
    table[(address << 2) | (inputs[input] - FIRST_ADC_PIN)] = taxel;
  }));
  return table;
}
