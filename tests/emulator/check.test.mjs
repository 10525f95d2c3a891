import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Check } from './check.mjs';
import { Garment } from './garment.mjs';

const ADDRESS = 0x20000010;
const wiring = { lines: [{ pin: 2, inverted: false }], inputs: [26, 27], taxels: [[0, 2], [1, 3]], count: 4 };
const frames = [0, 1, 2, 3].map((frame) => Uint16Array.from({ length: 4 }, (_, taxel) => 100 * frame + taxel));

/** A garment that is scanned by `scan`, and a memory into which `lend` puts codes and lends them. */
function check(channels = [0, 1]) {
  const level = { high: false };
  const garment = new Garment({ wiring, frames, readPin: () => level.high });
  const sramView = new DataView(new ArrayBuffer(64));
  const it = new Check(garment, { chip: { sramView }, micros: 7 });
  const at = (high) => channels.forEach((channel) => { level.high = high; garment.sample(channel); });
  const scan = () => { at(false); at(true); };
  const lend = (codes) => {
    codes.forEach((code, taxel) => sramView.setUint16(16 + 2 * taxel, code, true));
    it.lent(ADDRESS);
    return it.counts;
  };
  return { scan, at, lend, it };
}

test('a whole frame of the scan that has just ended is right', () => {
  const { scan, at, lend } = check();
  scan();
  at(false);
  assert.deepEqual(lend([0, 1, 2, 3]), { frames: 1, taxels: 4, wrong: 0, unseen: 0, first_us: 7, last_us: 7 });
});

test('a frame may be of the last scan, as long as no other is under way', () => {
  const { scan, at, lend, it } = check();
  scan();
  assert.equal(lend([0, 1, 2, 3]).wrong, 0);
  at(false);
  assert.equal(lend([100, 1, 102, 3]).wrong, 0, 'nothing is complete');
  assert.equal(it.counts.frames, 1);
  at(true);
  assert.equal(lend([100, 1, 102, 103]).wrong, 1);
});

test('taxels of another frame are wrong, whatever frame the rest is of', () => {
  const { scan, at, lend } = check();
  scan();
  scan();
  at(false);
  assert.equal(lend([100, 1, 102, 103]).wrong, 1);
});

test('scans that nobody saw are counted', () => {
  const { scan, at, lend } = check();
  scan();
  at(false);
  lend([0, 1, 2, 3]);
  at(true);
  scan();
  scan();
  at(false);
  const { frames: seen, wrong, unseen } = lend([300, 301, 302, 303]);
  assert.deepEqual({ seen, wrong, unseen }, { seen: 2, wrong: 0, unseen: 2 });
});

test('what a scan leaves out is not compared', () => {
  const { scan, at, lend } = check([1]);
  scan();
  at(false);
  const { taxels, wrong } = lend([9, 9, 2, 3]);
  assert.deepEqual({ taxels, wrong }, { taxels: 2, wrong: 0 });
});
