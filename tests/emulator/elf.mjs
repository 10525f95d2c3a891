// Just enough of ELF32 to put an image into flash and to find symbols by name.

import { readFileSync } from 'node:fs';

const FLASH_START = 0x10000000;
const FLASH_END = 0x11000000;
const PT_LOAD = 1;
const SHT_SYMTAB = 2;

/** Reads an ELF file, or a raw flash image (then without symbols). */
export function loadImage(path) {
  const bytes = readFileSync(path);
  const isElf = bytes.length > 52 && bytes.readUInt32BE(0) === 0x7f454c46;
  return isElf ? parseElf(bytes) : { flash: [{ offset: 0, bytes }], symbols: new Map() };
}

/** The pieces of flash (at their load addresses) and the symbols of an ELF file. */
export function parseElf(bytes) {
  const flash = [];
  for (const header of table(bytes, 28, 42, 44)) {
    const [type, offset, , physical, size] = words(bytes, header, 5);
    if (type !== PT_LOAD || size === 0) continue;
    if (physical < FLASH_START || physical >= FLASH_END) {
      throw new Error(`segment loads at 0x${physical.toString(16)}, which is not flash`);
    }
    flash.push({ offset: physical - FLASH_START, bytes: bytes.subarray(offset, offset + size) });
  }
  return { flash, symbols: symbols(bytes) };
}

function symbols(bytes) {
  const found = new Map();
  const sections = table(bytes, 32, 46, 48).map((at) => words(bytes, at, 10));
  for (const [, type, , , offset, size, link] of sections) {
    if (type !== SHT_SYMTAB) continue;
    const names = sections[link][4];
    for (let at = offset; at < offset + size; at += 16) {
      const [name, value, length] = words(bytes, at, 3);
      if (name !== 0) found.set(text(bytes, names + name), { address: value, size: length });
    }
  }
  return found;
}

/** File offsets of the entries of a header table, given where the ELF header keeps its offset, entry size and count. */
function table(bytes, offsetAt, sizeAt, countAt) {
  const start = bytes.readUInt32LE(offsetAt);
  const size = bytes.readUInt16LE(sizeAt);
  return Array.from({ length: bytes.readUInt16LE(countAt) }, (_, i) => start + i * size);
}

function words(bytes, at, count) {
  return Array.from({ length: count }, (_, i) => bytes.readUInt32LE(at + 4 * i));
}

function text(bytes, at) {
  return bytes.toString('latin1', at, bytes.indexOf(0, at));
}
