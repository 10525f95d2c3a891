import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { ChipReset } from './chip_reset.mjs';

test('each cause has its bit, and the regulator keeps what it is sent', () => {
  const { chip } = board();
  const read = (cause) => new ChipReset(chip, cause).readUint32(8);
  assert.deepEqual([read(), read('power'), read('pin'), read('debugger')], [0x100, 0x100, 0x10000, 0x100000]);
  assert.throws(() => read('rain'), /not by rain/);
  const it = new ChipReset(chip);
  assert.equal(it.readUint32(0), 0xb1);
  it.writeUint32(4, 0x91 | 2);
  assert.equal(it.readUint32(4), 0x93);
  assert.throws(() => it.readUint32(12), /Unimplemented/);
});

test('a supply below the threshold resets the chip while the detector is on', () => {
  const { chip } = board();
  const it = new ChipReset(chip);
  const lowest = () => [...Array(1200).keys()].find((millivolts) => !it.browns(millivolts));
  assert.equal(lowest(), 860);
  for (const [step, millivolts] of [[0, 473], [0b1011, 946], [15, 1118]]) {
    it.writeUint32(4, (step << 4) | 1);
    assert.equal(lowest(), millivolts);
    it.writeUint32(4, step << 4);
    assert.equal(lowest(), 0);
  }
});
