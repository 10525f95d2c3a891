// DMA as on the RP2040: a transfer takes its time, the pacing timers run at X/Y of the system clock, and the core's own
// ports are out of reach. rp2040js transfers in no time, has X and Y swapped and timer 3 at the wrong bits, cannot say that
// an abort is over, has no sniffer, and lets DMA write anywhere.

import { Sniffer } from './sniffer.mjs';

const SIO_START = 0xd0000000;
const CHAN_ABORT = 0x444;
const TIMER0 = 59, TIMER3 = 62, PERMANENT = 63;
/** From the request, or the trigger, to the next one in a chain: read address, read data, write address, write data. */
export const CYCLES_PER_TRANSFER = 4;
/** From one transfer of a channel that nothing paces to its next one: the DMA reads and writes once in each cycle. */
export const CYCLES_PER_NEXT = 1;

/**
 * Mends the chip's DMA in place. `forbidden(channel)` is called for an access that silicon does not allow. A channel that
 * is `jammed` never transfers.
 */
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
  dma.sniffer = new Sniffer(dma);
  for (const channel of dma.channels) {
    const { transfer, transferAlarm } = channel;
    let goesOn = false;
    sniffed(channel, rp2040, dma.sniffer);
    channel.scheduleTransfer = () => {
      const treq = channel.treqValue;
      if (channel.jammed) return;
      if (treq === PERMANENT) {
        transferAlarm.schedule((goesOn ? CYCLES_PER_NEXT : CYCLES_PER_TRANSFER) * nanosPerCycle());
      } else if (dma.dreq[treq]) {
        transferAlarm.schedule(CYCLES_PER_TRANSFER * nanosPerCycle());
      } else if (treq >= TIMER0 && treq <= TIMER3 && periodNanos(treq) < Infinity) {
        transferAlarm.schedule(periodNanos(treq));
      }
    };
    transferAlarm.callback = () => {
      if (channel.writeAddr >>> 0 >= SIO_START || channel.readAddr >>> 0 >= SIO_START) forbidden(channel.index);
      goesOn = true;
      transfer();
      goesOn = false;
    };
  }
}

/** Shows what a channel transfers to the sniffer, which is behind the channel's own swap of bytes. */
function sniffed(channel, rp2040, sniffer) {
  const swap16 = (data) => ((data & 0xff) << 8) | (data >> 8);
  const swap32 = (data) => ((swap16(data & 0xffff) << 16) | swap16(data >>> 16)) >>> 0;
  const same = (data) => data;
  const kinds = { transfer8: [8, same], transfer16: [16, same], transferSwap16: [16, swap16], transfer32: [32, same], transferSwap32: [32, swap32] };
  for (const [name, [bits, turn]] of Object.entries(kinds)) {
    const [read, write] = [`readUint${bits}`, `writeUint${bits}`];
    channel[name] = () => {
      const data = turn(rp2040[read](channel.readAddr));
      rp2040[write](channel.writeAddr, data);
      sniffer.see(channel.index, channel.ctrl, data, bits);
    };
  }
  channel.reset(); // which chooses one of these
}
