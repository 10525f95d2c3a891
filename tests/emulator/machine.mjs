// The board: rp2040js with the models of this folder in place of its own, an image in flash, and a clock.

import { RP2040 } from 'rp2040js';
import { Adc } from './adc.mjs';
import { CHIP_RESET_BASE, ChipReset } from './chip_reset.mjs';
import { mendDma } from './dma.mjs';
import { FlashChip } from './flash_chip.mjs';
import { Marks } from './marks.mjs';
import { Mpu } from './mpu.mjs';
import { Pads } from './pads.mjs';
import { Pio } from './pio.mjs';
import { Rom } from './rom.mjs';
import { Rtt } from './rtt.mjs';
import { Stack } from './stack.mjs';
import { Uart } from './uart.mjs';
import { Usb } from './usb.mjs';
import { UsbHost } from './usb_host.mjs';

const VECTOR_TABLE = 0x10000100;
const NANOS_PER_CYCLE = 8; // 125 MHz
const RAM_START = 0x20000000, RAM_END = 0x20042000;
const UART0_IRQ = 20, UART0_DREQ = { tx: 20, rx: 21 };
const UART0_BASE = 0x40034, ADC_BASE = 0x4004c, WATCHDOG_BASE = 0x40058, USB_BASE = 0x50110, SSI_BASE = 0x18000, PIO_BASES = [0x50200, 0x50300];
const PIO_IRQS = [7, 9];
const WATCHDOG_FORCED = 2;
const UNIQUE_ID = [0xe6, 0x60, 0x58, 0x38, 0x83, 0x2f, 0x5c, 0x29];

/** Stops a run; the message says what the firmware or the emulator did wrong. */
export class BoardError extends Error {}

/** The watchdog has reset the board: another machine goes on `after` this one. */
export class WatchdogReset extends Error {
  constructor(machine, forced) {
    super('the watchdog has reset the board');
    Object.assign(this, { machine, forced });
  }
}

export class Machine {
  /**
   * `allowed(text)`: whether an emulator warning is expected. `onByte`: a byte left on UART0. `onBytes`: bytes came over USB.
   * `onKnown`: what the board said on USB that it is. `restarts`: a reset by the watchdog is a `WatchdogReset`,
   * and no mistake. `cause`: what reset the chip as a whole. `after`: the machine that has been reset, whose flash
   * this one has, and its scratch registers unless `browned`; all else begins anew, its memory and its time included, which is
   * `micros` then. `onLockUp(us)`: the core has met memory that nobody may access, and does nothing more. `uniqueId`: that of the
   * flash chip. `frames`: those of the USB, as of `Frames`.
   */
  constructor(
    { flash, symbols },
    { allowed = () => false, onByte = () => {}, onBytes = () => {}, onKnown, restarts = false, cause = 'power', after, browned = false, micros = 0, onLockUp = () => {}, uniqueId = UNIQUE_ID, frames } = {},
  ) {
    const chip = new RP2040();
    Object.assign(this, { chip, clock: chip.clock, core: chip.core, symbols, restarts, onLockUp });
    this.marks = new Marks();
    this.asleep = 0;
    this.hung = false; // the core does nothing more, as if it went round in circles
    this.clock.nanosCounter = micros * 1000;
    const complain = (part, text) => {
      // DMA that nobody leads any more reads what it finds; the watchdog ends it.
      if (this.hung) return;
      if (!allowed(`${part}: ${text}`)) throw new BoardError(`emulator warning from ${part}: ${text}, at ${this.where()}`);
    };
    chip.logger = { debug() {}, info() {}, warn: complain, error: complain };
    this.sample = () => 0;
    this.onLent = () => {};
    chip.uart[0] = chip.peripherals[UART0_BASE] = new Uart(chip, 'UART0', UART0_IRQ, UART0_DREQ, onByte);
    chip.usbCtrl = chip.peripherals[USB_BASE] = new Usb(chip);
    this.usb = new UsbHost(chip, { onBytes, onKnown, frames, fail: (text) => complain('USB', text) });
    chip.adc = chip.peripherals[ADC_BASE] = new Adc(chip, (channel) => this.sample(channel));
    PIO_BASES.forEach((base, i) => {
      chip.pio[i] = chip.peripherals[base] = new Pio(chip, `PIO${i}`, PIO_IRQS[i], i);
    });
    this.pads = new Pads(chip);
    this.mpu = new Mpu(chip.ppb);
    const before = browned ? undefined : after?.chip.peripherals[CHIP_RESET_BASE].cause;
    this.supply = chip.peripherals[CHIP_RESET_BASE] = new ChipReset(chip, before ?? (browned ? 'power' : cause));
    if (after === undefined) for (const { offset, bytes } of flash) chip.flash.set(bytes, offset);
    else chip.flash.set(after.chip.flash);
    if (after !== undefined && !browned) this.follow(after.chip);
    this.rom = new Rom(chip);
    new FlashChip(chip.peripherals[SSI_BASE], uniqueId);
    this.guard();
    this.tapMemory();
    this.boot();
  }

  /** The stack is all but used up: what is pushed next leaves the memory. What lies on it goes with it. */
  sink() {
    const { core, chip } = this;
    const { buffer, byteOffset, byteLength } = chip.sramView;
    new Uint8Array(buffer, byteOffset, byteLength).copyWithin(0, core.SP - RAM_START, this.stack.top - RAM_START);
    core.SP = RAM_START;
  }

  /** A push has met memory that nobody may access, and so will what an exception pushes: the core does nothing more. */
  lockUp() {
    if (this.hung) return;
    if (!this.restarts) throw new BoardError(`the stack has left the memory at ${this.where()}`);
    this.hung = true;
    this.onLockUp(this.micros);
  }

  /** What outlasts a reset by the watchdog, besides the flash. */
  follow(before) {
    const [from, to] = [before, this.chip].map((chip) => chip.peripherals[WATCHDOG_BASE]);
    to.scratchData.set(from.scratchData);
    to.reason = from.reason;
  }

  get uart() {
    return this.chip.uart[0];
  }

  get micros() {
    return this.clock.nanosCounter / 1000;
  }

  get cycles() {
    return this.core.cycles;
  }

  /** What drives or shorts the pin: true, false, or undefined when nothing does. */
  readPin(number) {
    return this.pads.drivenLevel(number);
  }

  /** What the boot ROM and boot2 do: stack pointer, vector table, entry. */
  boot() {
    const { chip, core } = this;
    core.VTOR = VECTOR_TABLE;
    core.SP = chip.readUint32(VECTOR_TABLE);
    core.PC = chip.readUint32(VECTOR_TABLE + 4) & ~1;
    this.rtt = new Rtt(this.symbols, chip.sramView);
    this.stack = new Stack(this.symbols, chip.sramView, core.SP);
  }

  /** What silicon would answer with a fault or a reset ends the run. */
  guard() {
    const { chip } = this;
    chip.onBreak = (code) => {
      if (this.rom.handles(code)) return;
      throw new BoardError(`breakpoint ${code} at ${this.where()}: a panic or a fault`);
    };
    const watchdog = chip.peripherals[WATCHDOG_BASE];
    watchdog.onWatchdogTrigger = () => this.reset(watchdog.reason === WATCHDOG_FORCED);
    mendDma(chip, (channel) => {
      if (this.hung) return;
      throw new BoardError(`DMA channel ${channel} reaches for the core's own ports, which silicon forbids`);
    });
  }

  reset(forced) {
    if (this.restarts) throw new WatchdogReset(this, forced);
    throw new BoardError(`the board reset itself (${forced ? 'a panic' : 'the watchdog was not fed'}) at ${this.where()}`);
  }

  /** Memory first: most accesses go there, and rp2040js would look for a peripheral before. Also where marks are seen, and
   * frames that are about to be perceived. */
  tapMemory() {
    const { chip, core, marks } = this;
    const ram = chip.sramView;
    const mark = this.symbols.get('TAXEL_MARK')?.address;
    const lent = this.symbols.get('TAXEL_LENT')?.address;
    core.writeUint32 = (address, value) => {
      if (address >= RAM_START && address < RAM_END - 3) {
        ram.setUint32(address - RAM_START, value, true);
        if (address === mark) marks.enter(value, core.cycles);
        else if (address === lent) this.onLent(value);
      } else if (address >>> 0 < RAM_START && this.mpu.forbids(address >>> 0)) {
        this.lockUp();
      } else {
        chip.writeUint32(address, value);
      }
    };
  }

  where() {
    const pc = this.core.PC;
    let name = '?';
    let nearest = 0;
    for (const [symbol, { address, size }] of this.symbols) {
      const start = address & ~1;
      if (start <= pc && start > nearest && pc <= start + size && !symbol.startsWith('$')) [name, nearest] = [symbol, start];
    }
    return `0x${pc.toString(16)} (${name}), ${(this.micros / 1000).toFixed(3)} ms`;
  }

  /** Runs until the board's clock shows `nanos`; a sleeping core is taken to its next event at once. */
  runUntil(nanos) {
    const { core, clock } = this;
    while (clock.nanosCounter < nanos) {
      if (core.waiting || this.hung) {
        const next = clock.nextAlarm === null ? nanos : Math.min(nanos, clock.nextAlarm.nanos);
        this.asleep += next - clock.nanosCounter;
        clock.tick(next - clock.nanosCounter);
        continue;
      }
      const before = core.cycles;
      core.executeInstruction();
      clock.nanosCounter += (core.cycles - before) * NANOS_PER_CYCLE;
      const alarm = clock.nextAlarm;
      if (alarm !== null && alarm.nanos <= clock.nanosCounter) clock.tick(0);
    }
  }
}
