import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { CYCLES_PER_NEXT, CYCLES_PER_TRANSFER, mendDma } from './dma.mjs';

const RAM = 0x20000000, DMA = 0x50000000, CYCLE = 8;
const READ = 0x00, WRITE = 0x04, COUNT = 0x08, TRIGGER = 0x0c, CTRL = 0x10, WRITE_TRIGGER = 0x2c;
const BUSY = 1 << 24;
const EN = 1, BYTE = 0 << 2, HALF = 1 << 2, WORD = 2 << 2, INCR_READ = 1 << 4, INCR_WRITE = 1 << 5;
const RING_WRITE = 1 << 10, ALWAYS = 63 << 15;
const ring = (bits) => bits << 6;
const chain = (channel) => channel << 11;
const paced = (treq) => treq << 15;

/** Mended DMA, and a function that sets a channel up: `trigger` is the register that takes its control word. */
function dma() {
  const parts = board();
  const forbidden = [];
  mendDma(parts.chip, (channel) => forbidden.push(channel));
  const { chip } = parts;
  const channel = (number, read, write, count, control, trigger = TRIGGER) => {
    const base = DMA + 0x40 * number;
    chip.writeUint32(base + READ, read);
    chip.writeUint32(base + WRITE, write);
    chip.writeUint32(base + COUNT, count);
    chip.writeUint32(base + trigger, control);
  };
  const words = (address, count) => Array.from({ length: count }, (_, i) => chip.readUint32(RAM + address + 4 * i));
  const fill = (address, values) => values.forEach((value, i) => chip.writeUint32(RAM + address + 4 * i, value));
  return { ...parts, channel, words, fill, forbidden };
}

test('a transfer takes its cycles, and one that follows without a request only one', () => {
  const { channel, fill, words, advance } = dma();
  fill(0, [11, 22, 33]);
  channel(0, RAM, RAM + 64, 3, EN | WORD | INCR_READ | INCR_WRITE | chain(0) | ALWAYS);
  advance((CYCLES_PER_TRANSFER - 1) * CYCLE);
  assert.deepEqual(words(64, 3), [0, 0, 0]);
  advance(CYCLE);
  assert.deepEqual(words(64, 3), [11, 0, 0]);
  advance(CYCLES_PER_NEXT * CYCLE);
  assert.deepEqual(words(64, 3), [11, 22, 0]);
  advance(CYCLES_PER_NEXT * CYCLE);
  assert.deepEqual(words(64, 3), [11, 22, 33]);
});

test('each transfer of a channel that others trigger takes its cycles', () => {
  const { channel, fill, words, advance } = dma();
  fill(0, [11, 22]);
  channel(1, RAM + 4, RAM + 68, 1, EN | WORD | chain(1) | ALWAYS, CTRL);
  channel(0, RAM, RAM + 64, 1, EN | WORD | chain(1) | ALWAYS);
  advance((2 * CYCLES_PER_TRANSFER - 1) * CYCLE);
  assert.deepEqual(words(64, 2), [11, 0]);
  advance(CYCLE);
  assert.deepEqual(words(64, 2), [11, 22]);
});

test('a jammed channel is busy until it is aborted', () => {
  const { chip, channel, fill, words, advance } = dma();
  const isBusy = () => (chip.readUint32(DMA + TRIGGER) & BUSY) !== 0;
  fill(0, [1]);
  chip.dma.channels[0].jammed = true;
  channel(0, RAM, RAM + 64, 1, EN | WORD | chain(0) | ALWAYS);
  advance(1e6);
  assert.deepEqual([words(64, 1), isBusy()], [[0], true]);
  chip.writeUint32(DMA + 0x444, 1);
  assert.equal(isBusy(), false);
});

test('bytes, halfwords and words', () => {
  const { channel, fill, words, advance } = dma();
  fill(0, [0x44332211]);
  [BYTE, HALF, WORD].forEach((size, i) => channel(i, RAM, RAM + 64 + 4 * i, 1, EN | size | chain(i) | ALWAYS));
  advance(1000);
  assert.deepEqual(words(64, 3), [0x11, 0x2211, 0x44332211]);
});

test('a ring wraps the read address or the write address', () => {
  const { channel, fill, words, advance } = dma();
  fill(0, [1, 2, 3, 4]);
  channel(0, RAM, RAM + 64, 4, EN | WORD | INCR_READ | INCR_WRITE | ring(3) | chain(0) | ALWAYS);
  channel(1, RAM, RAM + 128, 4, EN | WORD | INCR_READ | INCR_WRITE | ring(3) | RING_WRITE | chain(1) | ALWAYS);
  advance(1000);
  assert.deepEqual(words(64, 4), [1, 2, 1, 2]);
  assert.deepEqual(words(128, 3), [3, 4, 0]);
});

test('a chain goes round, a transfer count starts anew, and a request paces it', () => {
  const { chip, channel, fill, words, advance } = dma();
  const DREQ = 36;
  fill(0, [1, 2, 3]);
  channel(1, RAM + 32, RAM + 96, 1, EN | WORD | INCR_WRITE | chain(0) | paced(DREQ), CTRL);
  channel(0, RAM, RAM + 64, 1, EN | WORD | INCR_READ | INCR_WRITE | chain(1) | paced(DREQ));
  for (const expected of [[0, 0], [1, 0], [1, 0], [1, 2]]) {
    assert.deepEqual(words(64, 2), expected);
    chip.dma.setDREQ(DREQ);
    chip.dma.clearDREQ(DREQ);
    advance(CYCLES_PER_TRANSFER * CYCLE);
  }
  advance(1e6);
  assert.deepEqual(words(64, 3), [1, 2, 0]);
});

test('a channel writes another\'s registers, which starts it; a zero does not', () => {
  const { channel, fill, words, advance } = dma();
  fill(0, [RAM + 64, RAM + 72, 0, RAM + 80]);
  fill(32, [7, 8, 9]);
  channel(1, RAM + 32, 0, 1, EN | WORD | INCR_READ | chain(0) | ALWAYS, CTRL);
  channel(0, RAM, DMA + 0x40 + WRITE_TRIGGER, 1, EN | WORD | INCR_READ | chain(0) | ALWAYS);
  advance(1e5);
  assert.deepEqual(words(64, 5), [7, 0, 8, 0, 0]);
});

test('timers run at X/Y of the system clock', () => {
  for (const number of [0, 3]) {
    const { chip, channel, fill, words, advance } = dma();
    fill(0, [1, 2, 3]);
    chip.writeUint32(DMA + 0x420 + 4 * number, (1 << 16) | 125);
    channel(0, RAM, RAM + 64, 3, EN | WORD | INCR_READ | INCR_WRITE | chain(0) | paced(59 + number));
    advance(2000);
    assert.deepEqual(words(64, 3), [1, 2, 0]);
    advance(1000);
    assert.deepEqual(words(64, 3), [1, 2, 3]);
  }
});

test('an aborted channel stands still, and says so', () => {
  const { chip, channel, fill, words, advance } = dma();
  fill(0, [1, 2, 3]);
  channel(0, RAM, RAM + 64, 3, EN | WORD | INCR_READ | INCR_WRITE | chain(0) | ALWAYS);
  advance(CYCLES_PER_TRANSFER * CYCLE);
  chip.writeUint32(DMA + 0x444, 1);
  assert.equal(chip.readUint32(DMA + 0x444), 0);
  advance(1000);
  assert.deepEqual(words(64, 2), [1, 0]);
});

test('the core\'s own ports are out of reach', () => {
  const { channel, advance, forbidden } = dma();
  channel(3, RAM, 0xd0000010, 1, EN | WORD | chain(3) | ALWAYS);
  advance(1000);
  assert.deepEqual(forbidden, [3]);
});
