// Modules of the page that need no browser: the line of time, the afterglow, the scale that follows, what is felt, the map's
// places, the log, and who is there.

import { test } from "node:test";
import assert from "node:assert/strict";
import { load } from "./module.fixture.mjs";

const [timeline, glow, follow, presence, speaker, sentences, map, limits] = await Promise.all(
  ["timeline", "afterglow", "follow", "presence", "speaker", "sentence", "layers", "limits"].map(load),
);
// It reads its address.
globalThis.location = { search: "" };
const { Store } = await load("store");

test("limits stay in their order, and say what they let through", () => {
  const { changed, passed } = limits;
  const now = { floor: 24, low: 32, high: 96, min_area: 2, filter: "persistent" };
  assert.deepEqual(changed(now, "low", 40), { ...now, low: 40 });
  assert.deepEqual(changed(now, "low", 100), { ...now, low: 100, high: 100 });
  assert.deepEqual(changed(now, "high", 20), { ...now, low: 20, high: 20 });
  assert.deepEqual(changed(now, "min_area", 9), { ...now, min_area: 9 });
  assert.equal(passed([0, 31, 32, 96, 200], now), "The greatest pressure now is 200 counts: 3 taxels reach 32, 2 of them 96.");
  assert.equal(passed([0, 0], now), "Nothing presses now.");
});

test("times are read as on a clock", () => {
  const { timeText } = timeline;
  assert.equal(timeText(7.254), "7.25");
  assert.equal(timeText(59.999, 2), "1:00.00");
  assert.equal(timeText(67.25, 1), "1:07.3");
  assert.equal(timeText(3727, 0), "1:02:07");
  assert.equal(timeText(-1), "0.00");
});

test("a line of a ruler has room, whatever the width", () => {
  for (const seconds of [0.5, 12, 1800, 86_400]) {
    for (const width of [200, 1200]) {
      const step = timeline.rulerStep(seconds, width);
      assert.ok((step / seconds) * width >= 79, `${step} s of ${seconds} s in ${width}`);
    }
  }
});

test("the strip about a moment stays within the recording", () => {
  assert.deepEqual(timeline.windowAbout(900, 1800), [885, 915]);
  assert.deepEqual(timeline.windowAbout(3, 1800), [0, 30]);
  assert.deepEqual(timeline.windowAbout(1799, 1800), [1770, 1800]);
  assert.deepEqual(timeline.windowAbout(0.5, 1), [0, 1]);
});

test("the shortest touch is seen on a line of any width", () => {
  const totals = new Array(16_384).fill(0);
  totals[9_000] = 4_000;
  const overview = { totals, width_us: 109_864 };
  for (const width of [300, 865, 1_700]) {
    const columns = timeline.columns(overview, [0, 1_800], width);
    assert.equal(columns.length, width);
    assert.ok(columns.some((total) => total === 4_000), `${width} pixels`);
  }
  const near = timeline.columns(overview, [980, 990], 500);
  const wide = near.filter((total) => total === 4_000).length;
  assert.ok(Math.abs(wide - 5.5) <= 1.5, `${wide} pixels of 0.11 s`);
});

const SAID = [
  [100_000, "onset", "a"],
  [161_000, "release", "b"],
  [161_000, "intention", "c"],
  [900_000, "note", "d"],
  [2_000_000, "reaction", "e"],
];

test("the log is that of the moment, the newest first", () => {
  assert.deepEqual(timeline.logAt(SAID, 99_999), []);
  assert.deepEqual(timeline.logAt(SAID, 161_000).map((line) => line[2]), ["c", "b", "a"]);
  assert.deepEqual(timeline.logAt(SAID, 9e9, 2).map((line) => line[2]), ["e", "d"]);
});

test("marks are found beside the pointer, and from one to the next", () => {
  assert.equal(timeline.nearest(SAID, 120_000, 30_000)[2], "a");
  assert.equal(timeline.nearest(SAID, 500_000, 30_000), null);
  assert.equal(timeline.nearest(SAID, 170_000, 30_000)[2], "c");
  assert.equal(timeline.neighbour(SAID, 100_000, 1)[2], "c");
  assert.equal(timeline.neighbour(SAID, 161_000, 1)[2], "e");
  assert.equal(timeline.neighbour(SAID, 2_000_000, -1)[2], "c");
  assert.equal(timeline.neighbour(SAID, 2_000_000, 1), null);
});

test("every event of the half minute has its mark, however many there are", () => {
  const store = new Store();
  const marked = (from, to, us) => {
    for (let n = from; n < to; n += 1) store.line({ type: "say", time_us: n * us, kind: "onset", said: String(n) });
    return store.marks.length;
  };
  assert.equal(marked(0, 2_500, 10_000), 2_500);
  assert.equal(marked(2_500, 6_000, 10_000), 3_001);
  assert.equal(marked(60, 600, 1_000_000), 512, "few a second");
  store.connected();
  assert.equal(marked(0, 9_000, 1_000), 4_096, "more than anybody reads");
});

test("intentions last until another leads", () => {
  const changes = [
    [5, "kindness"],
    [9, "none"],
    [20, "attack"],
  ];
  assert.deepEqual(timeline.stretches(changes, 30), [
    [5, 9, "kindness"],
    [20, 30, "attack"],
  ]);
  assert.deepEqual([4, 5, 9, 25].map((at) => timeline.leadingAt(changes, at)), ["none", "kindness", "none", "attack"]);
});

test("ends of a range never meet nor leave the recording", () => {
  assert.deepEqual(timeline.moved([1, 5], 0, 9, 10), [4.95, 5]);
  assert.deepEqual(timeline.moved([1, 5], 1, 0, 10), [1, 1.05]);
  assert.deepEqual(timeline.moved([1, 5], 1, 99, 10), [1, 10]);
  assert.deepEqual(timeline.moved([1, 5], 0, -3, 10), [0, 5]);
});

test("speeds go up and down one at a time, and end", () => {
  assert.equal(timeline.nextSpeed(1, 1), 2);
  assert.equal(timeline.nextSpeed(3, -1), 2);
  assert.equal(timeline.nextSpeed(16, 1), 16);
  assert.equal(timeline.nextSpeed(0.05, -1), 0.05);
  assert.equal(timeline.speedText(0.25), "0.25×");
});

test("a touch of 61 ms glows for most of a second, and no longer", () => {
  const into = new Float32Array(2);
  const lash = Uint16Array.of(0, 400);
  const rest = Uint16Array.of(0, 0);
  const seen = (ms) => glow.afterglow([[rest, 0], [lash, ms / 1000]], into)[1];
  assert.equal(seen(0), 400);
  assert.ok(seen(61) > 360 && seen(400) > 150 && seen(700) > 20);
  assert.equal(seen(1000), 0);
  assert.equal(glow.opacity(seen(700), 0, 200) > 0.3, true);
  // Nothing glows above a pressure that is still there.
  assert.equal(glow.opacity(400, 400, 200), 0);
  assert.equal(into[0], 0);
});

test("the scale fits the first touch, whether light or hard, and afterwards only grows", () => {
  const ENDS = [25, 51_200];
  for (const [first, end] of [
    [90, 100],
    [1_500, 1_600],
  ]) {
    const scale = new follow.Follow();
    assert.equal(scale.next(200, 9, 10, ENDS), 200, "at rest");
    assert.equal(scale.next(200, first, 10, ENDS), end);
    for (const less of [first / 2, 12, 0]) assert.equal(scale.next(end, less, 10, ENDS), end);
    assert.equal(scale.next(end, 2_000, 10, ENDS), 3_200);
  }
  assert.equal(follow.endFor(1e9, ENDS), 51_200);
});

test("what is felt is said of now, of what has just ended, and of the moment at which the page pauses", () => {
  const image = (number, ms, what, meaning, leading = "none") => {
    const contacts = what === "nothing touches" ? [] : [{}];
    const felt = { what, peak: what.replace("2 N", "8 N"), meaning };
    return { number, head: { frame: { time_us: ms * 1000, contacts, felt, intent: { leading } } } };
  };
  const images = [
    image(0, 0, "nothing touches", ""),
    image(1, 100, "a touch on the back, 2 N", "kindness", "kindness"),
    image(2, 200, "nothing touches", "kindness", "kindness"),
    image(3, 300, "nothing touches", ""),
    image(4, 1_000, "nothing touches", ""),
  ];
  const store = { paused: false, states: {}, at: (number) => images[number], span: () => [0, images.length] };
  const spoken = (number) => sentences.sentence({ ...store, shown: () => images[number] });
  assert.deepEqual(spoken(0), { when: "now", what: "nothing touches", meaning: "" });
  assert.deepEqual(spoken(1), { when: "now", what: "a touch on the back, 2 N", meaning: "kindness" });
  assert.deepEqual(spoken(2), { when: "just now", what: "a touch on the back, 8 N", meaning: "kindness" });
  assert.deepEqual(spoken(3), { when: "just now", what: "a touch on the back, 8 N", meaning: "kindness" });
  assert.deepEqual(spoken(4), { when: "now", what: "nothing touches", meaning: "" });
  const paused = sentences.sentence({ ...store, paused: true, shown: () => images[1] });
  assert.equal(paused.when, "at 0.10 s");
  assert.equal(sentences.sentence({ ...store, shown: () => null }), null);
  const lost = { ...store, states: { lost: {} }, shown: () => images[2] };
  assert.equal(sentences.sentence(lost), null, "nothing is known of a lost board");
});

test("the map fills its card, on a telephone, too, and nothing of it lies on anything else", () => {
  // As the shipped map has them: fourteen inputs, and six layers of what they cause.
  const layers = [...new Array(14).fill(0), 1, 2, 3, 4, 4, 5];
  for (const [width, height, least] of [
    [1026, 530, 13],
    [866, 350, 11],
    [350, 540, 10],
  ]) {
    const { isDown, places, extent } = map.arrange(layers, [width, height]);
    assert.equal(isDown, width < height);
    const scale = Math.min(...[width, height].map((room, axis) => room / (extent[axis] + 2 * map.MARGIN)));
    assert.ok(13 * scale >= least, `${width} x ${height}: numbers of ${(13 * scale).toFixed(1)} pixels`);
    const shares = extent.map((part, axis) => (part * scale) / [width, height][axis]);
    assert.ok(Math.max(...shares) > 0.9 && Math.min(...shares) > 0.6, `${width} x ${height}: ${shares}`);
    places.forEach(([x, y], one) =>
      places.slice(0, one).forEach(([u, v], other) => {
        const apart = Math.abs(x - u) >= map.WIDTH || Math.abs(y - v) >= map.HEIGHT;
        assert.ok(apart, `${one} lies on ${other}`);
      }),
    );
  }
});

test("who is not there is said to be away, and since when", () => {
  const { absence, agoText } = presence;
  const here = { connected: true, heard: 1_000, lost: null };
  assert.equal(absence(here, 2_000), null);
  assert.equal(absence(here, 5_000).since, 1_000);
  assert.equal(absence({ ...here, quiet: true }, 50_000), null);
  const gone = absence({ connected: false, heard: 1_000, lost: 1_200 }, 9_000);
  assert.deepEqual([gone.text, gone.since, gone.again], ["Disconnected", 1_200, true]);
  assert.equal(absence({ connected: false, heard: null, lost: null }, 9_000).since, null);
  const board = { since: 700, text: "usb is gone: broken pipe; waiting for it" };
  assert.deepEqual(absence({ ...here, board }, 2_000), { ...board, again: true });
  assert.equal(absence({ ...here, board }, 5_000).text, "No messages from the program");
  assert.deepEqual([5_900, 130_000, 8_000_000].map(agoText), ["5 s", "2 min", "2 h"]);
});

test("what is spoken is the newest, and waits for the one before", () => {
  const voice = new speaker.Speaker();
  assert.equal(voice.next("a", 0), "a");
  assert.equal(voice.next("b", 500), "a");
  assert.equal(voice.next("c", 1_600), "c");
  assert.equal(voice.next("c", 9_000), "c");
});
