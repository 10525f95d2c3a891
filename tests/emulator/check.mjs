// Are the codes that the firmware is about to perceive those that the garment showed? Each frame is compared as a whole
// with the scan that had just ended, taxel by taxel of those that the scan has read.

const RAM_START = 0x20000000;

export class Check {
  constructor(garment, machine) {
    Object.assign(this, { garment, machine });
    this.last = undefined;
    // Frames compared; taxels in them that were wrong; scans between them that nobody saw; when the first and the last were lent.
    this.counts = { frames: 0, taxels: 0, wrong: 0, unseen: 0, first_us: 0, last_us: 0 };
  }

  /** The frame at this address of the board's memory is lent. */
  lent(address) {
    const { garment, machine, counts } = this;
    // The scan before the one under way; or the one before that, if the board has not heard yet that a scan has ended; or the
    // last one, if no other is under way.
    const newest = garment.scan - (this.read(garment.scan) === this.read(garment.scan - 1) ? 0 : 1);
    const candidates = [garment.scan - 1, garment.scan - 2, newest].filter((scan) => !(scan <= this.last));
    const compared = candidates.map((scan) => this.compare(scan, address)).filter((found) => found !== undefined);
    if (compared.length === 0) return;
    const best = compared.reduce((a, b) => (b.wrong < a.wrong ? b : a));
    const now = Math.round(machine.micros);
    if (counts.frames++ === 0) counts.first_us = now;
    counts.last_us = now;
    counts.taxels += best.taxels;
    counts.wrong += best.wrong;
    if (this.last !== undefined) counts.unseen += best.scan - this.last - 1;
    this.last = best.scan;
  }

  /** How many taxels a scan, or one after it, has read. */
  read(scan) {
    return this.garment.shown.reduce((count, last) => count + (last >= scan), 0);
  }

  compare(scan, address) {
    const { garment, machine } = this;
    const frame = garment.frameOf(scan);
    if (frame === undefined) return undefined;
    const found = { scan, taxels: 0, wrong: 0 };
    for (let taxel = 0; taxel < frame.length; taxel++) {
      if (garment.shown[taxel] < scan) continue;
      found.taxels++;
      const code = machine.chip.sramView.getUint16(address - RAM_START + 2 * taxel, true);
      if (code !== frame[taxel]) found.wrong++;
    }
    return found;
  }

  toJSON() {
    return this.counts;
  }
}
