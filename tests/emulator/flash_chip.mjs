// The flash chip as its port reaches it: of its commands, rp2040js knows only that for its state.

const CTRLR0 = 0x00, CTRLR1 = 0x04, SSIENR = 0x08, SR = 0x28, DR = 0x60;
const MODE = 3 << 8, READS = 3 << 8; // this mode: a command is sent, then CTRLR1 + 1 bytes are received
const NOT_EMPTY = 1 << 3;
const READ_UNIQUE_ID = 0x4b, DUMMIES = 4;

export class FlashChip {
  /** Takes over the registers of the port. `uniqueId`: 8 bytes. */
  constructor(port, uniqueId) {
    const [read, write] = [port.readUint32.bind(port), port.writeUint32.bind(port)];
    Object.assign(this, { read, uniqueId });
    this.end();
    port.readUint32 = (offset) => this.answer(offset) ?? read(offset);
    port.writeUint32 = (offset, value) => {
      if (offset === SSIENR) this.end();
      if (offset === DR) this.take(value & 0xff);
      write(offset, value);
    };
  }

  /** No command is under way. */
  end() {
    this.begun = false;
    this.received = undefined; // bytes of an answer, while there is one
  }

  take(byte) {
    if (!this.begun && byte === READ_UNIQUE_ID && (this.read(CTRLR0) & MODE) === READS) {
      const sent = [...Array(DUMMIES).fill(0xff), ...this.uniqueId];
      this.received = Array.from({ length: this.read(CTRLR1) + 1 }, (_, i) => sent[i] ?? 0xff);
    }
    this.begun = true;
  }

  answer(offset) {
    if (this.received === undefined) return undefined;
    if (offset === SR) return this.received.length > 0 ? this.read(SR) : this.read(SR) & ~NOT_EMPTY;
    return offset === DR ? this.received.shift() ?? 0 : undefined;
  }
}
