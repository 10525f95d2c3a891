// The memory protection unit of the core, of which rp2040js has nothing: its regions, and whether they forbid an address. Who accesses
// memory is not stopped by it; the machine asks where an access has gone wrong anyway.

const TYPE = 0xd90, CTRL = 0xd94, NUMBER = 0xd98, BASE = 0xd9c, ATTRIBUTES = 0xda0;
const REGIONS = 8;
const ENABLE = 1, VALID = 1 << 4, ACCESS = 7 << 24;

export class Mpu {
  /** Takes over its registers from the core's private bus. */
  constructor(ppb) {
    this.control = this.number = 0;
    this.regions = Array.from({ length: REGIONS }, () => ({ base: 0, attributes: 0 }));
    const [read, write] = [ppb.readUint32.bind(ppb), ppb.writeUint32.bind(ppb)];
    ppb.readUint32 = (offset) => this.read(offset) ?? read(offset);
    ppb.writeUint32 = (offset, value) => this.write(offset, value >>> 0) || write(offset, value);
  }

  read(offset) {
    const region = this.regions[this.number];
    return { [TYPE]: REGIONS << 8, [CTRL]: this.control, [NUMBER]: this.number, [BASE]: region.base | this.number, [ATTRIBUTES]: region.attributes }[offset];
  }

  /** Whether it was one of its registers. */
  write(offset, value) {
    if (offset === CTRL) this.control = value;
    else if (offset === NUMBER) this.number = value % REGIONS;
    else if (offset === BASE) {
      if (value & VALID) this.number = (value & 15) % REGIONS;
      this.regions[this.number].base = (value & ~0xff) >>> 0;
    } else if (offset === ATTRIBUTES) this.regions[this.number].attributes = value;
    else return false;
    return true;
  }

  /** Whether nobody may access an address: it lies in a region that is on and whose permission is none. */
  forbids(address) {
    return (this.control & ENABLE) !== 0 && this.regions.some(({ base, attributes }) => {
      const size = 2 ** (((attributes >>> 1) & 31) + 1);
      const within = address >= base && address < base + size;
      return (attributes & ENABLE) !== 0 && (attributes & ACCESS) === 0 && within;
    });
  }
}
