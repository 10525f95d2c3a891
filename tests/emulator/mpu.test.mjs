import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Mpu } from './mpu.mjs';

function unit() {
  const others = [];
  const ppb = { readUint32: (offset) => offset, writeUint32: (offset, value) => others.push([offset, value]) };
  return { ppb, others, mpu: new Mpu(ppb) };
}

test('a region that is on forbids its addresses and no other', () => {
  const { ppb, mpu } = unit();
  ppb.writeUint32(0xd9c, 0x1fff0000 | (1 << 4) | 3);
  ppb.writeUint32(0xda0, (1 << 28) | (15 << 1) | 1);
  assert.equal(mpu.forbids(0x1fffffff), false, 'the unit is off');
  ppb.writeUint32(0xd94, 5);
  for (const [address, forbidden] of [[0x1ffeffff, false], [0x1fff0000, true], [0x1fffffff, true], [0x20000000, false]]) {
    assert.equal(mpu.forbids(address), forbidden, address.toString(16));
  }
  assert.equal(ppb.readUint32(0xd98), 3);
  ppb.writeUint32(0xda0, (3 << 24) | (15 << 1) | 1);
  assert.equal(mpu.forbids(0x1fff0000), false, 'all may access it');
});

test('the other registers of the bus are left alone', () => {
  const { ppb, others } = unit();
  ppb.writeUint32(0xd08, 7);
  assert.deepEqual(others, [[0xd08, 7]]);
  assert.equal(ppb.readUint32(0xd08), 0xd08);
});
