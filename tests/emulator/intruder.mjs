// An interrupt before every instruction of a function: for races of the main loop with a handler.

import { BoardError } from './machine.mjs';

const EXCEPTION = 16; // number of the exception of interrupt 0
const QUIET_CALLS = 16; // so many calls without an interrupt begin the next round

export class Intruder {
  /**
   * Raises interrupt `irq` while the main loop is in the function whose mangled name ends with `name`, once a call and once a
   * round before each of its instructions, however rarely that one is reached. `settle()` makes the interrupt again what its
   * peripheral has of it, once the core has taken it.
   */
  constructor({ core, symbols }, irq, name, settle) {
    const found = [...symbols].filter(([symbol]) => symbol.endsWith(name));
    if (found.length !== 1) throw new BoardError(`${found.length} functions have a name that ends with ${name}`);
    const [[, { address, size }]] = found;
    const start = address & ~1;
    Object.assign(this, { core, irq, settle, start, end: start + size, raised: false, returns: false });
    /** Instructions before which it was raised in this round, how often it was in all, and calls since the last time. */
    Object.assign(this, { round: new Set(), count: 0, calls: 0 });
    const execute = core.executeInstruction.bind(core);
    core.executeInstruction = () => {
      this.before();
      return execute();
    };
  }

  before() {
    const { core, irq, start, end, round } = this;
    if (this.raised && core.IPSR === EXCEPTION + irq) {
      this.raised = false;
      this.returns = true;
      this.settle();
    }
    if (core.IPSR !== 0) return;
    if (this.returns) {
      // The instruction before which it came: seen already.
      this.returns = false;
      return;
    }
    const { PC } = core;
    if (PC < start || PC >= end) return;
    if (PC === start && ++this.calls > QUIET_CALLS) {
      round.clear();
      this.calls = 1;
    }
    if (this.raised || this.calls === 0 || round.has(PC)) return;
    round.add(PC);
    this.count++;
    this.calls = 0;
    this.raised = true;
    core.setInterrupt(irq, true);
  }
}
