// Where the cycles go: the firmware writes the number of the stage it enters to the word TAXEL_MARK.

export class Marks {
  constructor() {
    this.stages = new Map();
    this.stage = undefined;
    this.since = 0;
  }

  /** Forgets what was counted, and the stage under way. */
  clear() {
    this.stages.clear();
    this.stage = undefined;
  }

  enter(stage, cycles) {
    if (this.stage !== undefined) this.add(cycles - this.since);
    this.stage = stage;
    this.since = cycles;
  }

  add(cycles) {
    const sum = this.stages.get(this.stage) ?? { count: 0, cycles: 0, max: 0 };
    sum.count++;
    sum.cycles += cycles;
    sum.max = Math.max(sum.max, cycles);
    this.stages.set(this.stage, sum);
  }

  toJSON() {
    return Object.fromEntries([...this.stages].sort(([a], [b]) => a - b));
  }
}
