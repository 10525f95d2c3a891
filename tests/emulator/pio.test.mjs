import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { Pio } from './pio.mjs';

const CTRL = 0x000, FSTAT = 0x004, TXF0 = 0x010, RXF0 = 0x020, IRQ = 0x030, IRQ_FORCE = 0x034, MEM0 = 0x048;
const CLKDIV = 0x0c8, EXECCTRL = 0x0cc, SHIFTCTRL = 0x0d0, PINCTRL = 0x0dc, IRQ0_INTE = 0x12c;
const CYCLE = 8; // ns
const TX_DREQ = 0, RX_DREQ = 4, PIO0_IRQ = 7;

/** A block whose machine 0 runs `program` in a loop, with 12 output pins from GPIO 2 on. */
function pio(program, { divider = 1 } = {}) {
  const parts = board();
  const it = new Pio(parts.chip, 'PIO0', PIO0_IRQ, 0);
  program.forEach((instruction, i) => it.writeUint32(MEM0 + 4 * i, instruction));
  it.writeUint32(CLKDIV, divider * 65536);
  it.writeUint32(EXECCTRL, (program.length - 1) << 12);
  it.writeUint32(SHIFTCTRL, 3 << 18);
  it.writeUint32(PINCTRL, (12 << 20) | 2);
  it.writeUint32(CTRL, 1);
  return { it, ...parts };
}

const PULL = 0x80a0, OUT_11 = 0x600b, OUT_X = 0x6021, UNLESS_X_AGAIN = 0x0020, PUSH = 0x8000;
const SELECT = [PULL, OUT_11, OUT_X, UNLESS_X_AGAIN, PUSH];

test('one instruction a cycle, from the word on', () => {
  const { it, advance } = pio(SELECT);
  advance(1000);
  it.writeUint32(TXF0, 0x5a5);
  assert.equal(it.pinValues, 0);
  advance(CYCLE - 1);
  assert.equal(it.pinValues, 0);
  advance(1);
  assert.equal(it.pinValues, 0x5a5 << 2);
});

test('the divider slows a machine', () => {
  const { it, advance } = pio(SELECT, { divider: 2.5 });
  advance(1000);
  it.writeUint32(TXF0, 0x5a5);
  advance(2.5 * CYCLE - 1);
  assert.equal(it.pinValues, 0);
  advance(1);
  assert.equal(it.pinValues, 0x5a5 << 2);
});

test('a word with the flag is answered, one without is not', () => {
  const { it, advance, requested } = pio(SELECT);
  it.writeUint32(TXF0, 0x001);
  advance(10 * CYCLE);
  assert.equal(requested(RX_DREQ), false);
  it.writeUint32(TXF0, 0x801);
  advance(10 * CYCLE);
  assert.equal(requested(RX_DREQ), true);
  it.readUint32(RXF0);
  assert.equal(requested(RX_DREQ), false);
});

test('words are requested while there is room, and none is lost', () => {
  const { it, advance, requested } = pio(SELECT, { divider: 100 });
  advance(1000 * CYCLE); // stalled: the first word goes to the shift register at once
  for (const word of [1, 2, 3, 4, 5]) it.writeUint32(TXF0, word);
  assert.equal(requested(TX_DREQ), false);
  assert.equal(it.readUint32(FSTAT) & (1 << 16), 1 << 16);
  const seen = [];
  for (let i = 0; i < 5; i++) {
    advance(100 * CYCLE);
    seen.push(it.pinValues >> 2);
    advance(300 * CYCLE);
  }
  assert.deepEqual(seen, [1, 2, 3, 4, 5]);
  assert.equal(requested(TX_DREQ), true);
});

test('queues that are joined and parted again are empty', () => {
  const { it, advance, requested } = pio(SELECT);
  it.writeUint32(TXF0, 0x801);
  advance(10 * CYCLE);
  it.writeUint32(CTRL, 0);
  it.writeUint32(TXF0, 0x123);
  it.writeUint32(SHIFTCTRL, (3 << 18) | (1 << 30));
  it.writeUint32(SHIFTCTRL, 3 << 18);
  assert.equal(requested(RX_DREQ), false);
  assert.equal(it.readUint32(FSTAT) & 0x01000100, 0x01000100);
});

test('a disabled machine does nothing', () => {
  const { it, advance } = pio([0xe03f]); // set x, 31
  it.writeUint32(CTRL, 0);
  advance(10 * CYCLE);
  const { x } = it.machines[0];
  it.machines[1].y = 7;
  advance(100 * CYCLE);
  assert.deepEqual([it.machines[0].x, it.machines[1].y], [x, 7]);
});

test('a machine waits for a pin, and an interrupt flag is seen and cleared', () => {
  const { it, chip, advance, pending } = pio([0x2085, 0xc000]); // wait 1 gpio 5; irq 0
  chip.pio[0] = it;
  it.writeUint32(IRQ0_INTE, 1 << 8);
  advance(100 * CYCLE);
  assert.equal(pending(PIO0_IRQ), false);
  chip.gpio[5].padValue |= 1 << 6;
  chip.gpio[5].setInputValue(true);
  advance(4 * CYCLE);
  assert.equal(pending(PIO0_IRQ), true);
  it.writeUint32(CTRL, 0);
  it.writeUint32Atomic(IRQ, 1, 0);
  assert.equal(pending(PIO0_IRQ), false);
  it.writeUint32Atomic(IRQ_FORCE, 1 << 3, 0);
  assert.equal(it.readUint32(IRQ), 1 << 3);
});
