import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { Bus, Frames } from './usb_bus.mjs';
import { Usb } from './usb.mjs';

const SIE_CTRL = 0x4c, SIE_STATUS = 0x50, MAIN_CTRL = 0x40, BUFF_STATUS = 0x58, SOF_RD = 0x48, INTR = 0x8c, INTE = 0x90;
const SOF = 1 << 17;
const ALL = 0x1f810;
const IRQ = 5;
const ENABLE = 1 << 31, PER_BUFFER = 1 << 29, FULL = 1 << 15, DATA1 = 1 << 13, AVAILABLE = 1 << 10;

/** A controller that is attached, with endpoint 1 in both directions: buffers at 0x180 and 0x1c0. */
function usb() {
  const parts = board();
  const it = new Usb(parts.chip);
  it.writeUint32(MAIN_CTRL, 1);
  it.writeUint32(SIE_CTRL, (1 << 16) | (1 << 29));
  it.writeUint32(INTE, ALL);
  it.memory.setUint32(0x08, (ENABLE | PER_BUFFER | 0x180) >>> 0, true);
  it.memory.setUint32(0x0c, (ENABLE | PER_BUFFER | 0x1c0) >>> 0, true);
  return { it, ...parts };
}

/** Clears bits by writing them, as the firmware does. */
function acknowledge(it, register, bits) {
  it.writeUint32Atomic(register, bits, 0);
}

test('a buffer is not ready until it is armed, and then once', () => {
  const { it, pending } = usb();
  assert.equal(it.ask(0, 1, 0), 'nak');
  it.memory.setUint8(0x180, 65);
  it.memory.setUint32(0x88, AVAILABLE | FULL | DATA1 | 1, true);
  assert.equal(it.ask(0, 1, 0), 1);
  assert.deepEqual(it.in(1), { data: Uint8Array.of(65), odd: true });
  assert.equal(it.ask(0, 1, 0), 'nak');
  assert.equal(it.readUint32(BUFF_STATUS), 1 << 2);
  assert.equal(pending(IRQ), true);
  acknowledge(it, BUFF_STATUS, 1 << 2);
  assert.equal(pending(IRQ), false);
});

test('what is received lies in the buffer with its length; what comes twice is not taken', () => {
  const { it } = usb();
  it.memory.setUint32(0x8c, AVAILABLE | 64, true);
  it.out(1, Uint8Array.of(7, 8), false);
  assert.equal(it.memory.getUint32(0x8c, true) & (AVAILABLE | 0x3ff), 2);
  assert.deepEqual([it.memory.getUint8(0x1c0), it.memory.getUint8(0x1c1)], [7, 8]);
  it.memory.setUint32(0x8c, AVAILABLE | DATA1 | 64, true);
  it.out(1, Uint8Array.of(9), false);
  assert.equal(it.ask(0, 1, 1), 64);
  assert.equal(it.memory.getUint8(0x1c0), 7);
});

test('another address, and a board that is not attached, are silent', () => {
  const { it } = usb();
  assert.equal(it.ask(1, 1, 0), 'silence');
  it.writeUint32(SIE_CTRL, 0);
  assert.equal(it.ask(0, 1, 0), 'silence');
});

test('reset, setup and sleep interrupt until they are acknowledged', () => {
  const { it, pending } = usb();
  for (const [happens, bit] of [[() => it.reset(), 1 << 19], [() => it.setup([1, 2, 3, 4, 5, 6, 7, 8]), 1 << 17],
    [() => it.suspend(), 1 << 4], [() => it.resume(), 1 << 11]]) {
    happens();
    assert.equal(it.readUint32(SIE_STATUS) & bit, bit);
    assert.equal(pending(IRQ), true);
    acknowledge(it, SIE_STATUS, bit);
    assert.equal(pending(IRQ), false);
  }
  assert.equal(it.memory.getUint8(7), 8);
});

test('a frame holds 19 packets of 64 bytes', () => {
  const { chip, advance } = board();
  let packets = 0;
  const bus = new Bus(chip.clock, () => ({ bytes: 64, done: () => { packets++; } }));
  advance(1e6);
  bus.wake();
  const before = packets;
  advance(10e6);
  assert.ok(Math.abs(packets - before - 190) <= 1, `${packets - before}`);
  bus.drop();
  advance(1e6);
  assert.ok(packets - before <= 191);
});

test('a frame starts each millisecond, and interrupts until its number is read', () => {
  const { it, chip, advance, pending } = usb();
  const bus = new Bus(chip.clock, () => undefined, (number) => it.start(number), new Frames({ first: 2046 }));
  bus.drive();
  advance(1e6);
  assert.equal(it.readUint32(INTR) & SOF, SOF);
  assert.equal(pending(IRQ), false, 'it interrupts only if that is enabled');
  it.writeUint32(INTE, ALL | SOF);
  assert.equal(pending(IRQ), true);
  assert.equal(it.readUint32(SOF_RD), 2047);
  assert.equal(pending(IRQ), false);
  advance(1e6);
  assert.deepEqual([pending(IRQ), it.readUint32(SOF_RD)], [true, 0]);
  bus.rest();
  advance(5e6);
  assert.deepEqual([pending(IRQ), it.readUint32(SOF_RD)], [false, 0]);
});

test('the frames of a host are longer to a clock that is fast', () => {
  const frames = new Frames({ ppm: 50, wander: 5, period: 10 });
  assert.equal(frames.startOf(0), 0);
  // The wander has come to nothing after a whole period, and is greatest after half of it.
  assert.ok(Math.abs(frames.startOf(10_000) - 10e9 * (1 + 50e-6)) < 1);
  assert.ok(Math.abs(frames.startOf(5_000) - 5e9 * (1 + 50e-6) - 5e-6 * 10e9 / Math.PI) < 1);
  const [start, end] = frames.span(2_000_100);
  assert.ok(start === frames.startOf(2) && end === frames.startOf(3));
});

test('what is not ready is asked again when something has changed', () => {
  const { chip, advance } = board();
  let [ready, done] = [false, 0];
  const bus = new Bus(chip.clock, () => (ready ? { bytes: 1, done: () => { ready = false; done++; } } : undefined));
  bus.wake();
  advance(1e5);
  ready = true;
  advance(1e5);
  assert.equal(done, 0);
  bus.wake();
  advance(1e5);
  assert.equal(done, 1);
});
