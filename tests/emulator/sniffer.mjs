// The sniffer of the RP2040's DMA (datasheet, 2.5.5.2), which rp2040js lacks: sees the data of a channel, and computes their
// CRC-32. Its other sums are not modelled.

const SNIFF_CTRL = 0x434, SNIFF_DATA = 0x438;
const EN = 1 << 0, CALC_SHIFT = 5, BSWAP = 1 << 9, OUT_REV = 1 << 10, OUT_INV = 1 << 11, CTRL_MASK = 0xfff;
const CRC32 = 0, CRC32R = 1;
const POLYNOMIAL = 0x04c11db7; // IEEE 802.3
const SNIFF_EN = 1 << 23; // of a channel

/** The lowest `count` bits of a word, in the other order. */
function reversed(word, count = 32) {
  let turned = 0;
  for (let bit = 0; bit < count; bit++) turned = (turned << 1) | ((word >>> bit) & 1);
  return turned >>> 0;
}

/** The bytes of a word, in the other order. */
function swapped(word, bits) {
  let turned = 0;
  for (let bit = 0; bit < bits; bit += 8) turned = (turned << 8) | ((word >>> bit) & 0xff);
  return turned >>> 0;
}

export class Sniffer {
  constructor(dma) {
    this.control = 0;
    this.sum = 0;
    this.seen = 0; // bytes
    const { readUint32, writeUint32 } = dma;
    dma.readUint32 = (offset) => {
      if (offset === SNIFF_CTRL) return this.control;
      return offset === SNIFF_DATA ? this.result : readUint32.call(dma, offset);
    };
    dma.writeUint32 = (offset, value) => {
      if (offset === SNIFF_CTRL) this.begin(value & CTRL_MASK, dma);
      else if (offset === SNIFF_DATA) this.sum = value >>> 0;
      else writeUint32.call(dma, offset, value);
    };
  }

  begin(control, dma) {
    this.control = control;
    if (![CRC32, CRC32R].includes(this.calculation)) dma.warn(`the sniffer computes no sum of kind ${this.calculation}`);
  }

  get calculation() {
    return (this.control >>> CALC_SHIFT) & 0xf;
  }

  get result() {
    const turned = this.control & OUT_REV ? reversed(this.sum) : this.sum;
    return (this.control & OUT_INV ? ~turned : turned) >>> 0;
  }

  /** Sees what the channel of this number and control word transfers: `bits` bits. */
  see(channel, control, data, bits) {
    const watched = this.control & EN && ((this.control >>> 1) & 0xf) === channel && control & SNIFF_EN;
    if (!watched) return;
    const ordered = this.control & BSWAP ? swapped(data, bits) : data;
    this.seen += bits / 8;
    this.add(this.calculation === CRC32R ? reversed(ordered, bits) : ordered, bits);
  }

  /** Shifts data through the register, the highest bit first. */
  add(data, bits) {
    let sum = this.sum ^ (data << (32 - bits));
    for (let bit = 0; bit < bits; bit++) sum = (sum << 1) ^ (sum < 0 ? POLYNOMIAL : 0);
    this.sum = sum >>> 0;
  }
}
