import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { FlashChip } from './flash_chip.mjs';

const SSI = 0x18000000, CTRLR0 = SSI, CTRLR1 = SSI + 4, SSIENR = SSI + 8, SR = SSI + 0x28, DR = SSI + 0x60;
const READS = 0x300, NOT_EMPTY = 8;
const ID = [0xe6, 0x60, 0x58, 0x38, 0x83, 0x2f, 0x5c, 0x29];

/** A chip, and what it answers to a command: as many bytes as asked for, and whether there are more. */
function flash() {
  const { chip } = board();
  new FlashChip(chip.peripherals[SSI >>> 12], ID);
  const ask = (mode, command, count) => {
    chip.writeUint32(SSIENR, 0);
    chip.writeUint32(CTRLR0, mode);
    chip.writeUint32(CTRLR1, count - 1);
    chip.writeUint32(SSIENR, 1);
    chip.writeUint8(DR, command);
    const bytes = Array.from({ length: count }, () => {
      assert.ok(chip.readUint32(SR) & NOT_EMPTY);
      return chip.readUint8(DR);
    });
    return { bytes, more: (chip.readUint32(SR) & NOT_EMPTY) !== 0 };
  };
  return { chip, ask };
}

test('the unique id comes after four bytes, each time', () => {
  const { ask } = flash();
  for (let i = 0; i < 2; i++) assert.deepEqual(ask(READS, 0x4b, 12), { bytes: [0xff, 0xff, 0xff, 0xff, ...ID], more: false });
});

test('other commands and modes are not its own', () => {
  const { chip, ask } = flash();
  assert.ok(ask(READS, 0xeb, 2).bytes.every((byte) => byte === 0));
  assert.ok(ask(0, 0x4b, 12).bytes.every((byte) => byte === 0));
  chip.writeUint32(CTRLR0, READS);
  chip.writeUint8(DR, 0x4b);
  assert.equal(chip.readUint8(DR), 0, 'the command has begun before: this is a byte of its address');
});
