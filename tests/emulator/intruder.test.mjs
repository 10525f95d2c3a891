import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Intruder } from './intruder.mjs';
import { BoardError, Machine } from './machine.mjs';

const IRQ = 5, FUNCTION = 0x10000108, HANDLER = 0x10000160;

/** An image that goes round in a function of three instructions, and counts interrupts in r4. */
function machine() {
  const bytes = new Uint8Array(0x200), view = new DataView(bytes.buffer);
  view.setUint32(0x100, 0x20042000, true);
  view.setUint32(0x104, FUNCTION | 1, true);
  [0xbf00, 0xbf00, 0xe7fc].forEach((half, i) => view.setUint16(0x108 + 2 * i, half, true)); // nop; nop; b back
  view.setUint32(0x100 + 4 * (16 + IRQ), HANDLER | 1, true);
  [0x3401, 0x4770].forEach((half, i) => view.setUint16(0x160 + 2 * i, half, true)); // adds r4, #1; bx lr
  const it = new Machine({ flash: [{ offset: 0, bytes }], symbols: new Map([['_R8my_round', { address: FUNCTION | 1, size: 6 }]]) });
  it.core.enabledInterrupts = 1 << IRQ;
  return it;
}

test('the interrupt comes before each instruction of the function', () => {
  const it = machine(), came = [];
  const intruder = new Intruder(it, IRQ, 'round', () => {
    it.core.setInterrupt(IRQ, false);
    came.push(it.chip.readUint32(it.core.SP + 24) - FUNCTION);
  });
  it.runUntil(2_000);
  assert.deepEqual(came.slice(0, 8), [0, 2, 4, 0, 2, 4, 0, 2]);
  assert.ok(it.core.registers[4] >= intruder.count - 1 && intruder.count >= 8);
});

test('a name must be that of one function', () => {
  assert.throws(() => new Intruder(machine(), IRQ, 'square', () => {}), BoardError);
});
