// What the peripheral models need of a chip: a clock with alarms, interrupts, DMA requests.

import { RP2040 } from 'rp2040js';

/** A chip whose time is moved by `advance(nanos)`; a warning is an error. */
export function board() {
  const chip = new RP2040();
  const fail = (part, text) => { throw new Error(`${part}: ${text}`); };
  chip.logger = { debug() {}, info() {}, warn: fail, error: fail };
  return {
    chip,
    advance: (nanos) => chip.clock.tick(nanos),
    pending: (irq) => (chip.core.pendingInterrupts & (1 << irq)) !== 0,
    requested: (dreq) => Boolean(chip.dma.dreq[dreq]),
  };
}
