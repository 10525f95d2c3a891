// PIO in step with the board's clock: an enabled state machine executes one instruction per tick of its divided clock, and
// nothing while it is stalled. rp2040js runs its machines from a timer of the host, a thousand instructions at a time, the
// disabled ones too, and knows no divider.

import { RPPIO } from 'rp2040js';

const WAIT_FOR_PIN = 1;
const SHIFTCTRL = 0xd0, MACHINE_REGISTERS = 0x18, JOINTS = 3 << 30;

export class Pio extends RPPIO {
  constructor(rp2040, name, firstIrq, index) {
    super(rp2040, name, firstIrq, index);
    this.alarms = this.machines.map((machine) => rp2040.clock.createAlarm(() => this.tick(machine)));
    // A divider that starts anew shifts the machine's ticks by less than one of them.
    for (const machine of this.machines) machine.clkDivRestart = () => {};
  }

  run() {
    this.wake();
  }

  readUint32(offset) {
    const value = super.readUint32(offset);
    this.wake();
    return value;
  }

  writeUint32(offset, value) {
    const machine = this.machines[(offset - SHIFTCTRL) / MACHINE_REGISTERS];
    if (machine !== undefined && (machine.shiftCtrl ^ value) & JOINTS) this.empty(machine);
    super.writeUint32(offset, value);
    this.checkChangedPins();
    this.wake();
  }

  /** Lets every machine tick that has something to do; one that waits for a pin looks at each tick. */
  wake() {
    for (const machine of this.machines) {
      const idle = !machine.enabled || (machine.waiting && machine.waitType !== WAIT_FOR_PIN);
      if (!idle && !this.alarms[machine.index].scheduled) this.schedule(machine, 1);
    }
  }

  /** Queues that are joined or parted lose what they hold. */
  empty(machine) {
    machine.txFIFO.reset();
    machine.rxFIFO.reset();
    machine.updateDMATx();
    machine.updateDMARx();
  }

  schedule(machine, ticks) {
    const divider = (machine.clockDivInt || 65536) + machine.clockDivFrac / 256;
    this.alarms[machine.index].schedule((ticks * divider * 1e9) / this.rp2040.clkSys);
  }

  tick(machine) {
    // The clock leaves the mark on an alarm that has rung.
    this.alarms[machine.index].scheduled = false;
    if (!machine.enabled) return;
    const before = machine.cycles;
    machine.step();
    this.checkChangedPins();
    const stalled = machine.waiting && machine.waitType !== WAIT_FOR_PIN;
    if (!stalled) this.schedule(machine, Math.max(1, machine.cycles - before));
    this.wake();
  }
}
