// Drains defmt's log (RTT up-channel 0) out of the board's memory, as a debug probe would.

const RAM_START = 0x20000000;
// The control block: a 16-byte id, two counts, then the up-channel: name, buffer, size, write, read, flags.
const BUFFER = 28, SIZE = 32, WRITE = 36, READ = 40;

export class Rtt {
  constructor(symbols, ramView) {
    const symbol = symbols.get('_SEGGER_RTT');
    this.view = ramView;
    this.block = symbol ? symbol.address - RAM_START : undefined;
    this.bytes = [];
  }

  drain() {
    const { view, block } = this;
    if (block === undefined) return;
    const buffer = view.getUint32(block + BUFFER, true) - RAM_START;
    const size = view.getUint32(block + SIZE, true);
    const write = view.getUint32(block + WRITE, true);
    let read = view.getUint32(block + READ, true);
    if (read === write) return;
    for (; read !== write; read = (read + 1) % size) this.bytes.push(view.getUint8(buffer + read));
    view.setUint32(block + READ, read, true);
  }

  /** What can be read in the log without a decoder: the text that was formatted on the board, above all of a panic. */
  get text() {
    const runs = Buffer.from(this.bytes).toString('latin1').match(/[ -~\n]{6,}/g);
    return runs === null ? '' : runs.join(' | ');
  }
}
