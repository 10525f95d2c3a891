// Modules of the page that need no browser: the force of a touch by hand, what the program hears of it, where it meets
// the garment, and the outlines of the tools.

import { test } from "node:test";
import assert from "node:assert/strict";
import { load } from "./module.fixture.mjs";

const [law, fingers, aims, outlines, garments] = await Promise.all(
  ["force-law", "finger", "aim", "outline", "garment"].map(load),
);

const PALM = { name: "palm", size_mm: [100, 85], force_n: 8, most_n: 60 };
const STRAP = { name: "strap", size_mm: [250, 20], force_n: 3, most_n: 30 };
const PANEL = { name: "back", region: "back", link: "torso", rows: 32, columns: 16, pitch_um: [12_000, 10_000] };
const dressed = garments.garmentOf({ panels: [PANEL, { ...PANEL, name: "chest" }], absent: [] });
const [back, chest] = dressed.panels;
/** One frame of the screen, ms. */
const FRAME = 16;

const near = (got, want, within = 1e-6) =>
  got.forEach((part, axis) => assert.ok(Math.abs(part - want[axis]) <= within, `${got} instead of ${want}`));
const force = (tool, factor, press) => law.forceOf(tool, factor, { age: 1e4, rested: 0, speed: 0, pressure: null, ...press });

test("a press reaches its force in 60 ms, keeps it, and grows in two seconds if it rests", () => {
  assert.equal(force(PALM, 1, { age: 0 }), 0);
  assert.equal(force(PALM, 1, { age: 30 }), 4);
  assert.equal(force(PALM, 1, { age: 60 }), 8);
  assert.equal(force(PALM, 1, { age: 460, rested: 460 }), 8);
  assert.equal(force(PALM, 1, { rested: 1460 }), 34);
  assert.equal(force(PALM, 1, { rested: 2460 }), 60);
  assert.equal(force(PALM, 1, { rested: 9e9 }), 60);
});

test("the wheel changes the force between a tenth and ten times, and nothing presses with more than 200 N", () => {
  assert.ok(Math.abs(law.turnedBy(1, 1) - 1.15) < 1e-9 && Math.abs(law.turnedBy(1.15, -1) - 1) < 1e-9);
  assert.deepEqual([law.turnedBy(1, 99), law.turnedBy(1, -99)], [10, 0.1]);
  assert.equal(force(PALM, 0.5, {}), 4);
  // A long press of less force ends with less, one of more never with less than a short one.
  assert.equal(force(PALM, 0.5, { rested: 1e5 }), 30);
  assert.equal(force(PALM, 10, { rested: 1e5 }), 80);
  assert.equal(force({ ...PALM, force_n: 90 }, 10, {}), 200);
});

test("a pen presses as hard as it is pressed", () => {
  assert.equal(force(PALM, 1, { pressure: 0 }), 0);
  assert.equal(force(PALM, 1, { pressure: 0.5, age: 0 }), 8);
  assert.equal(force(PALM, 2, { pressure: 1, rested: 1e5 }), 32);
  assert.equal(force({ ...PALM, force_n: 90 }, 10, { pressure: 1 }), 200);
});

test("a strap that flies lashes with up to 60 N, and no other tool does", () => {
  assert.equal(force(STRAP, 1, { speed: 600 }), 3);
  assert.equal(force(STRAP, 1, { speed: 1300, age: 0 }), 31.5);
  assert.equal(force(STRAP, 1, { speed: 2000, age: 0 }), 60);
  assert.equal(force(STRAP, 1, { speed: 9000 }), 60);
  assert.equal(force(PALM, 1, { speed: 9000 }), 8);
});

const press = (tool = PALM, panel = back, at = [7.5, 11]) =>
  new fingers.Finger({ number: 3, tool, spot: { panel, at }, factor: 1, angle: 0, now: 0 });

test("the first message of a press has its place and already some force", () => {
  const finger = press(PALM, chest, [7.504, 11.006]);
  assert.deepEqual(finger.next(0), {
    press: { finger: 3, tool: "palm", panel: 1, at: [7.5, 11.01], force_n: 2.13, angle_deg: 0 },
  });
});

test("a finger that rests says something only while its force changes", () => {
  const finger = press();
  const sent = (until) => {
    let count = 0;
    for (; now < until; now += FRAME) count += finger.next(now) ? 1 : 0;
    return count;
  };
  let now = 0;
  assert.ok(sent(60) <= 4);
  assert.ok(sent(440) <= 1, "it keeps its force");
  assert.ok(sent(2400) > 100, "it grows");
  sent(2600);
  assert.equal(sent(5000), 0, "it has its greatest force");
  finger.move([7.5, 11], now);
  assert.equal(finger.next(now), null, "it has not moved");
  finger.move([8.5, 11], now);
  assert.deepEqual(finger.next(now).press.at, [8.5, 11]);
});

test("a stroke keeps the force of a short press, and grows once it rests", () => {
  const finger = press();
  let [row, now] = [2, 0];
  for (; now < 3000; now += FRAME) {
    row += 17 * (FRAME / 1000);
    finger.move([7.5, row], now);
    finger.next(now);
    if (now > 60) assert.ok(Math.abs(finger.force - 8) < 1e-9, `${finger.force} N after ${now} ms`);
  }
  assert.ok(Math.abs(finger.speed(now - FRAME) - 170) < 1, `${finger.speed(now - FRAME)} mm/s`);
  for (const end = now + 3000; now < end; now += FRAME) finger.next(now);
  assert.equal(finger.force, 60);
});

test("a flick of the strap has 40 N within 50 ms and ends soon, a tap is as long as a pat", () => {
  const flick = press(STRAP);
  flick.next(0);
  let greatest = 0;
  for (let now = FRAME; now <= 48; now += FRAME) {
    flick.move([7.5, 11 + 0.18 * now], now);
    flick.next(now);
    greatest = Math.max(greatest, flick.force);
  }
  assert.ok(greatest >= 40, `${greatest} N`);
  flick.lift(49);
  assert.deepEqual([50, 60].map((now) => flick.isOver(now)), [false, true]);
  const tap = press();
  assert.equal(tap.isOver(1e4), false);
  tap.lift(30);
  tap.lift(70);
  for (let now = 30; now < 120; now += FRAME) {
    tap.next(now);
    assert.equal(tap.isOver(now), false);
  }
  assert.equal(tap.isOver(120), true);
  assert.equal(tap.force, 8);
});

test("a first small step of the pointer is no lash", () => {
  const finger = press(STRAP);
  finger.next(0);
  finger.move([7.7, 11], 1);
  finger.next(1);
  assert.equal(finger.lashed, false);
});

test("a page that stood still has seen no lash", () => {
  const finger = press(STRAP);
  let [row, now] = [11, 0];
  for (const frame of [...Array(8).fill(FRAME), 150, ...Array(8).fill(FRAME)]) {
    now += frame;
    row += 17 * (frame / 1000);
    finger.move([7.5, row], now);
    finger.next(now);
    assert.ok(finger.speed(now) < 190, `${finger.speed(now)} mm/s after ${now} ms`);
  }
  assert.equal(finger.lashed, false);
});

test("a page of few frames sees a stroke as a stroke", () => {
  const finger = press();
  finger.next(0);
  // Each step is 10 ms behind its frame, or 10 ms before the next.
  for (let [row, now] = [11, 0]; now < 3000; now += 100) {
    row += 1.7;
    finger.move([7.5, row], now + (now % 200 ? 10 : 90));
    finger.next(now + 100);
    assert.equal(finger.force, 8, `${finger.force} N after ${now} ms`);
  }
});

test("a flick that lifts before the next frame has lashed", () => {
  const flick = press(STRAP);
  flick.next(0);
  for (let now = 10; now <= 50; now += 10) flick.move([7.5, 11 + 0.28 * now], now);
  flick.lift(52);
  assert.equal(flick.isOver(130), false);
  assert.deepEqual(flick.next(130).press.at, [7.5, 25]);
  assert.ok(flick.lashed && flick.force > 20, `${flick.force} N`);
  assert.equal(flick.isOver(150), true);
});

const canvas = (left, top, width, height) => ({ getBoundingClientRect: () => ({ left, top, width, height }) });

test("a point of the page is a place on a panel, and the way back leads there", () => {
  const parts = [
    { panel: back, canvas: canvas(100, 50, 160, 320) },
    { panel: chest, canvas: canvas(270, 50, 160, 320) },
  ];
  // The centre of the first taxel is at half of its size.
  assert.deepEqual(aims.onPanels(parts, [105, 55]), { panel: back, at: [0, 0] });
  assert.deepEqual(aims.onPanels(parts, [270, 50]), { panel: chest, at: [-0.5, -0.5] });
  near(aims.onPanels(parts, [429.9, 369.9]).at, [15.5, 31.5], 0.02);
  assert.equal(aims.onPanels(parts, [265, 60]), null, "between the panels");
  assert.equal(aims.onPanels([{ panel: back, canvas: canvas(0, 0, 0, 0) }], [0, 0]), null, "hidden");
  for (const [panel, at] of [[back, [0.2, 0.3]], [chest, [14.9, 30.7]]]) {
    const point = aims.plotPanel(parts, panel)(at);
    const spot = aims.onPanels(parts, point);
    assert.equal(spot.panel, panel);
    near(spot.at, at);
  }
});

test("a point of a face has the shares that lead to it", () => {
  const face = [[0, 0], [10, 2], [12, 9], [-1, 7]];
  near(aims.inFace(face, [0, 0]), [0, 0]);
  near(aims.inFace(face, [12, 9]), [1, 1]);
  near(aims.inFace([[5, 5], [9, 5], [9, 8], [5, 8]], [6, 7.5]), [0.25, 2.5 / 3]);
  // A face that is seen from its edge has no area.
  assert.ok(aims.inFace([[0, 0], [1, 0], [1, 0], [0, 0]], [0.5, 0]).every(Number.isFinite));
});

test("cloth is met between its taxels, and other boards' cloth is not", () => {
  // The back, turned and leaning: two taxels are 12 pixels apart along a row, 10 and 3 along a column.
  const seen = Float32Array.from(
    { length: 3 * dressed.taxels },
    (_, at) => [12, 3, 0][at % 3] * (Math.floor(at / 3) % 16) + [-3, 10, 1][at % 3] * (Math.floor(at / 48) % 32),
  );
  const faces = Uint32Array.from([5 * 16 + 4, 5 * 16 + 5, 6 * 16 + 5, 6 * 16 + 4]);
  const stage = canvas(100, 200, 400, 400);
  const plot = aims.plotCloth(back, stage, (taxel) => [seen[3 * taxel], seen[3 * taxel + 1]]);
  const point = plot([4.25, 5.75]);
  near(point, [100 + 12 * 4.25 - 3 * 5.75, 200 + 3 * 4.25 + 10 * 5.75]);
  const { panel, at } = aims.onCloth(dressed, stage, { seen, faces }, point);
  assert.equal(panel, back);
  near(at, [4.25, 5.75], 1e-4);
  assert.equal(aims.onCloth(dressed, stage, { seen, faces }, [100, 200]), null, "beside the face");
  const others = Uint32Array.from({ length: dressed.taxels }, () => dressed.taxels + 7);
  assert.equal(aims.onCloth(dressed, stage, { seen, faces, taxels: others }, point), null);
  // A taxel without neighbours is a face of its own.
  const alone = Uint32Array.from({ length: dressed.taxels }, () => 5 * 16 + 4);
  assert.deepEqual(aims.onCloth(dressed, stage, { seen, faces, taxels: alone }, point), { panel: back, at: [4, 5] });
  // Beyond the outermost taxels it goes straight on.
  near(plot([-0.5, 31.5]), [100 - 6 - 94.5, 200 - 1.5 + 315]);
});

test("an outline has the size of its tool, and its direction", () => {
  const extent = (points) => [0, 1].map((axis) => Math.max(...points.map((at) => at[axis])) - Math.min(...points.map((at) => at[axis])));
  near(extent(outlines.outline({ name: "fingertip", size_mm: [16, 16] })), [16, 16], 0.01);
  near(extent(outlines.outline(STRAP)), [250, 20], 0.01);
  near(extent(outlines.outline(STRAP, 90)), [20, 250], 0.01);
  // A palm has round corners, a strap has not.
  const corner = ({ size_mm: [length, width], ...tool }) =>
    Math.max(...outlines.outline({ ...tool, size_mm: [length, width] }).map(([x, y]) => Math.min(x / (length / 2), y / (width / 2))));
  assert.ok(corner(PALM) < 0.87 && corner(STRAP) > 0.98, `${corner(PALM)}, ${corner(STRAP)}`);
  assert.ok(corner({ name: "ball", size_mm: [80, 80] }) < 0.71);
});
