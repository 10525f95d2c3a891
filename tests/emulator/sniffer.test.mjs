import assert from 'node:assert/strict';
import { test } from 'node:test';
import { board } from './board.fixture.mjs';
import { mendDma } from './dma.mjs';

const RAM = 0x20000000, DMA = 0x50000000;
const READ = 0x00, WRITE = 0x04, COUNT = 0x08, TRIGGER = 0x0c, SNIFF_CTRL = 0x434, SNIFF_DATA = 0x438;
const SIZES = { 1: 0 << 2, 2: 1 << 2, 4: 2 << 2 };
const EN = 1, INCR_READ = 1 << 4, BSWAP = 1 << 22, SNIFF_EN = 1 << 23, ALWAYS = 63 << 15;
const CRC32 = 0, CRC32R = 1 << 5, CRC16 = 2 << 5, SNIFF_BSWAP = 1 << 9, OUT_REV = 1 << 10, OUT_INV = 1 << 11;
const CHANNEL = 11;
/** As in zlib: bits reversed, in and out, and inverted. */
const ZLIB = CRC32R | OUT_REV | OUT_INV;

/** What the sniffer computes of bytes, read in pieces of `size`; `watched`: its channel. */
function sum(bytes, kind, { size = 1, control = SNIFF_EN, watched = CHANNEL, seed = 0xffffffff } = {}) {
  const { chip, advance } = board();
  mendDma(chip, () => assert.fail('out of reach'));
  bytes.forEach((byte, i) => chip.writeUint8(RAM + i, byte));
  chip.writeUint32(DMA + SNIFF_CTRL, EN | (watched << 1) | kind);
  chip.writeUint32(DMA + SNIFF_DATA, seed);
  const base = DMA + 0x40 * CHANNEL;
  chip.writeUint32(base + READ, RAM);
  chip.writeUint32(base + WRITE, RAM + 4096);
  chip.writeUint32(base + COUNT, bytes.length / size);
  chip.writeUint32(base + TRIGGER, EN | SIZES[size] | INCR_READ | (CHANNEL << 11) | ALWAYS | control);
  advance(1e6);
  return chip.readUint32(DMA + SNIFF_DATA);
}

/** By table, a byte at a time: CRC-32/ISO-HDLC, as in zlib. */
const TABLE = Array.from({ length: 256 }, (_, byte) => {
  for (let bit = 0; bit < 8; bit++) byte = byte & 1 ? (byte >>> 1) ^ 0xedb88320 : byte >>> 1;
  return byte;
});
const crc32 = (bytes) => ~bytes.reduce((sum, byte) => (sum >>> 8) ^ TABLE[(sum ^ byte) & 0xff], 0xffffffff) >>> 0;

const CHECK = [...Buffer.from('123456789')];
const random = (count) => Array.from({ length: count }, () => Math.floor(Math.random() * 256));

test('the check values of both orders of bits', () => {
  assert.equal(crc32(CHECK), 0xcbf43926);
  assert.equal(sum(CHECK, ZLIB), 0xcbf43926); // CRC-32/ISO-HDLC
  assert.equal(sum(CHECK, CRC32 | OUT_INV), 0xfc891918); // CRC-32/BZIP2
  assert.equal(sum(CHECK, CRC32), 0x0376e6e7); // CRC-32/MPEG-2
});

test('random bytes have the sum by table, in pieces of any size', () => {
  for (let count = 4; count <= 1024; count *= 2) {
    const bytes = random(count);
    for (const size of [1, 2, 4]) assert.equal(sum(bytes, ZLIB, { size }), crc32(bytes), `${size}: ${bytes}`);
  }
});

test('a sum goes on from a seed', () => {
  const first = sum(CHECK.slice(0, 4), CRC32R);
  assert.equal(sum(CHECK.slice(4), ZLIB, { seed: first }), 0xcbf43926);
});

test('bytes are swapped by the channel or by the sniffer, and twice is not at all', () => {
  const bytes = random(64);
  const plain = sum(bytes, ZLIB, { size: 4 });
  const swapped = bytes.map((_, i) => bytes[i ^ 3]);
  assert.equal(sum(swapped, ZLIB | SNIFF_BSWAP, { size: 4 }), plain);
  assert.equal(sum(swapped, ZLIB, { size: 4, control: SNIFF_EN | BSWAP }), plain);
  assert.equal(sum(bytes, ZLIB | SNIFF_BSWAP, { size: 4, control: SNIFF_EN | BSWAP }), plain);
});

test('only the channel that is watched is seen, if it lets itself be seen', () => {
  assert.equal(sum(CHECK, CRC32R, { watched: 3 }), 0xffffffff);
  assert.equal(sum(CHECK, CRC32R, { control: 0 }), 0xffffffff);
});

test('other sums are refused', () => {
  assert.throws(() => sum(CHECK, CRC16), /no sum of kind 2/);
});
