// Taxels on which the garment folds: stroked on the panels and on the robot, with what the strokes mean.

import { after, test } from "node:test";
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { violations } from "./access.fixture.mjs";
import { Chromium } from "./chromium.mjs";
import { drawn, page, screen, show } from "./page.fixture.mjs";
import { View } from "./program.mjs";
import { OPTIONS, ROBOT } from "./robot.fixture.mjs";

const PROGRAM = process.env.TAXEL_PROGRAM ?? "taxel";
const folder = await mkdtemp(join(tmpdir(), "taxel-folds-"));
after(() => rm(folder, { recursive: true, force: true }));
const [recording, table] = ["elbow.mcap", "elbow.folds"].map((name) => join(folder, name));
const run = promisify(execFile);
await run(PROGRAM, ["record", "--source", "sim:elbow", "--for", "2.6s", "-o", recording]);
await run(PROGRAM, ["body", "learn", recording, "-o", table]);
const both = page("sim:elbow", { options: [...OPTIONS, "--folds", table] });

/** First taxel of the left arm, and its columns. */
const [BASE, COLUMNS] = [1024, 16];
const FOLDING = "taxel.store.shown()?.head.folding";

/** Stands still while so many taxels fold, and shows them. */
async function pauseAtFold(browser) {
  await browser.value("taxel.store.pause(false)");
  await browser.until(`${FOLDING}?.taxels.length > 40 && (taxel.store.pause(true), true)`);
  await browser.value("taxel.changed()");
  await drawn(browser);
  return browser.value(`${FOLDING}.taxels`);
}

/** Strokes over the robot. */
const strokes = (browser) => browser.value(`(${ROBOT}.folds[0].getAttribute("d").match(/M/g) ?? []).length`);

test("taxels that fold are stroked on their panel, and nothing is a touch", async () => {
  const { browser } = both;
  await show(browser, "garment", "folds");
  const taxels = await pauseAtFold(browser);
  assert.ok(taxels.every((taxel) => taxel >= BASE && taxel < BASE + 512), taxels.join());
  assert.deepEqual(await browser.value("taxel.store.shown().head.frame.contacts"), []);
  await browser.until(`document.getElementById("folding").textContent === "╱ folds here: ${taxels.length} taxels"`);
  const middle = (taxel) =>
    browser.value(`(() => {
      const { left, top, width, height } = taxel.views.panels.parts[2].canvas.getBoundingClientRect();
      const at = ${taxel} - ${BASE};
      return [left + ((at % ${COLUMNS}) + 0.5) * width / ${COLUMNS}, top + (Math.floor(at / ${COLUMNS}) + 0.5) * height / 32];
    })()`);
  const other = Array.from({ length: 512 }, (_, at) => BASE + at).find((taxel) => !taxels.includes(taxel));
  const [fold, plain] = [await middle(taxels[0]), await middle(other)];
  const stroked = await screen(browser);
  const [on, beside] = [await stroked.at(...fold), await stroked.at(...plain)];
  await show(browser, "garment");
  const bare = await screen(browser);
  assert.notDeepEqual(await bare.at(...fold), on);
  assert.deepEqual(await bare.at(...plain), beside);
  assert.equal(await browser.value('document.getElementById("folding").textContent'), "");
});

test("they are stroked on the robot where they are seen", async () => {
  const { browser } = both;
  await show(browser, "body", "folds");
  const taxels = await pauseAtFold(browser);
  const seen = [];
  await browser.value("document.querySelector('#view-body .relief').focus()");
  for (let side = 0; side < 4; side += 1) {
    seen.push(await strokes(browser));
    for (let turn = 0; turn < 15; turn += 1) await browser.key("ArrowRight");
    await drawn(browser);
  }
  // Each is seen from one side or another, none from all of them.
  assert.ok(Math.max(...seen) > taxels.length / 3 && Math.min(...seen) < taxels.length, `${seen} of ${taxels.length}`);
  await browser.key("Home");
  await browser.value("document.activeElement.blur()");
  await show(browser, "body");
  assert.equal(await strokes(browser), 0);
});

test("an image keeps the folds of its moment", async () => {
  const { browser } = both;
  await show(browser, "garment", "folds");
  const bent = await pauseAtFold(browser);
  const head = await browser.value("taxel.store.shown().number");
  await browser.value("taxel.store.pause(false)");
  await browser.until(`${FOLDING}.followed && ${FOLDING}.taxels.length === 0 && (taxel.store.pause(true), true)`);
  await browser.value("taxel.changed()");
  await browser.until('document.getElementById("folding").textContent === "no fold presses"');
  await browser.value(`taxel.store.stand(${head})`);
  assert.deepEqual(await browser.value(`${FOLDING}.taxels`), bent);
});

test("axe-core finds nothing where something folds", async () => {
  const { browser } = both;
  await show(browser, "garment", "folds");
  await pauseAtFold(browser);
  assert.deepEqual(await violations(browser), []);
});

test("a recording shows where the garment folded, forwards and backwards", async () => {
  const view = await View.start(recording, ...OPTIONS, "--folds", table);
  const browser = await Chromium.start();
  try {
    await browser.open(view.url);
    const at = async (seconds) => {
      await browser.value(`taxel.ask({ play: false }), taxel.ask({ seek: ${seconds} })`);
      await browser.until(`Math.abs(taxel.store.shown()?.head.frame.at_us - ${seconds * 1e6}) < 20000`);
      await browser.until(`${FOLDING}?.followed`);
      return browser.value(`${FOLDING}.taxels.length`);
    };
    // Bent at 1.3 s, straight at the beginning and at the end.
    const bent = await at(1.3);
    assert.ok(bent > 40, `${bent}`);
    assert.equal(await at(0.2), 0);
    assert.equal(await at(1.3), bent);
    assert.deepEqual(browser.complaints, []);
  } finally {
    await browser.stop();
    await view.stop();
  }
});

test("a report shows where the garment folded at its moment", async () => {
  const { browser } = both;
  const file = join(folder, "elbow.html");
  await run(PROGRAM, ["report", recording, ...OPTIONS, "--folds", table, "-o", file]);
  await browser.visit(`file://${file}`, {});
  const [written, flat, robot] = await browser.value(`[
    /Strokes: the garment folds here, (\\d+) taxels/.exec(document.body.textContent)[1],
    ...[...document.querySelectorAll(".fold, #robot svg path[stroke='var(--halo)'][fill=none]")]
      .map((path) => (path.getAttribute("d").match(/M/g) ?? []).length).filter((count) => count),
  ]`);
  assert.equal(flat, Number(written));
  assert.ok(robot > 0 && robot <= flat, `${robot} of ${flat}`);
  assert.deepEqual(await violations(browser), []);
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
