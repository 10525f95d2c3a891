// How deep the stack has been: what lies between it and the program's data is painted before the program starts.

const RAM_START = 0x20000000;
const PAINT = 0x5aa5c33c;

export class Stack {
  /** `top` is the first stack pointer; `_stack_end` is where the program's data ends. */
  constructor(symbols, ramView, top) {
    const bottom = symbols.get('_stack_end')?.address;
    Object.assign(this, { view: ramView, bottom: bottom === undefined ? top : (bottom + 3) & ~3, top });
    this.paint(top);
  }

  /** Forgets how deep it has been: all below the stack pointer `pointer` is painted anew. */
  paint(pointer) {
    for (let at = this.bottom; at < pointer; at += 4) this.view.setUint32(at - RAM_START, PAINT, true);
  }

  /** Bytes that were used at most since it was painted, and bytes that there are. */
  toJSON() {
    let at = this.bottom;
    while (at < this.top && this.view.getUint32(at - RAM_START, true) === PAINT) at += 4;
    return { used: this.top - at, size: this.top - this.bottom };
  }

  /** Whether it has reached the program's data, or came as near as makes no difference. */
  get overflown() {
    const { used, size } = this.toJSON();
    return size > 0 && used === size;
  }
}
