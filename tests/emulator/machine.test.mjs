import assert from 'node:assert/strict';
import { test } from 'node:test';
import { BoardError, Machine, WatchdogReset } from './machine.mjs';

/** An image of halfwords that starts at 0x10000108, with the word at 0x20000000 named TAXEL_MARK. */
function machine(code, hooks = {}) {
  const bytes = new Uint8Array(0x108 + 2 * code.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0x100, 0x20042000, true);
  view.setUint32(0x104, 0x10000109, true);
  code.forEach((half, i) => view.setUint16(0x108 + 2 * i, half, true));
  const symbols = new Map([['TAXEL_MARK', { address: 0x20000000, size: 4 }]]);
  return new Machine({ flash: [{ offset: 0, bytes }], symbols }, hooks);
}

const LOOP = 0xe7fe; // b .

test('cycles are time: 8 ns each', () => {
  const it = machine([LOOP]);
  it.runUntil(24_000);
  assert.equal(it.cycles, 3000);
  assert.equal(it.micros, 24);
});

test('a sleeping core is taken to its next event', () => {
  const it = machine([0xbf30, 0xe7fd]); // wfi; b back
  it.runUntil(1e9);
  assert.ok(it.cycles < 100);
  assert.ok(it.asleep > 0.99e9);
});

test('marks are summed by stage', () => {
  // movs r0, #1; lsls r1, r0, #29; str r0, [r1]; nop; nop; movs r0, #2; str r0, [r1]; b .
  const it = machine([0x2001, 0x0741, 0x6008, 0xbf00, 0xbf00, 0x2002, 0x6008, LOOP]);
  it.runUntil(1e4);
  assert.deepEqual(it.marks.toJSON(), { 1: { count: 1, cycles: 5, max: 5 } });
});

test('an undefined instruction, an unknown address and a forced reset end the run', () => {
  assert.throws(() => machine([0xde00]).runUntil(1e4), BoardError);
  const stray = [0x2001, 0x0781, 0x6008, LOOP]; // movs r0, #1; lsls r1, r0, #30; str r0, [r1]: 0x40000000 is read-only
  assert.throws(() => machine(stray).runUntil(1e4), /emulator warning/);
  machine(stray, { allowed: () => true }).runUntil(1e4);
  const it = machine([LOOP]);
  assert.throws(() => it.chip.writeUint32(0x40058000, 0x80000000), /reset itself/);
});

test('a core that hangs is reset by the watchdog, and what outlasts that is there again', () => {
  const WATCHDOG = 0x40058000, CTRL = 0, LOAD = 4, REASON = 8, SCRATCH = 0xc, ENABLE = 1 << 30;
  const it = machine([LOOP], { restarts: true });
  it.chip.writeUint32(WATCHDOG + SCRATCH, 0x7ac50001);
  it.chip.writeUint32(WATCHDOG + LOAD, 2 * 1000);
  it.chip.writeUint32(WATCHDOG + CTRL, ENABLE);
  it.chip.flash[0x1f0000] = 7;
  it.hung = true;
  const reset = (act) => {
    try {
      act();
    } catch (error) {
      if (error instanceof WatchdogReset) return error;
      throw error;
    }
    return undefined;
  };
  const bitten = reset(() => it.runUntil(1e9));
  assert.equal(bitten.forced, false);
  assert.ok(it.cycles === 0 && it.micros > 900 && it.micros < 1100, `${it.micros} us`);
  const after = new Machine({ symbols: new Map() }, { restarts: true, after: bitten.machine });
  assert.deepEqual([REASON, SCRATCH].map((at) => after.chip.readUint32(WATCHDOG + at)), [1, 0x7ac50001]);
  assert.equal(after.chip.flash[0x1f0000], 7);
  assert.equal(after.micros, 0);
  assert.equal(reset(() => after.chip.writeUint32(WATCHDOG + CTRL, 0x80000000)).forced, true);
});

test('DMA into the core\'s own ports ends the run', () => {
  const it = machine([LOOP]);
  const { chip } = it;
  chip.writeUint32(0x50000000, 0x20000000);
  chip.writeUint32(0x50000004, 0xd0000010);
  chip.writeUint32(0x50000008, 1);
  chip.writeUint32(0x5000000c, 1 | (2 << 2) | (63 << 15));
  assert.throws(() => it.runUntil(1e4), /DMA channel 0/);
});
