// The boot ROM's functions for the flash, which are all that the firmware calls there. Each is a breakpoint and a return;
// the breakpoint does the work here and charges the time that a flash chip takes.

import { BasePeripheral } from 'rp2040js';

const FUNCTION_TABLE_AT = 0x14, LOOKUP_AT = 0x18; // halfwords: where the table and the function that searches it are
const CODE = 0x100, TABLE = 0x200, ROM_END = 0x4000;
const BREAKPOINT = 0xbe00, RETURN = 0x4770;
const ERASE_MS = 45, PROGRAM_MS = 0.7; // a sector of 4 KiB, a page of 256 bytes: typical for the W25Q series
const SECTOR = 4096, PAGE = 256;
const CYCLES_PER_MS = 125_000;

/** Ends a run: the power has failed within a step of the flash. */
export class PowerCut extends Error {}

const XIP_BASE = 0x14000, STREAM_COUNTER = 0x18;

/** Of the flash cache's control block, drivers ask only whether a stream is under way before they switch the flash off. */
class FlashCache extends BasePeripheral {
  readUint32(offset) {
    return offset === STREAM_COUNTER ? 0 : super.readUint32(offset);
  }
}

export class Rom {
  constructor(chip) {
    this.chip = chip;
    chip.peripherals[XIP_BASE] = new FlashCache(chip, 'XIP');
    this.erased = this.programmed = this.steps = 0;
    this.cutAt = Infinity; // the step, from 1, in whose midst the power fails
    this.functions = [
      ['', (table, code) => this.lookup(code)],
      ['C4', (to, from, count) => this.copy(to, from, count)],
      ['IF', () => {}], ['EX', () => {}], ['FC', () => {}], ['CX', () => {}],
      ['RE', (offset, count) => this.erase(offset, count)],
      ['RP', (offset, from, count) => this.program(offset, from, count)],
    ];
    const view = new DataView(chip.bootrom.buffer);
    view.setUint16(FUNCTION_TABLE_AT, TABLE, true);
    view.setUint16(LOOKUP_AT, CODE | 1, true);
    this.functions.forEach((_, index) => {
      view.setUint16(CODE + 4 * index, BREAKPOINT | index, true);
      view.setUint16(CODE + 4 * index + 2, RETURN, true);
    });
  }

  /** Whether a breakpoint is one of the ROM's; then its work is done. */
  handles(code) {
    const { core } = this.chip;
    if (core.PC >= ROM_END || code >= this.functions.length) return false;
    const [r0, r1, r2] = core.registers;
    const result = this.functions[code][1](r0, r1, r2);
    if (result !== undefined) core.registers[0] = result;
    return true;
  }

  lookup(code) {
    const name = String.fromCharCode(code & 0xff, code >>> 8);
    const index = this.functions.findIndex(([known]) => known === name);
    return index < 0 ? 0 : (CODE + 4 * index) | 1;
  }

  copy(to, from, count) {
    for (let i = 0; i < count; i++) this.chip.writeUint8(to + i, this.chip.readUint8(from + i));
    return to;
  }

  erase(offset, count) {
    if (offset % SECTOR !== 0 || count % SECTOR !== 0) throw new Error('flash is erased by sectors');
    this.chip.flash.fill(0xff, offset, offset + this.reached(count));
    this.cut();
    this.erased += count / SECTOR;
    this.spend((ERASE_MS * count) / SECTOR);
  }

  /** Programming only clears bits, as NOR flash does. */
  program(offset, from, count) {
    if (offset % PAGE !== 0 || count % PAGE !== 0) throw new Error('flash is programmed by pages');
    const reached = this.reached(count);
    for (let i = 0; i < reached; i++) this.chip.flash[offset + i] &= this.chip.readUint8(from + i);
    this.cut();
    this.programmed += count / PAGE;
    this.spend((PROGRAM_MS * count) / PAGE);
  }

  /** How many of a step's bytes are reached: half of them where the power fails. */
  reached(count) {
    return ++this.steps === this.cutAt ? count >> 1 : count;
  }

  cut() {
    if (this.steps === this.cutAt) throw new PowerCut(`the power failed at step ${this.steps} of the flash`);
  }

  /** The core waits in the ROM meanwhile, with interrupts off. */
  spend(ms) {
    this.chip.core.cycles += ms * CYCLES_PER_MS;
  }
}
