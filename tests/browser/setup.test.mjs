// What a page sets on the board: a limit, and what it changes, undone and saved; a page that only looks sets nothing.

import { mkdir, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { small, violations } from "./access.fixture.mjs";
import { Chromium } from "./chromium.mjs";
import { covered } from "./layout.fixture.mjs";
import { drawn } from "./page.fixture.mjs";
import { View } from "./program.mjs";
import { serve } from "./site.fixture.mjs";

const SIZES = {
  "1440x900": { width: 1440, height: 900 },
  "1280x720": { width: 1280, height: 720 },
  "390x844": { width: 390, height: 844, mobile: true },
};
/** Folder for the pictures of the walk; none by default. */
const PICTURES = process.env.TAXEL_PICTURES;
const all = {};

before(async () => {
  all.view = await View.start("--source", "sim:five");
  all.looked = await View.start("--source", "sim:five", "--read-only");
  all.server = await serve();
  all.browser = await Chromium.start();
});
after(async () => {
  await all.browser?.stop();
  await Promise.all([all.view?.stop(), all.looked?.stop(), all.server?.stop()]);
});

const limits = (browser) => browser.value("taxel.store.states.setup.limits");
/** Moves a slider, and lets it go. */
const slide = (browser, name, value) =>
  browser.value(`(() => {
    const slider = document.getElementById("limit-${name}");
    slider.value = "${value}";
    for (const type of ["input", "change"]) slider.dispatchEvent(new Event(type, { bubbles: true }));
  })()`);
/** Opens a page, and waits until it has got the half minute before it was opened: answers come after that. */
async function openLive(browser, url) {
  await browser.open(url);
  await browser.until("taxel.store.states.setup && !taxel.store.latest.head.frame.past", 60);
}
const click = (browser, id) => browser.value(`document.getElementById("${id}").click()`);
const disabled = (browser, id) => browser.value(`document.getElementById("${id}").disabled`);

for (const [where, url] of [["the program's page", () => all.view.url], ["the site", () => `${all.server.url}?script=five`]]) {
  test(`on ${where} a limit changes what is felt, and is undone and saved`, async () => {
    const { browser } = all;
    await openLive(browser, url());
    await click(browser, "set-up");
    await drawn(browser);
    const before = await limits(browser);
    await browser.until("taxel.store.latest.head.frame.contacts.length > 0", 40);
    await browser.until("/greatest pressure now is/.test(document.getElementById('passed').textContent)");
    assert.deepEqual([await disabled(browser, "undo"), await disabled(browser, "save-board")], [true, true]);
    await slide(browser, "high", 1000);
    await browser.until("taxel.store.states.setup.limits.high === 1000");
    await slide(browser, "low", 400);
    await browser.until("taxel.store.states.setup.limits.low === 400 && taxel.store.states.setup.undo === 2");
    assert.deepEqual(await limits(browser), { ...before, low: 400, high: 1000 });
    await browser.value("(document.getElementById('filter').value = 'off', document.getElementById('filter').dispatchEvent(new Event('change')))");
    await browser.until("taxel.store.states.setup.limits.filter === 'off'");
    for (const step of [2, 1, 0]) {
      await browser.until("!document.getElementById('undo').disabled");
      await click(browser, "undo");
      await browser.until(`taxel.store.states.setup.undo === ${step}`);
    }
    await browser.until(`taxel.store.states.setup.limits.high === ${before.high}`);
    assert.deepEqual(await limits(browser), before);
    await browser.until("!document.getElementById('save-board').disabled");
    await click(browser, "save-board");
    await browser.until("!taxel.store.states.setup.unsaved");
  });
}

for (const [name, size] of Object.entries(SIZES)) {
  for (const dark of [false, true]) {
    test(`with the limits open nothing is covered: ${name}, ${dark ? "dark" : "light"}`, async () => {
      const { browser, view } = all;
      await browser.open(view.url, { ...size, dark });
      await browser.until("taxel.store.states.setup");
      await click(browser, "set-up");
      await drawn(browser);
      assert.equal(await browser.value("document.getElementById('limits').checkVisibility()"), true);
      assert.deepEqual(await violations(browser), []);
      if (size.mobile) assert.deepEqual(await small(browser), []);
      else assert.deepEqual(await covered(browser), []);
      if (!PICTURES) return;
      await mkdir(PICTURES, { recursive: true });
      await writeFile(join(PICTURES, `limits-${name}-${dark ? "dark" : "light"}.png`), await browser.picture());
    });
  }
}

test("a real board is set after a question, once", async () => {
  const { browser, view } = all;
  await openLive(browser, view.url);
  const before = await limits(browser);
  await browser.value("taxel.store.line({ ...taxel.store.states.setup, simulated: false }), taxel.changed()");
  await click(browser, "set-up");
  await slide(browser, "high", before.high + 7);
  assert.equal(await browser.value("document.getElementById('ask-setup').open"), true);
  await browser.value("document.querySelector('#ask-setup [value=no]').click()");
  await browser.until("!document.getElementById('ask-setup').open");
  assert.deepEqual(await limits(browser), before);
  await slide(browser, "high", before.high + 7);
  await browser.value("document.querySelector('#ask-setup [value=yes]').click()");
  await browser.until(`taxel.store.states.setup.limits.high === ${before.high + 7}`);
  // Last, because it keeps the page so busy that the program may give it up.
  await browser.value("taxel.store.line({ ...taxel.store.states.setup, simulated: false }), taxel.changed()");
  await browser.until("!document.getElementById('save-board').disabled");
  await click(browser, "save-board");
  assert.deepEqual(await violations(browser), []);
  await browser.value("document.querySelector('#ask-setup [value=no]').click()");
});

test("a page that only looks offers nothing, and what it asks changes nothing", async () => {
  const { browser, looked } = all;
  await browser.open(looked.url);
  await browser.until("taxel.store.states.setup?.read_only");
  await drawn(browser);
  const hidden = (id) => browser.value(`!document.getElementById("${id}").checkVisibility()`);
  assert.deepEqual(await Promise.all(["set-up", "setup", "tare", "hand"].map(hidden)), [true, true, true, true]);
  const before = await limits(browser);
  await browser.value(`(taxel.ask({ limits: ${JSON.stringify({ ...before, high: 999 })} }), taxel.ask({ tare: 8 }), taxel.ask({ setup: "save" }))`);
  const frame = await browser.value("taxel.store.latest.head.frame.frame");
  await browser.until(`taxel.store.latest.head.frame.frame > ${frame} + 200`);
  assert.deepEqual(await limits(browser), before);
  assert.equal(await browser.value("taxel.store.log.some(({ said }) => /tare over|saved/.test(said))"), false);
});

test("the page has complained of nothing", () => assert.deepEqual(all.browser.complaints, []));
