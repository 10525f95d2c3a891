import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { Uart } from './uart.mjs';

const DR = 0x00, FR = 0x18, IBRD = 0x24, FBRD = 0x28, LCR_H = 0x2c, CR = 0x30, IFLS = 0x34, IMSC = 0x38, RIS = 0x3c;
const ICR = 0x44, DMACR = 0x48;
const RX = 1 << 4, TX = 1 << 5, TIMEOUT = 1 << 6, OVERRUN = 1 << 10;
const BYTE_NANOS = (10 * 16 * (8 + 31 / 64)) / 125e6 * 1e9; // 921,600 Bd nearly, 8N1

/** A UART as embassy-rp sets it up: FIFOs on, interrupts at 28 received and 4 left to send. */
function uart() {
  const parts = board();
  const sent = [];
  const it = new Uart(parts.chip, 'UART0', 20, { tx: 20, rx: 21 }, (byte) => sent.push(byte));
  for (const [register, value] of [[IBRD, 8], [FBRD, 31], [LCR_H, 0x70], [IFLS, 0x20], [CR, 0x301], [IMSC, 0x7ff]]) {
    it.writeUint32(register, value);
  }
  return { it, sent, ...parts };
}

test('a byte takes ten bit times', () => {
  const { it, sent, advance } = uart();
  it.writeUint32(DR, 65);
  assert.equal(it.readUint32(FR) & (1 << 3), 1 << 3);
  advance(BYTE_NANOS * 0.99);
  assert.deepEqual(sent, []);
  advance(BYTE_NANOS * 0.02);
  assert.deepEqual(sent, [65]);
  assert.equal(it.readUint32(FR) & (1 << 3), 0);
});

test('the transmit interrupt comes once, on the way down through the level', () => {
  const { it, sent, advance, pending } = uart();
  assert.equal(pending(20), false);
  for (let i = 0; i < 33; i++) it.writeUint32(DR, i); // one goes to the shift register at once
  assert.equal(it.readUint32(FR) & (1 << 5), 1 << 5);
  advance(BYTE_NANOS * 27.5);
  assert.equal(it.readUint32(RIS) & TX, 0);
  advance(BYTE_NANOS);
  assert.equal(it.readUint32(RIS) & TX, TX);
  assert.equal(pending(20), true);
  it.writeUint32(ICR, TX);
  assert.equal(pending(20), false);
  advance(BYTE_NANOS * 5);
  assert.equal(it.readUint32(RIS) & TX, 0);
  assert.equal(sent.length, 33);
});

test('a byte for a full FIFO is an error', () => {
  const { it } = uart();
  for (let i = 0; i < 33; i++) it.writeUint32(DR, i);
  assert.throws(() => it.writeUint32(DR, 0), /full/);
});

test('received bytes come at the speed of the line, and interrupt at their level', () => {
  const { it, advance, pending } = uart();
  it.receive(Uint8Array.from({ length: 28 }, (_, i) => i));
  advance(BYTE_NANOS * 27.5);
  assert.equal(pending(20), false);
  advance(BYTE_NANOS);
  assert.equal(it.readUint32(RIS) & RX, RX);
  assert.equal(it.readUint32(DR), 0);
  assert.equal(pending(20), false);
});

test('a few bytes interrupt after 32 bit times of silence, until they are read', () => {
  const { it, advance, pending } = uart();
  it.receive([1, 2]);
  advance(BYTE_NANOS * 2.1 + BYTE_NANOS * 3);
  assert.equal(pending(20), false);
  advance(BYTE_NANOS * 0.2);
  assert.equal(it.readUint32(RIS), TIMEOUT);
  assert.deepEqual([it.readUint32(DR), it.readUint32(DR)], [1, 2]);
  assert.equal(it.readUint32(RIS), 0);
  assert.equal(it.readUint32(FR) & (1 << 4), 1 << 4);
});

test('a byte that finds the FIFO full is lost, and said to be', () => {
  const { it, advance } = uart();
  it.receive(Uint8Array.from({ length: 34 }, (_, i) => i));
  advance(BYTE_NANOS * 40);
  assert.equal(it.readUint32(RIS) & OVERRUN, OVERRUN);
  assert.equal(it.overruns, 2);
  for (let i = 0; i < 32; i++) assert.equal(it.readUint32(DR), i);
  it.receive([99]);
  advance(BYTE_NANOS * 2);
  assert.equal(it.readUint32(DR), 99 | (1 << 11));
});

test('DMA is asked for while there is something to do', () => {
  const { it, advance, requested } = uart();
  it.writeUint32(DMACR, 3);
  assert.equal(requested(20), true);
  assert.equal(requested(21), false);
  it.receive([5]);
  advance(BYTE_NANOS * 1.1);
  assert.equal(requested(21), true);
  it.readUint32(DR);
  assert.equal(requested(21), false);
});
