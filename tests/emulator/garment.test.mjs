import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Garment } from './garment.mjs';

// Two lines (the second inverted), two inputs, eight taxels; taxel 7 is not wired.
const wiring = {
  lines: [{ pin: 2, inverted: false }, { pin: 3, inverted: true }],
  inputs: [26, 28], taxels: [[0, 4], [1, 5], [2, 6], [3, null]], count: 8,
};
const frames = [0, 1, 2].map((frame) => Uint16Array.from({ length: 8 }, (_, taxel) => 100 * (frame + 1) + taxel));

/** A garment, and a function that sets the lines to an address and samples a channel. */
function garment(options = {}) {
  const pins = new Map();
  const time = { now: 0 };
  const it = new Garment({ wiring, frames, idle: 7, readPin: (pin) => pins.get(pin), now: () => time.now, ...options });
  const sample = (address, channel) => {
    pins.set(2, (address & 1) !== 0).set(3, (address & 2) === 0);
    return it.sample(channel);
  };
  const scan = () => [0, 1, 2, 3].map((address) => [sample(address, 0), sample(address, 2)]).flat();
  return { it, pins, time, sample, scan };
}

test('levels select a taxel, inverted lines included', () => {
  const { scan } = garment();
  assert.deepEqual(scan(), [100, 104, 101, 105, 102, 106, 103, 7]);
});

test('a channel without a taxel gives the idle code', () => {
  assert.equal(garment().sample(0, 1), 7);
});

test('the thermometer is at 27 degrees', () => {
  assert.equal(garment().sample(0, 4), 876);
});

test('a line that nothing drives is counted', () => {
  const { it } = garment();
  it.sample(0);
  assert.equal(it.floating, 2);
});

test('the next scan shows the next frame, and the last one stays', () => {
  const { scan } = garment();
  assert.deepEqual([1, 2, 3, 4].map(() => scan()[0]), [100, 200, 300, 300]);
});

test('frames repeat when asked to', () => {
  const { scan, it } = garment({ loop: true });
  assert.deepEqual([1, 2, 3, 4].map(() => scan()[0]), [100, 200, 300, 100]);
  assert.equal(it.played, 4);
});

test('a frame is shown by as many scans as asked for', () => {
  const { scan } = garment({ dwell: 2 });
  assert.deepEqual([1, 2, 3, 4, 5].map(() => scan()[0]), [100, 100, 200, 200, 300]);
});

test('averaging at one address stays in the scan', () => {
  const { sample } = garment();
  assert.deepEqual([sample(0, 0), sample(0, 0), sample(1, 0), sample(1, 0)], [100, 100, 101, 101]);
  assert.equal(sample(0, 0), 200);
});

test('after a pause a scan of other addresses is a new one', () => {
  const { sample, time } = garment();
  assert.equal(sample(0, 0), 100);
  time.now = 2e6;
  assert.equal(sample(1, 0), 201);
});

test('held frames begin with the scan after the command', () => {
  const started = [];
  const { it, sample, scan } = garment({ playing: false, onPlay: (at) => started.push(at) });
  assert.equal(scan()[0], 7);
  assert.equal(sample(0, 0), 7);
  it.play();
  assert.equal(sample(1, 0), 7);
  assert.equal(it.played, 0);
  assert.equal(scan()[0], 100);
  assert.deepEqual(started, [2]);
  assert.equal(it.played, 1);
});
