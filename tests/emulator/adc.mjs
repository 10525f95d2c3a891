// The RP2040's converter: 96 clocks of 48 MHz a conversion, START_ONCE that clears itself, a FIFO whose interrupt and
// DMA request follow its level. rp2040js leaves START_ONCE set, keeps requests up, and only ever selects channel 0 or 4.

import { BasePeripheral, FIFO } from 'rp2040js';

const CS = 0x00, RESULT = 0x04, FCS = 0x08, FIFO_OUT = 0x0c, DIV = 0x10, INTR = 0x14, INTE = 0x18, INTF = 0x1c, INTS = 0x20;

const CS_EN = 1 << 0, CS_TS_EN = 1 << 1, CS_START_ONCE = 1 << 2, CS_START_MANY = 1 << 3, CS_READY = 1 << 8;
const CS_AINSEL_SHIFT = 12, CS_RROBIN_SHIFT = 16;
const CS_KEPT = CS_EN | CS_TS_EN | CS_START_MANY | (7 << CS_AINSEL_SHIFT) | (31 << CS_RROBIN_SHIFT);
const FCS_EN = 1 << 0, FCS_SHIFT = 1 << 1, FCS_DREQ_EN = 1 << 3, FCS_EMPTY = 1 << 8, FCS_FULL = 1 << 9;
const FCS_UNDER = 1 << 10, FCS_OVER = 1 << 11, FCS_THRESH_SHIFT = 24;
const FCS_KEPT = 0xf | (0xf << FCS_THRESH_SHIFT);
const ADC_IRQ = 22, ADC_DREQ = 36;
const CLOCK_HZ = 48e6;
const CONVERSION_CLOCKS = 96;
const CHANNELS = 5;

export class Adc extends BasePeripheral {
  /** `sample(channel)` gives the 12-bit code of a channel (0 to 3 are GPIO 26 to 29, 4 is the thermometer). */
  constructor(rp2040, sample) {
    super(rp2040, 'ADC');
    this.sample = sample;
    this.fifo = new FIFO(4);
    this.cs = this.fcs = this.div = this.intEnable = this.intForce = this.result = this.held = 0;
    this.busy = false;
    /** Samples that are still to be lost, as if nobody had emptied the FIFO in time. */
    this.starved = 0;
    /** Nothing is converted any more. */
    this.stalled = false;
    this.conversions = 0;
    this.doneAlarm = rp2040.clock.createAlarm(() => this.done());
    this.nextAlarm = rp2040.clock.createAlarm(() => this.start());
  }

  get channel() {
    return (this.cs >>> CS_AINSEL_SHIFT) & 7;
  }

  /** The input is sampled when the conversion starts: a multiplexer that has not settled yet is seen unsettled. */
  start() {
    if (this.busy || this.stalled || !(this.cs & CS_EN)) return;
    this.busy = true;
    this.conversions++;
    this.held = this.sample(this.channel) & 0xfff;
    this.doneAlarm.schedule((CONVERSION_CLOCKS * 1e9) / CLOCK_HZ);
  }

  done() {
    this.busy = false;
    this.result = this.held;
    if (this.fcs & FCS_EN) this.keep(this.held);
    this.selectNext();
    if (!(this.cs & CS_START_MANY)) return;
    const clocks = 1 + this.div / 256;
    if (clocks > CONVERSION_CLOCKS) this.nextAlarm.schedule(((clocks - CONVERSION_CLOCKS) * 1e9) / CLOCK_HZ);
    else this.start();
  }

  keep(code) {
    if (this.fifo.full || this.starved > 0) {
      this.fcs |= FCS_OVER;
      this.starved = Math.max(0, this.starved - 1);
    } else this.fifo.push(this.fcs & FCS_SHIFT ? code >> 4 : code);
    this.update();
  }

  selectNext() {
    const mask = this.cs >>> CS_RROBIN_SHIFT;
    if (mask === 0) return;
    let channel = this.channel;
    do channel = (channel + 1) % CHANNELS; while (!(mask & (1 << channel)));
    this.cs = (this.cs & ~(7 << CS_AINSEL_SHIFT)) | (channel << CS_AINSEL_SHIFT);
  }

  get interruptRaw() {
    return this.fifo.itemCount >= ((this.fcs >>> FCS_THRESH_SHIFT) & 0xf) ? 1 : 0;
  }

  get interruptStatus() {
    return (this.interruptRaw & this.intEnable) | this.intForce;
  }

  update() {
    this.rp2040.setInterrupt(ADC_IRQ, this.interruptStatus !== 0);
    if (this.fcs & FCS_DREQ_EN && this.interruptRaw) this.rp2040.dma.setDREQ(ADC_DREQ);
    else this.rp2040.dma.clearDREQ(ADC_DREQ);
  }

  take() {
    if (this.fifo.empty) {
      this.fcs |= FCS_UNDER;
      return 0;
    }
    const code = this.fifo.pull();
    this.update();
    return code;
  }

  readUint32(offset) {
    const { fifo } = this;
    switch (offset) {
      case CS: return this.cs | (this.busy || !(this.cs & CS_EN) ? 0 : CS_READY);
      case RESULT: return this.result;
      case FCS:
        return this.fcs | (fifo.itemCount << 16) | (fifo.full ? FCS_FULL : 0) | (fifo.empty ? FCS_EMPTY : 0);
      case FIFO_OUT: return this.take();
      case DIV: return this.div;
      case INTR: return this.interruptRaw;
      case INTE: return this.intEnable;
      case INTF: return this.intForce;
      case INTS: return this.interruptStatus;
      default: return super.readUint32(offset);
    }
  }

  writeUint32(offset, value) {
    switch (offset) {
      case CS:
        this.cs = value & CS_KEPT;
        if (value & (CS_START_ONCE | CS_START_MANY)) this.start();
        return;
      case FCS:
        this.fcs = (this.fcs & (FCS_OVER | FCS_UNDER) & ~this.rawWriteValue) | (value & FCS_KEPT);
        break;
      case DIV: this.div = value & 0xffffff; return;
      case INTE: this.intEnable = value & 1; break;
      case INTF: this.intForce = value & 1; break;
      default: return super.writeUint32(offset, value);
    }
    this.update();
  }
}
