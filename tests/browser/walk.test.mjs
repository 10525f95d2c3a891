// What a newcomer does first, at the sizes of a desk, a laptop and a telephone: opens the page, presses, asks why, plays
// a script, saves, and looks at the recording. Nothing is covered, and axe-core finds nothing, at each step.
// TAXEL_PICTURES=FOLDER keeps a picture of each.

import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { small, violations } from "./access.fixture.mjs";
import { Chromium } from "./chromium.mjs";
import { BACK, choose, felt, NEWTON, onPanel, rest } from "./hand.fixture.mjs";
import { covered } from "./layout.fixture.mjs";
import { drawn } from "./page.fixture.mjs";
import { View } from "./program.mjs";
import { OPTIONS } from "./robot.fixture.mjs";

const SIZES = [
  { name: "desk", width: 1440, height: 900 },
  { name: "laptop", width: 1280, height: 720 },
  { name: "telephone", width: 390, height: 844, mobile: true },
];
/** In the campaign, and for pictures, each size by day and by night. */
const WALKS = SIZES.flatMap((size, at) => {
  const isAll = process.env.TAXEL_CAMPAIGN || process.env.TAXEL_PICTURES;
  return (isAll ? [false, true] : [at === 1]).map((dark) => ({ ...size, dark }));
});
let browser;
let folder;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "taxel-walk-"));
  browser = await Chromium.start();
});
after(async () => {
  await browser?.stop();
  await rm(folder, { recursive: true });
});

/** A step is done: looks at the page. */
async function look({ name, dark, width, mobile }, step) {
  await browser.value("scrollTo(0, 0)");
  await drawn(browser);
  const pictures = process.env.TAXEL_PICTURES;
  if (pictures) await writeFile(join(pictures, `${name}-${dark ? "dark" : "light"}-${step}.png`), await browser.picture(mobile));
  assert.deepEqual(await covered(browser), [], step);
  assert.deepEqual(await violations(browser), [], step);
  if (mobile) assert.deepEqual(await small(browser), [], step);
  const wide = await browser.value("document.documentElement.scrollWidth");
  assert.ok(wide <= width, `${step}: ${wide} pixels`);
}

/** The steps up to a recording: its file. */
async function walk(size, view) {
  await browser.open(view.url, size);
  await browser.until("document.getElementById('view-body').checkVisibility() && !document.getElementById('invite').hidden");
  await look(size, "1-open");

  await choose(browser, "palm");
  await browser.value("document.getElementById('view').scrollIntoView({ block: 'center' })");
  const [x, y] = await onPanel(browser, BACK, [7.5, 11]);
  await browser.pointer(x, y);
  await browser.pointer(x, y, "mousePressed");
  await felt(browser, `touches[0]?.total > ${7 * NEWTON} && taxel.store.latest.head.frame.intent.leading !== "none"`);
  await browser.value("taxel.store.pause(true), taxel.changed()");
  await look(size, "2-press");
  await browser.pointer(x, y, "mouseReleased");

  await browser.value("document.getElementById('why').click()");
  await browser.until("!document.getElementById('reasons').hidden && document.querySelectorAll('#reasons-inputs tr').length > 1");
  await look(size, "3-why");
  await browser.value("document.getElementById('why-close').click(), taxel.store.pause(false), taxel.changed()");
  await rest(browser);

  await browser.value("document.getElementById('script').value = 'five'");
  await browser.value("document.getElementById('play-script').click()");
  await felt(browser, "touches.length === 5");
  await look(size, "4-script");
  await browser.until("taxel.store.states.hand.playing === null");

  // Beside a long time the menu's button has a line of its own.
  await browser.value("taxel.store.pause(true), taxel.store.step(-300), taxel.changed()");
  await browser.value("document.getElementById('save').click()");
  await look(size, "5-save");
  const file = join(folder, `${size.name}-${size.dark}.mcap`);
  await writeFile(file, Buffer.from(await (await fetch(`${view.url}recording.mcap`)).arrayBuffer()));
  return file;
}

/** Runs `act` on a page of a program of its own. */
async function on(options, act) {
  const view = await View.start(...options);
  try {
    return await act(view);
  } finally {
    // Not the program's end is what the page complains of.
    await browser.visit("about:blank");
    await view.stop();
  }
}

for (const size of WALKS) {
  test(`a newcomer finds the way: ${size.name}, ${size.dark ? "dark" : "light"}`, async () => {
    const file = await on(["--source", "sim:idle", ...OPTIONS], (view) => walk(size, view));
    await on(["--source", `replay:${file}`], async (view) => {
      await browser.open(view.url, size);
      await browser.until("taxel.store.states.overview && taxel.store.shown()?.head.frame.contacts.length");
      await look(size, "6-replay");
    });
  });
}

test("the page has complained of nothing", () => assert.deepEqual(browser.complaints, []));
