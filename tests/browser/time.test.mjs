// Pause, steps back, saving, and faulty taxels.

import { test } from "node:test";
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { drawn, page, show } from "./page.fixture.mjs";

const folder = await mkdtemp(join(tmpdir(), "taxel-view-"));
const scene = join(folder, "faulty.toml");
await writeFile(
  scene,
  `title = "three faulty taxels"
description = "A pat on a garment with three faulty taxels."
duration_s = 2
[faults]
from_s = 0.3
open = [40]
shorted = [600]
stuck = [{ taxel = 1100, code = 77 }]
[[touch]]
panel = "back"
shape = "palm"
force_n = 8
at = [7.5, 20]
start_s = 0.5
rise_s = 0.06
hold_s = 0.4
fall_s = 0.06
repeat = 2
period_s = 0.8
`,
);
const both = page(`sim:${scene}`, { search: "?keep=8" });
test.after(() => rm(folder, { recursive: true }));
const time = (browser) => browser.value("taxel.store.shown().head.frame.time_us");

test("a paused page stands still while images go on coming, and steps back through them", async () => {
  const { browser } = both;
  await browser.until(
    "taxel.store.latest.head.frame.time_us - taxel.store.at(taxel.store.span()[0]).head.frame.time_us > 3e6",
  );
  await browser.key(" ");
  const still = await time(browser);
  const image = await browser.value("[...taxel.store.shown().image]");
  const count = await browser.value("taxel.store.count");
  await browser.until(`taxel.store.count > ${count + 30}`);
  assert.equal(await time(browser), still);
  assert.deepEqual(await browser.value("[...taxel.store.shown().image]"), image);
  const number = await browser.value("taxel.store.shown().number");
  for (let step = 0; step < 5; step += 1) await browser.key("ArrowLeft");
  assert.equal(await browser.value("taxel.store.shown().number"), number - 5);
  assert.ok((await time(browser)) < still);
  await browser.value(`(() => {
    const seek = document.getElementById("seek");
    seek.value = -3;
    seek.dispatchEvent(new Event("input"));
  })()`);
  const behind = await browser.value("taxel.store.behind()");
  assert.ok(Math.abs(behind - 3) < 0.1, `${behind} s`);
  await drawn(browser);
  assert.match(await browser.value("document.getElementById('clock').textContent"), /s {2}\(−\d/);
  await browser.key(" ");
  assert.equal(await browser.value("taxel.store.paused"), false);
  assert.equal(await browser.value("taxel.store.behind()"), 0);
});

test("what is kept has an end", async () => {
  const { browser } = both;
  await browser.until("taxel.store.count > taxel.store.size", 30);
  const [first, end] = await browser.value("taxel.store.span()");
  assert.ok(end - first <= (await browser.value("taxel.store.size")));
  await browser.key(" ");
  await browser.value("taxel.store.step(-1e6)");
  // Standing at the oldest image, which others replace: what is shown stays, and steps go on from what is left.
  const [count, still] = await browser.value("[taxel.store.count, taxel.store.shown().head.frame.time_us]");
  const image = await browser.value("[...taxel.store.shown().image]");
  await browser.until(`taxel.store.count > ${count + 20}`);
  assert.equal(await time(browser), still);
  assert.deepEqual(await browser.value("[...taxel.store.shown().image]"), image);
  await browser.key("ArrowRight");
  assert.ok((await time(browser)) > still);
  await browser.key(" ");
});

test("a page that is loaded again steps back through what was before", async () => {
  const { browser, view } = both;
  await browser.until("taxel.store.log.length > 40", 30);
  const [before, oldest] = await browser.value("[taxel.store.latest.head.frame.time_us, taxel.store.marks[0][0]]");
  await browser.open(`${view.url}?keep=8`);
  const kept = "taxel.store.latest.head.frame.time_us - taxel.store.at(taxel.store.span()[0]).head.frame.time_us";
  await browser.until(`taxel.store.latest.head.frame.time_us > ${before} && ${kept} > 7e6`, 6);
  await browser.value("taxel.store.seek(taxel.store.end() - 4e6)");
  assert.ok((await time(browser)) < before);
  assert.ok(await browser.value("taxel.store.marks.some(([, kind]) => kind === 'onset')"));
  assert.equal(await browser.value("taxel.store.marks[0][0]"), oldest);
  await browser.key(" ");
});

test("a moment is saved as JSON, and the board's bytes as a recording", async () => {
  const { browser, view } = both;
  const saved = await browser.value(`(async () => (await import("./save.js")).momentOf(taxel.store))()`);
  assert.equal(saved.type, "frame");
  assert.deepEqual(
    saved.panels.map(({ name, rows }) => [name, rows.length, rows[0].length]),
    ["chest", "back", "left arm", "right arm"].map((name) => [name, 32, 16]),
  );
  const answer = await fetch(`${view.url}recording.mcap`);
  const file = join(folder, "recording.mcap");
  await writeFile(file, Buffer.from(await answer.arrayBuffer()));
  const run = promisify(execFile);
  const { stdout } = await run(process.env.TAXEL_PROGRAM, ["live", "--source", `replay:${file}@max`, "--json"], {
    maxBuffer: 1 << 28,
  });
  const frames = stdout
    .split("\n")
    .filter(Boolean)
    .map((line) => JSON.parse(line))
    .filter(({ type }) => type === "frame");
  assert.ok(frames.length > 600, `${frames.length} frames`);
  assert.ok(frames.every(({ decoded, lost }) => decoded && lost === 0));
});

test("faulty taxels are on the map of health", async () => {
  const { browser } = both;
  await browser.until("taxel.store.faulty().size >= 3", 30);
  await show(browser, "health");
  // The script begins again every two seconds, and a shorted taxel that rests meanwhile is taken back: each is named at some time.
  for (const text of [
    "open: chest, row 2, column 8",
    "shorted: back, row 5, column 8",
    "stuck: left arm, row 4, column 12",
  ]) {
    await browser.until(`document.querySelector('#view-health .list').textContent.includes("${text}")`, 30);
  }
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
