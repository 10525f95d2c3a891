import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { PowerCut, Rom } from './rom.mjs';

/** A ROM, and `call(name, ...arguments)`, which finds a function as drivers do and runs it. */
function rom() {
  const { chip } = board();
  const it = new Rom(chip);
  const run = (address, ...values) => {
    values.forEach((value, i) => { chip.core.registers[i] = value; });
    const breakpoint = chip.readUint16(address & ~1);
    chip.core.PC = (address & ~1) + 2;
    assert.equal(chip.readUint16(chip.core.PC), 0x4770);
    assert.ok(it.handles(breakpoint & 0xff));
    return chip.core.registers[0];
  };
  const find = (name) => run(chip.readUint16(0x18), chip.readUint16(0x14), name.charCodeAt(0) | (name.charCodeAt(1) << 8));
  return { it, chip, find, call: (name, ...values) => run(find(name), ...values) };
}

test('an unknown function is not found', () => {
  assert.equal(rom().find('XX'), 0);
});

test('erasing sets a sector, programming only clears bits, and both take their time', () => {
  const { chip, it, call } = rom();
  chip.flash.fill(0, 0x1f8000, 0x1fa000);
  call('RE', 0x1f8000, 4096);
  assert.deepEqual([chip.flash[0x1f8000], chip.flash[0x1f8fff], chip.flash[0x1f9000]], [0xff, 0xff, 0]);
  chip.sram.fill(0x0f, 0, 256);
  call('RP', 0x1f8000, 0x20000000, 256);
  chip.sram.fill(0xf1, 0, 256);
  call('RP', 0x1f8000, 0x20000000, 256);
  assert.deepEqual([chip.flash[0x1f8000], chip.flash[0x1f8100]], [0x01, 0xff]);
  assert.deepEqual([it.erased, it.programmed], [1, 2]);
  assert.equal(chip.core.cycles, (45 + 1.4) * 125_000);
});

test('a breakpoint of the program is not the ROM\'s', () => {
  const { it, chip } = rom();
  chip.core.PC = 0x10000102;
  assert.equal(it.handles(0), false);
});

test('where the power fails, half of a step is done', () => {
  const { chip, it, call } = rom();
  chip.flash.fill(0, 0x1f8000, 0x1fa000);
  it.cutAt = 2;
  call('RE', 0x1f8000, 4096);
  assert.throws(() => call('RE', 0x1f9000, 4096), PowerCut);
  assert.deepEqual([0x1f8fff, 0x1f97ff, 0x1f9800].map((at) => chip.flash[at]), [0xff, 0xff, 0]);
  assert.equal(it.erased, 1);
});
