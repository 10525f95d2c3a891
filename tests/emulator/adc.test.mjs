import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Adc } from './adc.mjs';
import { board } from './board.fixture.mjs';

const CS = 0x00, RESULT = 0x04, FCS = 0x08, FIFO = 0x0c, INTE = 0x18;
const EN = 1, ONCE = 1 << 2, MANY = 1 << 3, READY = 1 << 8;
const CONVERSION_NANOS = 2000;

function adc() {
  const parts = board();
  const read = [];
  const it = new Adc(parts.chip, (channel) => { read.push(channel); return 1000 + channel; });
  it.writeUint32(CS, EN);
  return { it, read, ...parts };
}

test('one conversion takes 96 clocks of 48 MHz, and is one', () => {
  const { it, read, advance } = adc();
  it.writeUint32(CS, EN | ONCE | (2 << 12));
  assert.equal(it.readUint32(CS) & ONCE, 0);
  assert.deepEqual(read, [2]);
  advance(CONVERSION_NANOS - 1);
  assert.equal(it.readUint32(CS) & READY, 0);
  advance(2);
  assert.equal(it.readUint32(CS) & READY, READY);
  assert.equal(it.readUint32(RESULT), 1002);
  advance(10 * CONVERSION_NANOS);
  assert.equal(it.conversions, 1);
});

test('a converter that is off is not ready', () => {
  const { it } = adc();
  it.writeUint32(CS, 0);
  assert.equal(it.readUint32(CS) & READY, 0);
});

test('round robin takes the chosen channels in turn, channel 0 included', () => {
  const { it, read, advance } = adc();
  it.writeUint32(CS, EN | MANY | (0b11001 << 16));
  advance(CONVERSION_NANOS * 5.5);
  assert.deepEqual(read, [0, 3, 4, 0, 3, 4]);
});

test('the FIFO raises and lowers interrupt and DMA request with its level', () => {
  const { it, advance, pending, requested } = adc();
  it.writeUint32(FCS, 1 | (1 << 3) | (2 << 24));
  it.writeUint32(INTE, 1);
  it.writeUint32(CS, EN | ONCE);
  advance(CONVERSION_NANOS + 1);
  assert.deepEqual([pending(22), requested(36)], [false, false]);
  it.writeUint32(CS, EN | ONCE | (1 << 12));
  advance(CONVERSION_NANOS + 1);
  assert.deepEqual([pending(22), requested(36)], [true, true]);
  assert.equal(it.readUint32(FIFO), 1000);
  assert.deepEqual([pending(22), requested(36)], [false, false]);
  assert.equal(it.readUint32(FIFO), 1001);
  it.readUint32(FIFO);
  assert.equal(it.readUint32(FCS) & (1 << 10), 1 << 10);
});

test('a full FIFO loses the sample and says so; the flag is cleared by writing it', () => {
  const { it, advance } = adc();
  it.writeUint32(FCS, 1);
  it.writeUint32(CS, EN | MANY);
  advance(CONVERSION_NANOS * 5.5);
  assert.equal(it.readUint32(FCS) & (1 << 11), 1 << 11);
  it.writeUint32Atomic(FCS, 1 << 11, 0);
  assert.equal(it.readUint32(FCS) & (1 << 11), 0);
});

test('a starved FIFO loses as many samples as it is asked to, and then goes on', () => {
  const { it, advance } = adc();
  it.writeUint32(FCS, 1);
  it.starved = 2;
  it.writeUint32(CS, EN | MANY);
  advance(CONVERSION_NANOS * 3.5);
  assert.equal((it.readUint32(FCS) >> 16) & 15, 1);
  assert.equal(it.readUint32(FCS) & (1 << 11), 1 << 11);
});
