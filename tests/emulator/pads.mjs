// What stands at the pins: what drives them, the pads' own resistors, and what is wrong with the wires, as in the simulated
// board's pads.rs. rp2040js shows at an input only what somebody outside has set, knows no resistor, and nothing that an output
// does comes back.

const PULL_KOHM = 55, SOURCE_KOHM = 1;
const FULL = 4095;
const FIRST_ADC_PIN = 26, ADC_PINS = 4;

export class Pads {
  /** Takes over what the chip's inputs read. */
  constructor(chip) {
    this.pins = chip.gpio;
    // As the simulated board's: { pin, fault }, a fault being 'stuck-high', 'stuck-low', { bridged: pin }, 'open', 'grounded' or 'supplied'.
    this.faults = [];
    this.held = 0;
    Object.defineProperty(chip, 'gpioValues', { get: () => this.read() });
  }

  /** Bit n: what the chip reads at GPIO n. */
  read() {
    return this.pins.reduce((word, pin, n) => (this.level(n) && pin.inputEnable ? word | (1 << n) : word), 0);
  }

  /** The level of a pin; undefined where nothing drives, pulls or shorts it. */
  level(number) {
    let level = this.ownLevel(number);
    for (const { pin, fault } of this.faults) {
      if (fault?.bridged !== undefined && (pin === number || fault.bridged === number)) level = this.bridge(pin, fault.bridged);
      if (pin === number && fault === 'stuck-high') level = true;
      if (pin === number && fault === 'stuck-low') level = false;
    }
    return level;
  }

  /** What drives an address line, or shorts it; undefined where nothing does. */
  drivenLevel(number) {
    const pin = this.pins[number];
    if (this.faults.length > 0 && (drives(pin) || this.faults.some((f) => f.pin === number || f.fault?.bridged === number))) return this.level(number);
    return drives(pin) ? pin.outputValue : undefined;
  }

  ownLevel(number) {
    const pin = this.pins[number];
    if (drives(pin)) return pin.outputValue;
    if (pin.rawInputValue || pin.pullupEnabled) return true;
    return pin.pulldownEnabled ? false : undefined;
  }

  /** An output is stronger than a resistor; where two of either kind fight, ground wins. */
  bridge(a, b) {
    const driven = [a, b].filter((number) => drives(this.pins[number]));
    const levels = (driven.length > 0 ? driven : [a, b]).map((number) => this.ownLevel(number)).filter((level) => level !== undefined);
    return levels.length === 0 ? undefined : levels.every(Boolean);
  }

  /** The code of the converter's channel under a garment. While an input is pulled, that is no scan of the garment. */
  sample(channel, garment) {
    if (channel >= ADC_PINS) return garment.sample(channel);
    const pin = this.pins[FIRST_ADC_PIN + channel];
    const end = pin.pullupEnabled ? FULL : pin.pulldownEnabled ? 0 : undefined;
    const settled = end === undefined ? garment.sample(channel) : garment.peek(channel);
    this.held = this.code(FIRST_ADC_PIN + channel, settled, end);
    return this.held;
  }

  code(input, settled, end) {
    const fault = this.faults.find(({ pin }) => pin === input)?.fault;
    if (fault === 'grounded') return 0;
    if (fault === 'supplied') return FULL;
    if (fault === 'open') return end ?? this.held;
    return end === undefined ? settled : Math.round(settled + ((end - settled) * SOURCE_KOHM) / (SOURCE_KOHM + PULL_KOHM));
  }
}

function drives(pin) {
  return pin.outputEnable && !pin.outputDisable;
}
