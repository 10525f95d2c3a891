// A recording in the page: opened, gone through, cut, saved; and a page whose program has gone.

import { test } from "node:test";
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import WebSocket from "ws";
import { small, violations } from "./access.fixture.mjs";
import { box, drawn, page, screen, show } from "./page.fixture.mjs";
import { View } from "./program.mjs";

const run = promisify(execFile);
const folder = await mkdtemp(join(tmpdir(), "taxel-recording-"));
const file = join(folder, "lash.mcap");
const PROGRAM = process.env.TAXEL_PROGRAM;
await run(PROGRAM, ["record", "--source", "sim:lash", "--for", "8s", "-o", file]);
const both = page(`replay:${file}`);
test.after(() => rm(folder, { recursive: true }));

const moment = "taxel.store.moment()";
const clock = () => both.browser.value("document.getElementById('clock').textContent");
const ask = async (request, until) => {
  await both.browser.value(`void taxel.ask(${JSON.stringify(request)})`);
  await both.browser.until(until);
  await drawn(both.browser);
};
const log = () => both.browser.value("[...document.querySelectorAll('#log li')].map((line) => line.textContent)");
/** Where the time `seconds` lies on the lower line. */
const place = async (seconds) => {
  const { left, top, width } = await box(both.browser, "#whole");
  const duration = await both.browser.value("taxel.store.recorded.duration");
  return [left + (width * seconds) / duration, top + 12];
};
const press = async ([x, y]) => {
  for (const type of ["mousePressed", "mouseReleased"]) await both.browser.pointer(x, y, type);
};

test("it opens with its length, plays by itself, and stands still when asked", async () => {
  const { browser } = both;
  await browser.until(`${moment} > 0.05`);
  await browser.key(" ");
  await browser.until("!taxel.store.recorded.playing");
  await browser.until("taxel.store.states.overview?.known_us === taxel.store.states.overview?.duration_us");
  // What came last is yet to be drawn.
  await drawn(browser);
  const still = await clock();
  assert.match(still, /^\d+\.\d{3} \/ [78]\.\d\d s {2}#\d+$/);
  await new Promise((done) => setTimeout(done, 400));
  assert.equal(await clock(), still);
  assert.equal(await browser.value("getComputedStyle(document.getElementById('tare')).display"), "none");
});

test("a click on the timeline goes there, and the log is that of the moment", async () => {
  const { browser } = both;
  await press(await place(6));
  await browser.until(`Math.abs(${moment} - 6) < 0.1`);
  await drawn(browser);
  assert.ok((await log()).some((line) => line.includes("contact 1 on the back ends")));
  await ask({ seek: 0.38 }, `${moment} === 0.38`);
  const lines = await log();
  assert.ok(lines[0].includes("contact 1 on the back begins") || lines[0].includes("intention"), lines[0]);
  assert.ok(!lines.some((line) => line.includes("ends")), lines.join("; "));
  assert.equal(await browser.value("taxel.store.shown().head.frame.contacts.length"), 1);
  assert.match(await browser.value("document.querySelector('#contacts tbody').textContent"), /back/);
});

test("steps go from image to image", async () => {
  const { browser } = both;
  const number = "taxel.store.shown().head.frame.frame";
  const from = await browser.value(number);
  await browser.key("ArrowRight");
  await browser.until(`${number} === ${from + 1}`);
  await browser.key("ArrowLeft");
  await browser.until(`${number} === ${from}`);
  await browser.key("ArrowLeft");
  await browser.until(`${number} === ${from - 1}`);
  await browser.key("n");
  await browser.until(`${moment} > 0.38`);
});

test("a lash glows after it has gone, and fades within a second", async () => {
  const { browser } = both;
  await show(browser, "garment", "glow");
  await ask({ speed: 0.25 }, "taxel.store.recorded.speed === 0.25");
  await ask({ seek: 0.34 }, `${moment} === 0.34`);
  await ask({ play: true }, `taxel.store.recorded.playing && ${moment} > 0.5`);
  await ask({ play: false }, "!taxel.store.recorded.playing");
  const [at, pressed] = await browser.value(`[${moment}, Math.max(...taxel.store.shown().image)]`);
  assert.ok(at < 0.9 && pressed === 0, `${pressed} counts at ${at} s`);
  const glow = await browser.value("Math.max(...taxel.store.glowing())");
  assert.ok(glow > 100, `${glow} counts`);
  const colours = await (await screen(browser)).colours(await box(browser, "#view-panels figure:nth-child(2) canvas"));
  assert.ok(colours.some((rgb) => Number(rgb.split(",")[0]) > 100), colours.join(" "));
  await ask({ play: true }, `${moment} > 1.35`);
  await ask({ play: false }, "!taxel.store.recorded.playing");
  assert.equal(await browser.value("Math.max(...taxel.store.glowing())"), 0);
});

test("the range is dragged and repeated", async () => {
  const { browser } = both;
  const handle = await box(browser, "#range-to");
  const from = [handle.left + handle.width / 2, handle.top + 8];
  await browser.pointer(...from, "mousePressed");
  await browser.pointer(...(await place(1)), "mouseMoved");
  await browser.pointer(...(await place(1)), "mouseReleased");
  await browser.until("Math.abs(taxel.store.recorded.range[1] - 1) < 0.1");
  await browser.key("l");
  await ask({ speed: 4 }, "taxel.store.recorded.loop");
  const seeks = await browser.value("taxel.store.recorded.seeks");
  await ask({ play: true }, `taxel.store.recorded.seeks >= ${seeks + 3}`);
  assert.ok((await browser.value(moment)) < 1.2);
  await ask({ play: false }, "!taxel.store.recorded.playing");
});

test("another page comes late and sees the same", async () => {
  const { browser, view } = both;
  const [at, frame] = await browser.value(`[${moment}, taxel.store.shown().head.frame.frame]`);
  const overview = await browser.value("taxel.store.states.overview");
  await browser.open(view.url);
  await browser.until("taxel.store.states.overview");
  assert.equal(await browser.value("taxel.store.shown().head.frame.frame"), frame);
  assert.equal(await browser.value(moment), at);
  assert.deepEqual(await browser.value("taxel.store.states.overview"), overview);
});

test("the range is saved as a recording that info takes", async () => {
  const { browser, view } = both;
  await drawn(browser);
  assert.match(await browser.value("document.getElementById('save-recording').textContent"), /^Range 0\.0 – 1\.\d s/);
  const saved = join(folder, "saved.mcap");
  await writeFile(saved, Buffer.from(await (await fetch(`${view.url}recording.mcap`)).arrayBuffer()));
  const { stdout } = await run(PROGRAM, ["info", "--json", saved]);
  const info = JSON.parse(stdout);
  const range = await browser.value("taxel.store.recorded.range[1]");
  assert.ok(info.whole && info.lost === 0 && Math.abs(info.seconds - range) < 0.05, stdout);
  assert.equal(info.metadata.taxel.counts_per_newton, "1000");
});

test("the scale follows what is shown, where that is asked for", async () => {
  const { browser } = both;
  await ask({ range: null }, "taxel.store.recorded.range[1] > 7");
  await browser.value("(taxel.settings.top = 25, taxel.settings.auto || document.getElementById('auto').click())");
  await ask({ seek: 0.38 }, `${moment} === 0.38`);
  const most = await browser.value("Math.max(...taxel.store.shown().image)");
  await browser.until(`taxel.settings.top >= ${most}`);
  await browser.key("-");
  assert.equal(await browser.value("taxel.settings.auto"), false);
});

test("a line of the log leads to its moment, and so does an address", async () => {
  const { browser, view } = both;
  await ask({ seek: 6 }, `Math.abs(${moment} - 6) < 0.1`);
  const link = `[...document.querySelectorAll("#log a")].find((line) => line.textContent.includes("begins"))`;
  const href = await browser.value(`(${link}.click(), ${link}.getAttribute("href"))`);
  await browser.until(`Math.abs(${moment} - ${href.slice(3)}) < 0.01 && !taxel.store.recorded.playing`);
  assert.ok((await browser.value("location.href")).endsWith(href));
  await browser.open(`${view.url}#t=2.5`);
  await browser.until(`Math.abs(${moment} - 2.5) < 0.01 && !taxel.store.recorded.playing`);
  await browser.value("void (location.hash = '#t=1.5')");
  await browser.until(`Math.abs(${moment} - 1.5) < 0.01`);
});

test("who shares the moment with others is informed", async () => {
  const { browser, view } = both;
  const written = "document.getElementById('viewers').textContent";
  assert.equal(await browser.value(written), "");
  const other = new WebSocket(`${view.url.replace("http", "ws")}socket`);
  await browser.until(`${written} === "2 viewers: all see this moment"`);
  other.close();
  await browser.until(`${written} === ""`);
});

test("a telephone has room for all of it", async () => {
  const { browser, view } = both;
  for (const [width, height] of [
    [390, 844],
    [320, 640],
  ]) {
    await browser.open(view.url, { width, height, mobile: true });
    await browser.until("document.body.classList.contains('recorded')");
    const wide = await browser.value("document.documentElement.scrollWidth");
    assert.ok(wide <= width, `${wide} of ${width} pixels`);
    await drawn(browser);
    assert.deepEqual(await small(browser), []);
    assert.deepEqual(await violations(browser), []);
  }
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));

test("a page whose program has gone does not look live, and comes back by itself", async () => {
  const { browser, view } = both;
  assert.equal(await browser.value("document.getElementById('absence').hidden"), true);
  await view.stop();
  await browser.until("document.body.classList.contains('gone')");
  assert.match(await browser.value("document.getElementById('absence').textContent"), /^Disconnected since .*again/);
  assert.match(await browser.value("getComputedStyle(document.querySelector('main')).filter"), /grayscale/);
  both.view = await View.start("--port", String(view.port), file);
  await browser.until("!document.body.classList.contains('gone') && document.getElementById('absence').hidden");
  await browser.until(`${moment} > 0.1`);
});
