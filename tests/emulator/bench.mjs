#!/usr/bin/env node
// Drives the image that measures: operations from a file, one line of JSON for each on standard output.
// `bench.mjs IMAGE OPERATIONS`. An operation is a command and a length (u32, little endian), then so many bytes.

import { readFileSync } from 'node:fs';
import { allowed } from './allow.mjs';
import { loadImage } from './elf.mjs';
import { Marks } from './marks.mjs';
import { BoardError, Machine } from './machine.mjs';

const RAM_START = 0x20000000;
// The mailbox, as firmware/src/bin/bench.rs lays it out.
const COMMAND = 0, LENGTH = 4, BYTES = 8, DIGEST = 12, CONTENT = 16;
const PATIENCE_CYCLES = 125e6;
const READY = 0, STARTING = 0xffffffff;

/** Runs until the image waits for a command. */
function wait(machine, mailbox) {
  const limit = machine.cycles + PATIENCE_CYCLES;
  while (machine.chip.sramView.getUint32(mailbox + COMMAND, true) !== READY) {
    machine.runUntil(machine.clock.nanosCounter + 1000);
    if (machine.cycles > limit) throw new BoardError(`no answer for a second of the board's time, at ${machine.where()}`);
  }
}

function perform(machine, mailbox, command, content) {
  const { chip: { sram, sramView } } = machine;
  sram.set(content, mailbox + CONTENT);
  sramView.setUint32(mailbox + LENGTH, content.length, true);
  sramView.setUint32(mailbox + COMMAND, command, true);
  machine.marks.clear();
  // What the image holds all the time is no part of what a command takes.
  machine.stack.top = machine.core.SP;
  machine.stack.paint(machine.stack.top);
  wait(machine, mailbox);
  return {
    bytes: sramView.getUint32(mailbox + BYTES, true), digest: sramView.getUint32(mailbox + DIGEST, true),
    marks: machine.marks, stack: machine.stack,
  };
}

function main([image, operations]) {
  const loaded = loadImage(image);
  const machine = new Machine(loaded, { allowed });
  const mailbox = loaded.symbols.get('TAXEL_MAILBOX').address - RAM_START;
  machine.chip.sramView.setUint32(mailbox + COMMAND, STARTING, true);
  wait(machine, mailbox);
  const file = readFileSync(operations);
  for (let at = 0; at < file.length;) {
    const [command, length] = [file.readUInt32LE(at), file.readUInt32LE(at + 4)];
    console.log(JSON.stringify(perform(machine, mailbox, command, file.subarray(at + 8, at + 8 + length))));
    at += 8 + length;
    if (machine.stack.overflown) throw new BoardError('the stack has reached the program\'s data');
  }
}

try {
  main(process.argv.slice(2));
} catch (error) {
  console.error(error instanceof BoardError ? `emulator: ${error.message}` : error);
  process.exit(1);
}
