// DMA as on the RP2040: a transfer takes its time, the pacing timers run at X/Y of the system clock, and the core's own
// ports are out of reach. rp2040js transfers in no time, has X and Y swapped and timer 3 at the wrong bits, cannot say that
// an abort is over, and lets DMA write anywhere.

const SIO_START = 0xd0000000;
const CHAN_ABORT = 0x444;
const TIMER0 = 59, TIMER3 = 62, PERMANENT = 63;
/** From the request, or the trigger, to the next one in a chain: read address, read data, write address, write data. */
export const CYCLES_PER_TRANSFER = 4;

/** Mends the chip's DMA in place. `forbidden(channel)` is called for an access that silicon does not allow. */
export function mendDma(rp2040, forbidden) {
  const { dma } = rp2040;
  const nanosPerCycle = () => 1e9 / rp2040.clkSys;
  const periodNanos = (treq) => {
    const timer = [dma.timer0, dma.timer1, dma.timer2, dma.timer3][treq - TIMER0];
    const [x, y] = [timer >>> 16, timer & 0xffff];
    return x === 0 ? Infinity : Math.max(1, y / x) * nanosPerCycle();
  };
  const readUint32 = dma.readUint32.bind(dma);
  dma.readUint32 = (offset) => (offset === CHAN_ABORT ? 0 : readUint32(offset));
  for (const channel of dma.channels) {
    const { transfer, transferAlarm } = channel;
    channel.scheduleTransfer = () => {
      const treq = channel.treqValue;
      if (treq === PERMANENT || dma.dreq[treq]) {
        transferAlarm.schedule(CYCLES_PER_TRANSFER * nanosPerCycle());
      } else if (treq >= TIMER0 && treq <= TIMER3 && periodNanos(treq) < Infinity) {
        transferAlarm.schedule(periodNanos(treq));
      }
    };
    transferAlarm.callback = () => {
      if (channel.writeAddr >>> 0 >= SIO_START || channel.readAddr >>> 0 >= SIO_START) forbidden(channel.index);
      transfer();
    };
  }
}
