// The RP2040's USB controller as a device: endpoints whose buffers the firmware arms, and whatever a host does with them.
// rp2040js takes an armed buffer at once, knows no time, and clears AVAILABLE before anything has been received.

import { BasePeripheral } from 'rp2040js';

const ADDR_ENDP = 0x00, MAIN_CTRL = 0x40, SOF_RD = 0x48, SIE_CTRL = 0x4c, SIE_STATUS = 0x50, INT_EP_CTRL = 0x54, BUFF_STATUS = 0x58;
const EP_STALL_ARM = 0x68, MUXING = 0x74, PWR = 0x78, INTR = 0x8c, INTE = 0x90, INTF = 0x94, INTS = 0x98;
// Registers that nothing here depends on.
const KEPT = [0x44, 0x5c, 0x60, 0x64, 0x6c, 0x70, 0x7c, 0x80, 0x84, 0x88];
const LAST_REGISTER = 0x98;

const CONTROLLER_EN = 1 << 0, PULLUP_EN = 1 << 16, EP0_INT_1BUF = 1 << 29;
const STATUS_VBUS = 1 << 0, STATUS_SUSPENDED = 1 << 4, STATUS_RESUME = 1 << 11, STATUS_CONNECTED = 1 << 16;
const STATUS_SETUP = 1 << 17, STATUS_RESET = 1 << 19;
const INT_BUFFER = 1 << 4, INT_RESET = 1 << 12, INT_SUSPEND = 1 << 14, INT_RESUME = 1 << 15, INT_SETUP = 1 << 16;
const INT_SOF = 1 << 17;
export const USB_IRQ = 5;

// Memory of the controller: setup packet, controls of endpoints 1 to 15, buffer controls of 0 to 15, buffers.
const ENDPOINT_CONTROL = 0x08, BUFFER_CONTROL = 0x80, BUFFER_CONTROL_END = 0x100, EP0_BUFFER = 0x100;
const ENABLE = 1 << 31, INT_PER_BUFFER = 1 << 29, ADDRESS_MASK = 0xffc0;
const FULL = 1 << 15, DATA1 = 1 << 13, STALL = 1 << 11, AVAILABLE = 1 << 10, LENGTH_MASK = 0x3ff;

export class Usb extends BasePeripheral {
  constructor(rp2040) {
    super(rp2040, 'USB');
    this.memory = rp2040.usbDPRAMView;
    this.registers = new Map(KEPT.map((register) => [register, 0]));
    this.address = this.mainControl = this.control = this.status = this.buffers = this.stallArmed = 0;
    this.endpointInterrupts = this.muxing = this.power = this.enabled = this.forced = 0;
    this.suspendChanged = this.started = false;
    this.frame = 0;
    /** Called when the firmware has armed a buffer, or has come or gone. */
    this.onChange = () => {};
  }

  /** Whether the board shows that it is there. */
  get attached() {
    return (this.mainControl & CONTROLLER_EN) !== 0 && (this.control & PULLUP_EN) !== 0;
  }

  // What a host does.

  /** A frame of this number starts. */
  start(number) {
    this.frame = number;
    this.started = true;
    this.update();
  }

  reset() {
    this.status &= ~STATUS_SUSPENDED;
    this.set(STATUS_RESET | STATUS_CONNECTED);
  }

  /** Nothing has moved for 3 ms. */
  suspend() {
    this.suspendChanged = true;
    this.set(STATUS_SUSPENDED);
  }

  resume() {
    this.status &= ~STATUS_SUSPENDED;
    this.set(STATUS_RESUME);
  }

  setup(packet) {
    packet.forEach((byte, i) => this.memory.setUint8(i, byte));
    this.stallArmed = 0;
    this.set(STATUS_SETUP);
  }

  /** What the endpoint would answer: 'nak', 'stall', 'silence', or how many bytes are there or may come. */
  ask(address, endpoint, out) {
    const control = endpoint === 0 ? ENABLE : this.memory.getUint32(this.controlOf(endpoint, out), true);
    if (address !== this.address || !this.attached || !(control & ENABLE)) return 'silence';
    const [, value] = this.buffer(endpoint, out);
    if (value & STALL && (endpoint !== 0 || this.stallArmed & (1 << out))) return 'stall';
    return value & AVAILABLE ? value & LENGTH_MASK : 'nak';
  }

  /** The packet of an IN endpoint that is ready: its bytes, and whether it is DATA1. */
  in(endpoint) {
    const [at, value] = this.buffer(endpoint, 0);
    const start = this.bufferOf(endpoint, 0);
    const data = this.rp2040.usbDPRAM.slice(start, start + (value & LENGTH_MASK));
    this.memory.setUint32(at, value & ~(AVAILABLE | FULL), true);
    this.filled(endpoint, 0);
    return { data, odd: (value & DATA1) !== 0 };
  }

  /** Gives a packet to an OUT endpoint that is ready. */
  out(endpoint, data, odd) {
    const [at, value] = this.buffer(endpoint, 1);
    if (((value & DATA1) !== 0) !== odd) return; // It was taken before, and the host did not hear so.
    if (data.length > (value & LENGTH_MASK)) this.warn(`${data.length} bytes for a buffer of ${value & LENGTH_MASK}`);
    this.rp2040.usbDPRAM.set(data, this.bufferOf(endpoint, 1));
    this.memory.setUint32(at, (value & ~(AVAILABLE | LENGTH_MASK)) | FULL | data.length, true);
    this.filled(endpoint, 1);
  }

  buffer(endpoint, out) {
    const at = BUFFER_CONTROL + 8 * endpoint + 4 * out;
    return [at, this.memory.getUint32(at, true)];
  }

  filled(endpoint, out) {
    const interrupts = endpoint === 0
      ? this.control & EP0_INT_1BUF
      : this.memory.getUint32(this.controlOf(endpoint, out), true) & INT_PER_BUFFER;
    if (interrupts) this.buffers |= 1 << (2 * endpoint + out);
    this.update();
  }

  controlOf(endpoint, out) {
    return ENDPOINT_CONTROL + 8 * (endpoint - 1) + 4 * out;
  }

  bufferOf(endpoint, out) {
    return endpoint === 0 ? EP0_BUFFER : this.memory.getUint32(this.controlOf(endpoint, out), true) & ADDRESS_MASK;
  }

  // What the firmware sees.

  set(bits) {
    this.status |= bits;
    this.update();
  }

  get raw() {
    const { status } = this;
    return (this.buffers !== 0 ? INT_BUFFER : 0) | (status & STATUS_RESET ? INT_RESET : 0) |
      (this.suspendChanged ? INT_SUSPEND : 0) | (status & STATUS_RESUME ? INT_RESUME : 0) | (status & STATUS_SETUP ? INT_SETUP : 0) |
      (this.started ? INT_SOF : 0);
  }

  get pending() {
    return (this.raw & this.enabled) | this.forced;
  }

  update() {
    this.rp2040.setInterrupt(USB_IRQ, this.pending !== 0);
  }

  /** rp2040js calls this for what is written to the controller's memory. */
  DPRAMUpdated(offset, value) {
    if (offset >= BUFFER_CONTROL && offset < BUFFER_CONTROL_END && value & (AVAILABLE | STALL)) this.onChange();
  }

  readUint32(offset) {
    switch (offset) {
      case ADDR_ENDP: return this.address;
      case MAIN_CTRL: return this.mainControl;
      case SOF_RD: return this.heard();
      case SIE_CTRL: return this.control;
      case SIE_STATUS: return this.status | STATUS_VBUS;
      case INT_EP_CTRL: return this.endpointInterrupts;
      case BUFF_STATUS: return this.buffers;
      case EP_STALL_ARM: return this.stallArmed;
      case MUXING: return this.muxing;
      case PWR: return this.power;
      case INTR: return this.raw;
      case INTE: return this.enabled;
      case INTF: return this.forced;
      case INTS: return this.pending;
      default: return this.registers.get(offset) ?? this.unknown(offset) ?? super.readUint32(offset);
    }
  }

  /** Reading the number ends the interrupt. */
  heard() {
    this.started = false;
    this.update();
    return this.frame;
  }

  /** Addresses of interrupt endpoints, which only a host has. */
  unknown(offset) {
    return offset < MAIN_CTRL ? 0 : undefined;
  }

  writeUint32(offset, value) {
    switch (offset) {
      case ADDR_ENDP: this.address = value & 0x7f; break;
      case MAIN_CTRL: this.mainControl = value; break;
      case SIE_CTRL: this.control = value; break;
      case SIE_STATUS: this.acknowledge(this.rawWriteValue); break;
      case INT_EP_CTRL: this.endpointInterrupts = value; return;
      case BUFF_STATUS: this.buffers &= ~this.rawWriteValue; break;
      case EP_STALL_ARM: this.stallArmed = value & 3; break;
      case MUXING: this.muxing = value; return;
      case PWR: this.power = value; return;
      case INTE: this.enabled = value; break;
      case INTF: this.forced = value; break;
      case INTR: case INTS: return;
      default:
        if (offset > LAST_REGISTER) return super.writeUint32(offset, value);
        if (this.registers.has(offset)) this.registers.set(offset, value);
    }
    this.update();
    if (offset === MAIN_CTRL || offset === SIE_CTRL || offset === EP_STALL_ARM) this.onChange();
  }

  acknowledge(bits) {
    this.status &= ~(bits & (STATUS_RESET | STATUS_SETUP | STATUS_RESUME | STATUS_CONNECTED));
    if (bits & STATUS_SUSPENDED) this.suspendChanged = false;
  }
}
