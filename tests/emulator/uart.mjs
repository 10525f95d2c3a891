// A PL011 as on the RP2040: 32-entry FIFOs, interrupt levels, receive time-out, and bytes that take their time.
// rp2040js has no pacing, no levels, and a transmit interrupt that never ends: buffered drivers storm on it.

import { BasePeripheral, FIFO } from 'rp2040js';

const DR = 0x00, RSR = 0x04, FR = 0x18, IBRD = 0x24, FBRD = 0x28, LCR_H = 0x2c, CR = 0x30, IFLS = 0x34;
const IMSC = 0x38, RIS = 0x3c, MIS = 0x40, ICR = 0x44, DMACR = 0x48;

const FR_BUSY = 1 << 3, FR_RXFE = 1 << 4, FR_TXFF = 1 << 5, FR_RXFF = 1 << 6, FR_TXFE = 1 << 7;
const CR_ENABLE = 1 << 0, CR_TX = 1 << 8, CR_RX = 1 << 9;
const LCR_PARITY = 1 << 1, LCR_TWO_STOP_BITS = 1 << 3, LCR_FIFOS = 1 << 4;
const DR_OVERRUN = 1 << 11;
const INT_RX = 1 << 4, INT_TX = 1 << 5, INT_RX_TIMEOUT = 1 << 6, INT_OVERRUN = 1 << 10;
const DMA_RX = 1 << 0, DMA_TX = 1 << 1;
const FIFO_DEPTH = 32;
// Trigger levels in entries by the three-bit code of IFLS: 1/8, 1/4, 1/2, 3/4, 7/8; other codes are reserved.
const LEVELS = [4, 8, 16, 24, 28, 28, 28, 28];
const TIMEOUT_BITS = 32;

export class Uart extends BasePeripheral {
  /** `onByte(byte)` is called when the last bit of a byte has left. */
  constructor(rp2040, name, irq, dreq, onByte) {
    super(rp2040, name);
    Object.assign(this, { irq, dreq, onByte });
    this.registers = new Map([[IBRD, 0], [FBRD, 0], [LCR_H, 0], [CR, CR_TX | CR_RX], [IFLS, 0x12], [DMACR, 0]]);
    this.rxFifo = new FIFO(FIFO_DEPTH);
    this.txFifo = new FIFO(FIFO_DEPTH);
    this.shifting = -1;
    this.wire = [];
    this.wireAt = 0;
    this.raw = 0;
    this.mask = 0;
    this.overrun = false;
    this.overruns = 0;
    this.sent = 0;
    this.txAlarm = rp2040.clock.createAlarm(() => this.transmitted());
    this.rxAlarm = rp2040.clock.createAlarm(() => this.received());
    this.timeoutAlarm = rp2040.clock.createAlarm(() => this.raise(INT_RX_TIMEOUT));
  }

  /** Puts bytes on the receive line; they arrive one after the other at the line's speed. */
  receive(bytes) {
    const idle = this.wireAt === this.wire.length;
    if (idle) {
      this.wire = [...bytes];
      this.wireAt = 0;
      if (this.wire.length > 0) this.rxAlarm.schedule(this.byteNanos);
    } else {
      for (const byte of bytes) this.wire.push(byte);
    }
  }

  get bitNanos() {
    const divider = this.registers.get(IBRD) + this.registers.get(FBRD) / 64;
    // Before the firmware has set a speed nothing can be read from the line: let it pass at 115,200 Bd.
    return divider === 0 ? 1e9 / 115200 : (16e9 * divider) / this.rp2040.clkPeri;
  }

  get byteNanos() {
    const line = this.registers.get(LCR_H);
    const data = 5 + ((line >>> 5) & 3);
    return this.bitNanos * (1 + data + (line & LCR_PARITY ? 1 : 0) + (line & LCR_TWO_STOP_BITS ? 2 : 1));
  }

  get depth() {
    return this.registers.get(LCR_H) & LCR_FIFOS ? FIFO_DEPTH : 1;
  }

  get rxLevel() {
    return this.depth === 1 ? 1 : LEVELS[(this.registers.get(IFLS) >>> 3) & 7];
  }

  get txLevel() {
    return this.depth === 1 ? 0 : LEVELS[this.registers.get(IFLS) & 7];
  }

  enabled(direction) {
    const control = this.registers.get(CR);
    return (control & CR_ENABLE) !== 0 && (control & direction) !== 0;
  }

  received() {
    const byte = this.wire[this.wireAt++];
    if (this.wireAt < this.wire.length) this.rxAlarm.schedule(this.byteNanos);
    if (!this.enabled(CR_RX)) return;
    if (this.rxFifo.itemCount >= this.depth) {
      this.overrun = true;
      this.overruns++;
      this.raise(INT_OVERRUN);
      return;
    }
    this.rxFifo.push(byte | (this.overrun ? DR_OVERRUN : 0));
    this.overrun = false;
    this.timeoutAlarm.schedule(this.bitNanos * TIMEOUT_BITS);
    if (this.rxFifo.itemCount >= this.rxLevel) this.raise(INT_RX);
    this.update();
  }

  read() {
    const entry = this.rxFifo.pull();
    if (this.rxFifo.itemCount < this.rxLevel) this.raw &= ~INT_RX;
    if (this.rxFifo.empty) {
      this.timeoutAlarm.cancel();
      this.raw &= ~INT_RX_TIMEOUT;
    } else {
      this.timeoutAlarm.schedule(this.bitNanos * TIMEOUT_BITS);
    }
    this.update();
    return entry;
  }

  write(byte) {
    if (!this.enabled(CR_TX)) this.warn('byte written while the transmitter is off');
    if (this.txFifo.itemCount >= this.depth) {
      this.warn('byte written to a full transmit FIFO');
      return;
    }
    this.txFifo.push(byte);
    if (this.txFifo.itemCount > this.txLevel) this.raw &= ~INT_TX;
    if (this.shifting < 0) this.shift();
    this.update();
  }

  /** Moves the next byte from the FIFO to the shift register; the interrupt is raised on the way down through the level. */
  shift() {
    if (this.txFifo.empty) return;
    this.shifting = this.txFifo.pull();
    this.txAlarm.schedule(this.byteNanos);
    if (this.txFifo.itemCount === this.txLevel) this.raise(INT_TX);
  }

  transmitted() {
    const byte = this.shifting;
    this.shifting = -1;
    this.sent++;
    this.shift();
    // Without FIFOs or at level 0 the last byte itself crosses the level.
    if (this.shifting < 0 && this.txLevel === 0) this.raise(INT_TX);
    this.update();
    this.onByte(byte);
  }

  raise(interrupt) {
    this.raw |= interrupt;
    this.update();
  }

  update() {
    this.rp2040.setInterrupt(this.irq, (this.raw & this.mask) !== 0);
    const control = this.registers.get(DMACR);
    this.request(this.dreq.tx, control & DMA_TX && this.txFifo.itemCount < this.depth);
    this.request(this.dreq.rx, control & DMA_RX && !this.rxFifo.empty);
  }

  request(dreq, wanted) {
    if (wanted) this.rp2040.dma.setDREQ(dreq);
    else this.rp2040.dma.clearDREQ(dreq);
  }

  get flags() {
    const { rxFifo, txFifo, depth } = this;
    return (this.shifting >= 0 || !txFifo.empty ? FR_BUSY : 0) | (rxFifo.empty ? FR_RXFE : 0) |
      (txFifo.itemCount >= depth ? FR_TXFF : 0) | (rxFifo.itemCount >= depth ? FR_RXFF : 0) | (txFifo.empty ? FR_TXFE : 0);
  }

  readUint32(offset) {
    switch (offset) {
      case DR: return this.read();
      case RSR: return 0;
      case FR: return this.flags;
      case IMSC: return this.mask;
      case RIS: return this.raw;
      case MIS: return this.raw & this.mask;
      case ICR: return 0;
      default: return this.registers.get(offset) ?? super.readUint32(offset);
    }
  }

  writeUint32(offset, value) {
    switch (offset) {
      case DR: return this.write(value & 0xff);
      case RSR: return;
      case IMSC: this.mask = value & 0x7ff; break;
      case ICR: this.raw &= ~value; break;
      default:
        if (!this.registers.has(offset)) return super.writeUint32(offset, value);
        this.registers.set(offset, value);
    }
    this.update();
  }
}
