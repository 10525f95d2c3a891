// Real pointers press a simulated garment: what is felt is what the saved script plays, and how soon it is seen.

import { test } from "node:test";
import { execFile } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { setTimeout as sleep } from "node:timers/promises";
import assert from "node:assert/strict";
import { choose, onPanel, rest } from "./hand.fixture.mjs";
import { page, show } from "./page.fixture.mjs";

const PROGRAM = process.env.TAXEL_PROGRAM ?? "taxel";
const PRESSES = process.env.TAXEL_CAMPAIGN ? 1000 : 60;
/** Presses whose delay is measured. */
const MEASURED = process.env.TAXEL_CAMPAIGN ? 200 : 25;
/** Time after which the recording of the last half minute is fetched, ms. */
const FETCH = 15_000;
const TOOLS = ["fingertip", "pen", "palm", "forearm", "ball", "strap"];

const both = page("sim:idle", { width: 1440, height: 900 });

/** Random numbers 0 to 1, the same in each run (mulberry32). */
function numbers(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let mixed = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** The contacts of each frame that has some, by its number. */
async function frames(source) {
  const { stdout } = await promisify(execFile)(PROGRAM, ["live", "--json", "--source", source], { maxBuffer: 2 ** 30 });
  const lines = stdout.split("\n").filter((line) => line.includes('"contacts":[{'));
  return new Map(lines.map((line) => JSON.parse(line)).map(({ frame, contacts }) => [frame, JSON.stringify(contacts)]));
}

test(`${PRESSES} presses of one to five fingers are felt as their file plays them, bit for bit`, async (t) => {
  const { browser, view } = both;
  const folder = await mkdtemp(join(tmpdir(), "taxel-hand-"));
  t.after(() => rm(folder, { recursive: true }));
  const fetched = async (name) => {
    const path = join(folder, name);
    await writeFile(path, Buffer.from(await (await fetch(view.url + name)).arrayBuffer()));
    return path;
  };
  const live = new Map();
  const look = async () => {
    const recording = await fetched("recording.mcap");
    for (const [frame, contacts] of await frames(`replay:${recording}@max`)) live.set(frame, contacts);
  };
  await show(browser, "garment");
  const random = numbers(7);
  const below = (most) => Math.floor(most * random());
  let looked = performance.now();
  for (let pressed = 0; pressed < PRESSES; ) {
    await choose(browser, TOOLS[below(TOOLS.length)]);
    const fingers = Math.min(1 + below(5), PRESSES - pressed);
    const places = await Promise.all(
      Array.from({ length: fingers }, () => onPanel(browser, below(4), [16 * random() - 0.5, 32 * random() - 0.5])),
    );
    if (fingers === 1) {
      const [[x, y]] = places;
      await browser.pointer(x, y, "mousePressed");
      for (let step = below(6); step > 0; step -= 1) await browser.pointer(x + 9 * random(), y + 9 * random());
      await sleep(120 * random());
      await browser.pointer(x, y, "mouseReleased");
    } else {
      await browser.fingers("touchStart", places);
      for (let step = below(6); step > 0; step -= 1)
        await browser.fingers("touchMove", places.map(([x, y]) => [x + 9 * random(), y + 9 * random()]));
      await sleep(120 * random());
      await browser.fingers("touchEnd", []);
    }
    pressed += fingers;
    if (performance.now() - looked > FETCH) {
      await look();
      looked = performance.now();
    }
  }
  await rest(browser);
  // The recording ends with a whole image.
  await sleep(1200);
  await look();
  const touches = await browser.value("taxel.store.states.hand.touches");
  const played = await frames(`sim:${await fetched("touches.toml")}`);
  for (const [frame, contacts] of live) assert.equal(contacts, played.get(frame), `frame ${frame}`);
  const missing = [...played.keys()].filter((frame) => !live.has(frame));
  assert.deepEqual(missing, [], "frames in which nothing was felt");
  assert.ok(touches >= 0.9 * PRESSES, `${touches} touches`);
  t.diagnostic(`view: ${PRESSES} presses, ${touches} touches, ${live.size} frames with contacts: all as the file plays them`);
});

test("how soon a press is reported, and seen", async (t) => {
  const { browser } = both;
  await choose(browser, "fingertip");
  await browser.value('taxel.ask({ script: "five" })');
  await browser.until("taxel.store.latest.head.frame.contacts.length === 5");
  // From the event of the pointer to the first image that has pressure there, and to the frame of the screen that draws it.
  await browser.value(`(() => {
    const { store } = taxel;
    window.delays = [];
    let press = null;
    addEventListener("pointerdown", ({ timeStamp }) => {
      const { panel, at } = taxel.views.panels.aim([window.aimed[0], window.aimed[1]]);
      press = { began: timeStamp, taxel: panel.base + Math.round(at[1]) * panel.columns + Math.round(at[0]) };
    }, true);
    const image = store.image.bind(store);
    store.image = (message) => {
      image(message);
      if (!press || message.image[press.taxel] < store.garment.low) return;
      const { began } = press;
      const reported = performance.now() - began;
      press = null;
      requestAnimationFrame(() => delays.push([reported, performance.now() - began, message.frame.contacts.length]));
    };
  })()`);
  const random = numbers(3);
  for (let press = 0; press < MEASURED; press += 1) {
    if (press % 10 === 0) await browser.value('taxel.ask({ script: "five" })');
    const [x, y] = await onPanel(browser, 1, [15 * random(), 2 + 4 * random()]);
    await browser.value(`window.aimed = [${x}, ${y}]`);
    await browser.pointer(x, y, "mousePressed");
    await browser.until(`delays.length === ${press + 1}`);
    await browser.pointer(x, y, "mouseReleased");
    await sleep(140 + 20 * random());
  }
  const delays = await browser.value("delays");
  const at = (share, of) => delays.map((delay) => delay[of]).sort((a, b) => a - b)[Math.ceil(share * MEASURED) - 1].toFixed(0);
  const most = Math.max(...delays.map(([, , contacts]) => contacts));
  const [load] = loadavg();
  t.diagnostic(
    `view: from pointer to message ${at(0.5, 0)} ms (median), ${at(0.99, 0)} ms (p99), to picture ${at(0.5, 1)} and ${at(0.99, 1)} ms; ` +
      `${MEASURED} presses, up to ${most} contacts, load ${load.toFixed(1)}`,
  );
  assert.equal(delays.length, MEASURED);
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
