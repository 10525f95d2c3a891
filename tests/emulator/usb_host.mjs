// A computer on the board's USB: it finds out what the board is, opens its serial port, and moves bytes both ways.

import { Bus, Frames } from './usb_bus.mjs';

const MILLISECOND = 1e6;
const RESET_NANOS = 10 * MILLISECOND, RECOVERY_NANOS = 2 * MILLISECOND, SUSPEND_NANOS = 3 * MILLISECOND;
const PACKET = 64;
/** What is read at once ends with a packet that is not full, or with so many bytes, as Linux has it. */
const READ = 128;
const ADDRESS = 1;
const DEVICE = 1, CONFIGURATION = 2, STRING = 3, INTERFACE = 4, ENDPOINT = 5;
const GET_DESCRIPTOR = 6, SET_ADDRESS = 5, SET_CONFIGURATION = 9, SET_LINE_CODING = 0x20, SET_LINES = 0x22;
const FROM_DEVICE = 0x80, TO_CLASS_INTERFACE = 0x21;
const COMMUNICATION = 2, BULK = 2, DTR_AND_RTS = 3;

export class UsbHost {
  /**
   * `onBytes(bytes)`: they came from the port. `onKnown(what)`: what the board says it is. `fail(text)`: it does what it must not.
   * `frames`: those of the bus, as of `Frames`.
   */
  constructor(chip, { onBytes, onKnown = () => {}, fail, frames }) {
    Object.assign(this, { clock: chip.clock, device: chip.usbCtrl, onBytes, onKnown, fail });
    this.bus = new Bus(this.clock, () => this.next(), (number) => this.device.start(number), new Frames(frames));
    this.pause = this.clock.createAlarm(() => this.advance());
    this.sleep = this.clock.createAlarm(() => this.device.suspend());
    this.device.onChange = () => this.changed();
    this.plugged = this.wanted = false;
    this.reads = true; // the program that has the port open takes what comes
    this.packets = { in: 0, out: 0, empty: 0 };
    this.forget();
  }

  forget() {
    this.bus.drop();
    this.pause.cancel();
    Object.assign(this, { address: 0, pipes: undefined, controls: [], stage: undefined, out: [], read: [], odd: { in: false, out: false }, opened: false });
  }

  // What people and programs do.

  plug() {
    this.plugged = true;
    this.sleep.cancel();
    this.bus.drive();
    this.changed();
  }

  unplug() {
    this.plugged = false;
    this.bus.rest();
    this.forget();
    this.sleep.schedule(SUSPEND_NANOS);
  }

  /** A program opens the port, or closes it. */
  open(wanted) {
    this.wanted = wanted;
    if (this.pipes !== undefined) this.queue(this.setLines());
  }

  /** The program that has the port open reads, or does something else. */
  follow(reads) {
    this.reads = reads;
    this.bus.wake();
  }

  /** Bytes for the port. */
  send(bytes) {
    for (const byte of bytes) this.out.push(byte);
    this.bus.wake();
  }

  // What happens on the bus.

  changed() {
    if (!this.plugged || !this.device.attached) return;
    if (this.pipes === undefined && this.controls.length === 0) this.queue(this.enumerate());
    this.bus.wake();
  }

  queue(control) {
    this.controls.push(control);
    if (this.controls.length === 1) this.advance();
  }

  /** Goes on with the control transfers, whose last stage has brought `result`. */
  advance(result) {
    this.stage = undefined;
    while (this.controls.length > 0) {
      const { value, done } = this.controls[0].next(result);
      if (!done && value.pause !== undefined) return this.pause.schedule(value.pause);
      if (!done) {
        this.stage = value;
        return this.bus.wake();
      }
      this.controls.shift();
      result = undefined;
    }
  }

  next() {
    return this.control() ?? this.bulkOut() ?? this.bulkIn();
  }

  ready(endpoint, out) {
    const answer = this.device.ask(this.address, endpoint, out);
    if (answer === 'stall') this.fail(`endpoint ${endpoint} is stalled`);
    return typeof answer === 'number' ? answer : undefined;
  }

  control() {
    const { stage, device } = this;
    if (stage === undefined) return undefined;
    const { setup, out, odd } = stage;
    if (setup !== undefined) return { bytes: setup.length, done: () => this.advance(device.setup(setup)) };
    const bytes = this.ready(0, out === undefined ? 0 : 1);
    if (bytes === undefined) return undefined;
    if (out !== undefined) return { bytes: out.length, done: () => this.advance(device.out(0, out, odd)) };
    return { bytes, done: () => this.advance(device.in(0).data) };
  }

  bulkOut() {
    if (this.pipes === undefined || this.out.length === 0 || this.ready(this.pipes.out, 1) === undefined) return undefined;
    const bytes = Math.min(PACKET, this.out.length);
    return { bytes, done: () => {
      this.packets.out++;
      this.device.out(this.pipes.out, Uint8Array.from(this.out.splice(0, bytes)), this.odd.out);
      this.odd.out = !this.odd.out;
    } };
  }

  bulkIn() {
    if (this.pipes === undefined || !this.opened || !this.reads) return undefined;
    const bytes = this.ready(this.pipes.in, 0);
    return bytes === undefined ? undefined : { bytes, done: () => this.take(this.device.in(this.pipes.in)) };
  }

  take({ data, odd }) {
    if (odd !== this.odd.in) this.fail('a packet of the port has the other toggle');
    this.odd.in = !this.odd.in;
    this.packets.in++;
    this.packets.empty += data.length === 0;
    this.read.push(...data);
    if (data.length < PACKET || this.read.length >= READ) this.onBytes(this.read.splice(0));
  }

  // What the computer says to the board.

  *enumerate() {
    yield { pause: RESET_NANOS };
    this.device.reset();
    yield { pause: RECOVERY_NANOS };
    yield* this.write(0, SET_ADDRESS, ADDRESS, 0);
    yield { pause: RECOVERY_NANOS };
    this.address = ADDRESS;
    const device = yield* this.descriptor(DEVICE, 0, 18);
    const short = yield* this.descriptor(CONFIGURATION, 0, 9);
    const configuration = yield* this.descriptor(CONFIGURATION, 0, short.getUint16(2, true));
    const name = yield* this.text(device.getUint8(15));
    const number = yield* this.text(device.getUint8(16));
    yield* this.write(0, SET_CONFIGURATION, configuration.getUint8(5), 0);
    this.pipes = pipesOf(configuration);
    this.odd = { in: false, out: false };
    const hex = (value) => value.toString(16).padStart(4, '0');
    this.onKnown({ id: `${hex(device.getUint16(8, true))}:${hex(device.getUint16(10, true))}`, name, number, ...this.pipes });
    yield* this.setLines();
  }

  *setLines() {
    const wanted = this.wanted;
    if (wanted) yield* this.write(TO_CLASS_INTERFACE, SET_LINE_CODING, 0, this.pipes.interface, [0, 0x10, 0x0e, 0, 0, 0, 8]);
    yield* this.write(TO_CLASS_INTERFACE, SET_LINES, wanted ? DTR_AND_RTS : 0, this.pipes.interface);
    this.opened = wanted;
    if (!wanted) this.read.length = 0;
  }

  *write(type, request, value, index, data = []) {
    yield { setup: packet(type, request, value, index, data.length) };
    if (data.length > 0) yield { out: Uint8Array.from(data), odd: true };
    yield {};
  }

  /** A text of the device; null if it has none. */
  *text(index) {
    return index === 0 ? null : textOf(yield* this.descriptor(STRING, index, 255));
  }

  *descriptor(kind, index, length) {
    yield { setup: packet(FROM_DEVICE, GET_DESCRIPTOR, (kind << 8) | index, kind === STRING ? 0x0409 : 0, length) };
    const data = [];
    for (let last = PACKET; last === PACKET && data.length < length;) {
      const piece = yield {};
      data.push(...piece);
      last = piece.length;
    }
    yield { out: new Uint8Array(0), odd: true };
    return new DataView(Uint8Array.from(data).buffer);
  }
}

function packet(type, request, value, index, length) {
  const view = new DataView(new ArrayBuffer(8));
  view.setUint8(0, type);
  view.setUint8(1, request);
  [value, index, length].forEach((word, i) => view.setUint16(2 + 2 * i, word, true));
  return new Uint8Array(view.buffer);
}

/** Interface and endpoints of the serial port. */
function pipesOf(descriptors) {
  const pipes = {};
  for (let at = 0; at < descriptors.byteLength; at += descriptors.getUint8(at)) {
    const byte = (offset) => descriptors.getUint8(at + offset);
    if (byte(1) === INTERFACE && byte(5) === COMMUNICATION) pipes.interface = byte(2);
    if (byte(1) === ENDPOINT && (byte(3) & 3) === BULK) pipes[byte(2) & 0x80 ? 'in' : 'out'] = byte(2) & 0xf;
  }
  return pipes;
}

function textOf(descriptor) {
  const units = (descriptor.byteLength - 2) / 2;
  return String.fromCharCode(...Array.from({ length: units }, (_, i) => descriptor.getUint16(2 + 2 * i, true)));
}
