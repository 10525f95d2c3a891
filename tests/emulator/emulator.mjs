#!/usr/bin/env node
// Runs a firmware image on an emulated board. README.md says what each option does.

import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { parseArgs } from 'node:util';
import { setImmediate, setTimeout } from 'node:timers/promises';
import { allowed } from './allow.mjs';
import { Check } from './check.mjs';
import { BOD } from './chip_reset.mjs';
import { loadImage } from './elf.mjs';
import { Garment, readFrames, readWiring } from './garment.mjs';
import { Intruder } from './intruder.mjs';
import { Link } from './link.mjs';
import { BoardError, Machine, WatchdogReset } from './machine.mjs';
import { PowerCut } from './rom.mjs';
import { USB_IRQ } from './usb.mjs';

const SETTINGS_START = 0x1ca000, SETTINGS_END = 0x200000; // as in firmware/src/store.rs
const BATCH_NANOS = 500_000; // how often the world outside is looked at

const parent = process.ppid; // a harness that outlives its test would run for ever

const { values: options } = parseArgs({
  options: {
    image: { type: 'string' }, port: { type: 'string' }, link: { type: 'string', default: 'uart' }, wiring: { type: 'string' }, codes: { type: 'string' },
    idle: { type: 'string', default: '0' }, loop: { type: 'boolean', default: false },
    hold: { type: 'boolean', default: false }, dwell: { type: 'string', default: '1' }, period: { type: 'string' }, seconds: { type: 'string', default: 'Infinity' },
    'until-frames': { type: 'string', default: 'Infinity' }, realtime: { type: 'boolean', default: false },
    stats: { type: 'boolean', default: false }, rtt: { type: 'string' },
    every: { type: 'string' }, times: { type: 'boolean', default: false }, watch: { type: 'string', default: '' },
    flash: { type: 'string' }, cut: { type: 'string' }, restarts: { type: 'boolean', default: false },
    ground: { type: 'string', default: '' }, clock: { type: 'string', default: '0' }, 'reset-by': { type: 'string', default: 'power' },
    race: { type: 'string' }, 'unique-id': { type: 'string' }, 'usb-frames': { type: 'string' },
  },
});

function say(value) {
  process.stdout.write(`${JSON.stringify(value)}\n`);
}

function pinsOf(list) {
  return list.split(',').filter((pin) => pin !== '').map(Number);
}

function framesOf(list) {
  const [first, ppm, wander, period] = list.split(',').map(Number);
  return { first, ppm, wander, period };
}

function attachGarment(machine) {
  if (options.wiring === undefined) {
    machine.sample = () => Number(options.idle);
    return undefined;
  }
  const wiring = readWiring(options.wiring);
  const garment = new Garment({
    wiring, frames: options.codes === undefined ? [] : readFrames(options.codes, wiring.count),
    idle: Number(options.idle), loop: options.loop, dwell: Number(options.dwell),
    period: options.period === undefined ? undefined : Number(options.period) * 1000, playing: !options.hold,
    readPin: (pin) => machine.readPin(pin), now: () => machine.clock.nanosCounter,
    onPlay: (scan) => say({ play: { scan, us: machine.micros } }),
    onScan: (scan) => scan % Number(options.every) === 0 && say({ passed: { scan, us: machine.micros, cycles: machine.cycles } }),
  });
  machine.sample = (channel) => machine.pads.sample(channel, garment);
  if (options.period === undefined) {
    garment.check = new Check(garment, machine);
    machine.onLent = (address) => garment.check.lent(address);
  }
  return garment;
}

/** Says when messages have come whole, and when pins have changed. */
function sendTimes(machine, link) {
  if (options.times) link.onEnd = (bytes) => say({ end: { bytes, us: machine.micros } });
  for (const pin of pinsOf(options.watch)) {
    let last;
    machine.chip.gpio[pin].addListener(() => {
      const level = machine.readPin(pin);
      if (level !== last) say({ edge: { pin, level, us: machine.micros } });
      last = level;
    });
  }
}

function statistics({ machine, garment, intruder }, link, started) {
  const wall = (performance.now() - started) / 1000;
  return {
    emulated_us: Math.round(machine.micros), wall_ms: Math.round(wall * 1000), cycles: machine.cycles,
    mcycles_per_s: Number((machine.cycles / wall / 1e6).toFixed(1)), asleep_us: Math.round(machine.asleep / 1000),
    conversions: machine.chip.adc.conversions, scans: garment?.scan ?? 0, played: garment?.played ?? 0,
    floating: garment?.floating ?? 0, link: { sent: link.sent, dropped: link.dropped, received: link.received,
      uart_overruns: machine.uart.overruns }, usb: machine.usb.packets, uart: machine.uart.sent, rtt_bytes: machine.rtt.bytes.length, sniffed: machine.chip.dma.sniffer.seen, stack: machine.stack,
    marks: machine.marks, check: garment?.check, races: intruder?.count, brown_out: machine.supply.kept[BOD],
  };
}

function finished(machine, garment) {
  const enough = (garment?.played ?? 0) > Number(options['until-frames']);
  return enough || machine.micros >= Number(options.seconds) * 1e6 || process.ppid !== parent;
}

/**
 * Runs in short batches; between them the world outside has its turn. `board` holds the machine and the garment on its
 * pins.
 */
async function run(board, link, started, control) {
  while (!control.quit && !finished(board.machine, board.garment)) {
    const { machine } = board;
    try {
      machine.runUntil(machine.clock.nanosCounter + BATCH_NANOS);
    } catch (error) {
      if (!(error instanceof WatchdogReset)) throw error;
      say({ reset: error.forced ? 'program' : 'watchdog', us: machine.micros });
      board.start(machine);
    }
    machine.rtt.drain();
    link.flush();
    const ahead = machine.micros / 1000 - (performance.now() - started);
    if (options.realtime && ahead > 1) await setTimeout(ahead);
    else await setImmediate();
  }
  const { machine, garment } = board;
  if (machine.stack.overflown) throw new BoardError('the stack has reached the program\'s data');
  if (garment?.floating > 0) throw new BoardError(`an address line that nothing drives was read ${garment.floating} times`);
}

async function main() {
  const overUsb = options.link === 'usb';
  const image = loadImage(options.image);
  const board = {
    /** The power comes, or the watchdog has reset the machine `after` which another one goes on, or it has `browned` out. */
    start(after, browned) {
      const machine = new Machine(image, {
        allowed, onByte: (byte) => overUsb || link.push(byte), onBytes: (bytes) => bytes.forEach((byte) => link.push(byte)),
        onKnown: (usb) => say({ usb }), restarts: options.restarts, cause: options['reset-by'], after, browned, micros: Number(options.clock),
        onLockUp: (us) => say({ lockup: us }),
        frames: options['usb-frames'] === undefined ? undefined : framesOf(options['usb-frames']),
        uniqueId: options['unique-id'] === undefined ? undefined : Buffer.from(options['unique-id'], 'hex'),
      });
      machine.pads.faults = pinsOf(options.ground).map((pin) => ({ pin, fault: 'stuck-low' }));
      board.machine = machine;
      if (options.race !== undefined) board.intruder = new Intruder(machine, USB_IRQ, options.race, () => machine.chip.usbCtrl.update());
      sendTimes(machine, link);
      if (overUsb) {
        machine.usb.plug();
        machine.usb.open(link.client !== undefined);
      }
      board.garment = attachGarment(machine);
    },
  };
  const link = overUsb
    ? new Link((bytes) => board.machine.usb.send(bytes), (there) => board.machine.usb.open(there))
    : new Link((bytes) => board.machine.uart.receive(bytes));
  board.start();
  const settings = () => board.machine.chip.flash.subarray(SETTINGS_START, SETTINGS_END);
  if (options.flash !== undefined && existsSync(options.flash)) settings().set(readFileSync(options.flash));
  if (options.cut !== undefined) board.machine.rom.cutAt = Number(options.cut);
  if (options.port !== undefined) say({ port: await link.listen(Number(options.port)) });
  const started = performance.now();
  const control = { quit: false };
  const commands = {
    play: () => board.garment?.play(),
    stats: () => say({ stats: statistics(board, link, started) }),
    faults: (list) => {
      board.machine.pads.faults = JSON.parse(list);
      say({ faults: board.machine.pads.faults.length });
    },
    starve: (samples) => {
      board.machine.chip.adc.starved = Number(samples);
      say({ starve: board.machine.micros });
    },
    stall: (state) => {
      board.machine.chip.adc.stalled = state === 'on';
      say({ stall: board.machine.micros });
    },
    'dma-error': () => {
      board.machine.chip.dma.channels.forEach((channel) => channel.abort());
      say({ 'dma-error': board.machine.micros });
    },
    jam: (channel) => {
      board.machine.chip.dma.channels[Number(channel)].jammed = true;
      say({ jam: board.machine.micros });
    },
    read: (state) => {
      board.machine.usb.follow(state === 'on');
      say({ read: board.machine.micros });
    },
    sink: () => {
      board.machine.sink();
      say({ sink: board.machine.micros });
    },
    /** The core's supply sags for a moment, mV. */
    sag: (millivolts) => {
      const { machine } = board;
      const browns = machine.supply.browns(Number(millivolts));
      if (browns) board.start(machine, true);
      say({ sag: { browns, us: machine.micros } });
    },
    hang: () => {
      board.machine.hung = true;
      say({ hang: board.machine.micros });
    },
    stack: () => {
      say({ stack: board.machine.stack });
      board.machine.stack.paint(board.machine.core.SP);
    },
    plug: () => {
      board.machine.usb.plug();
      say({ plug: board.machine.micros });
    },
    unplug: () => {
      board.machine.usb.unplug();
      say({ unplug: board.machine.micros });
    },
    quit: () => { control.quit = true; },
  };
  createInterface({ input: process.stdin }).on('line', (line) => {
    const [command, ...rest] = line.trim().split(' ');
    commands[command]?.(rest.join(' '));
  });
  try {
    await run(board, link, started, control);
  } catch (error) {
    const { machine } = board;
    machine.rtt.drain();
    if (error instanceof PowerCut) return say({ cut: machine.rom.steps });
    if (error instanceof BoardError && machine.rtt.text !== '') error.message += `\nlog: ${machine.rtt.text}`;
    throw error;
  } finally {
    const { machine } = board;
    if (options.flash !== undefined) writeFileSync(options.flash, settings());
    if (options.rtt !== undefined) writeFileSync(options.rtt, Uint8Array.from(machine.rtt.bytes));
    if (options.stats) say({ stats: statistics(board, link, started) });
    await link.close();
  }
}

try {
  await main();
  process.exit(0);
} catch (error) {
  console.error(error instanceof BoardError ? `emulator: ${error.message}` : error);
  process.exit(1);
}
