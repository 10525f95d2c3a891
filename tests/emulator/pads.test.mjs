import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { Pads } from './pads.mjs';

const SIO_IN = 0xd0000004, OUT_SET = 0xd0000014, OUT_CLR = 0xd0000018, OE_SET = 0xd0000024, OE_CLR = 0xd0000028;
const FUNCTION_SIO = 5;
const INPUT = 1 << 6, UP = 1 << 3, DOWN = 1 << 2;

/** A chip whose pins 0 to 3 are the core's, and functions that drive, release and look. */
function pads() {
  const { chip } = board();
  const it = new Pads(chip);
  const pad = (pin, bits) => chip.writeUint32(0x4001c004 + 4 * pin, INPUT | bits);
  for (const pin of [0, 1, 2, 3]) chip.writeUint32(0x40014004 + 8 * pin, FUNCTION_SIO);
  return {
    it, pad,
    drive: (pin, level) => {
      chip.writeUint32(level ? OUT_SET : OUT_CLR, 1 << pin);
      chip.writeUint32(OE_SET, 1 << pin);
    },
    release: (pin, bits) => {
      pad(pin, bits);
      chip.writeUint32(OE_CLR, 1 << pin);
    },
    look: () => chip.readUint32(SIO_IN) & 0xf,
  };
}

test('a pin shows what drives it, or its resistor', () => {
  const { it, drive, release, look } = pads();
  [DOWN, UP, DOWN, UP].forEach((bits, pin) => release(pin, bits));
  assert.equal(look(), 0b1010);
  drive(0, true);
  drive(1, false);
  assert.equal(look(), 0b1001);
  assert.deepEqual([it.drivenLevel(0), it.drivenLevel(1), it.drivenLevel(2)], [true, false, undefined]);
});

test('a line that is stuck or bridged shows it', () => {
  const { it, drive, release, look } = pads();
  [0, 1, 2, 3].forEach((pin) => release(pin, DOWN));
  drive(0, true);
  it.faults = [{ pin: 0, fault: { bridged: 2 } }];
  assert.equal(look(), 0b0101);
  drive(2, false);
  assert.equal(look(), 0, 'ground wins');
  it.faults = [{ pin: 0, fault: 'stuck-low' }, { pin: 3, fault: 'stuck-high' }];
  assert.equal(look(), 0b1000);
  assert.equal(it.drivenLevel(3), true);
});

test('a pulled input is no scan, and shows what is connected to it', () => {
  const { it, pad } = pads();
  const asked = [];
  const garment = { sample: () => (asked.push('sample'), 100), peek: () => (asked.push('peek'), 100) };
  const codes = (...faults) => {
    it.faults = faults.map((fault) => ({ pin: 27, fault }));
    return [0, UP, DOWN].map((bits) => {
      pad(27, bits);
      return it.sample(1, garment);
    });
  };
  assert.deepEqual(codes(), [100, 171, 98]);
  assert.deepEqual(asked, ['sample', 'peek', 'peek']);
  assert.deepEqual(codes('open'), [98, 4095, 0]);
  assert.deepEqual(codes('grounded'), [0, 0, 0]);
  assert.deepEqual(codes('supplied'), [4095, 4095, 4095]);
});
