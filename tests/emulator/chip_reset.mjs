// The voltage regulator's block, of which rp2040js has nothing: its registers keep what is written, and one of
// them says what reset the chip as a whole. A supply that sags below the threshold of the brown-out detector resets
// the chip, if that is switched on (RP2040 datasheet, 2.10.6); what a processor does with too little is not modelled.

import { BasePeripheral } from 'rp2040js';

export const CHIP_RESET_BASE = 0x40064;
export const BOD = 0x4;
const VREG = 0x0, CHIP_RESET = 0x8;
const DETECTS = 1, LOWEST_MV = 473, STEP_MV = 43;
const AT_RESET = { [VREG]: 0xb1, [BOD]: 0x91 };
const CAUSES = { power: 1 << 8, pin: 1 << 16, debugger: 1 << 20 };

export class ChipReset extends BasePeripheral {
  /** `cause`: 'power', 'pin' or 'debugger'. */
  constructor(chip, cause = 'power') {
    super(chip, 'VREG_AND_CHIP_RESET');
    if (CAUSES[cause] === undefined) throw new Error(`a chip is reset by ${Object.keys(CAUSES).join(', ')}, not by ${cause}`);
    this.cause = cause;
    this.kept = { ...AT_RESET };
  }

  readUint32(offset) {
    if (offset === CHIP_RESET) return CAUSES[this.cause];
    return this.kept[offset] ?? super.readUint32(offset);
  }

  /** Whether the chip resets itself at this voltage of its core. */
  browns(millivolts) {
    const detector = this.kept[BOD];
    return (detector & DETECTS) !== 0 && millivolts < LOWEST_MV + STEP_MV * ((detector >>> 4) & 15);
  }

  writeUint32(offset, value) {
    if (offset in this.kept) this.kept[offset] = value;
    else super.writeUint32(offset, value);
  }
}
