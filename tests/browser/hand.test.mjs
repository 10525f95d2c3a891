// What presses a simulated garment on the page: its tools, scripts, and what is done with the touches by hand.

import { execFile } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { promisify } from "node:util";
import assert from "node:assert/strict";
import { small, violations } from "./access.fixture.mjs";
import { Chromium } from "./chromium.mjs";
import { BACK, choose, drag, felt, near, NEWTON, onPanel, rest, watch } from "./hand.fixture.mjs";
import { box, drawn, page, show } from "./page.fixture.mjs";
import { View } from "./program.mjs";
import { OPTIONS } from "./robot.fixture.mjs";

const both = page("sim:idle", { options: OPTIONS });

test("the palette names the tools, and the picture says what can be done until somebody does it", async () => {
  const { browser } = both;
  await show(browser, "garment");
  const names = "[...document.querySelectorAll('#tools [role=radio]')].map((button) => button.textContent)";
  assert.deepEqual(await browser.value(names), ["fingertip", "pen", "palm", "forearm", "ball", "strap"]);
  assert.equal(await browser.value("document.querySelectorAll('#tools [aria-checked=true]').length"), 1);
  assert.equal(await browser.value("document.getElementById('invite').textContent"), "Press the garment");
  assert.equal(await browser.value("document.getElementById('invite').checkVisibility()"), true);
  for (const view of ["map", "health"]) {
    await show(browser, view);
    assert.equal(await browser.value("document.getElementById('hand').checkVisibility()"), false, view);
  }
  await show(browser, "garment");
});

test("the wheel over the garment changes the force, and with shift turns the tool", async () => {
  const { browser } = both;
  await choose(browser, "palm");
  await browser.until("document.getElementById('tool-force').textContent === '8.0 N'");
  const [x, y] = await onPanel(browser, BACK, [7.5, 15]);
  await browser.pointer(x, y);
  for (let notch = 0; notch < 5; notch += 1) await browser.wheel(x, y, 1);
  await browser.until("document.getElementById('tool-force').textContent === '16 N'");
  for (let notch = 0; notch < 5; notch += 1) await browser.wheel(x, y, -1);
  await browser.until("document.getElementById('tool-force').textContent === '8.0 N'");
  await choose(browser, "strap");
  await browser.pointer(x, y);
  await drawn(browser);
  // The first mark is on the figure, the second one on the panel.
  const size = () => browser.value("(({ width, height }) => [width, height])(document.querySelector('#tool-marks g:nth-child(2) path').getBBox())");
  const { width, height } = await box(browser, "#view-panels figure:nth-child(2) canvas");
  // 20 mm of 320 mm high, and as long as the panel is wide.
  near((await size())[1], (20 / 320) * height, 1.5, "pixels");
  near((await size())[0], width, 1.5, "pixels");
  for (let notch = 0; notch < 6; notch += 1) await browser.wheel(x, y, 1, 8);
  await drawn(browser);
  near((await size())[1], (250 / 320) * height, 1.5, "pixels");
  for (let notch = 0; notch < 6; notch += 1) await browser.wheel(x, y, 1, 8);
  await choose(browser, "palm");
});

test("what was pressed is played again, saved as a script, and forgotten", async () => {
  const { browser } = both;
  await browser.value("document.getElementById('clear').click()");
  await browser.until("taxel.store.states.hand.touches === 0");
  const offers = "document.getElementById('again').checkVisibility({ visibilityProperty: true })";
  assert.equal(await browser.value(offers), false);
  await drag(browser, 2, [7.5, 8], [7.5, 20], 600);
  await rest(browser);
  await browser.until(`taxel.store.states.hand.touches === 1 && ${offers}`);
  const seen = await watch(browser, async () => {
    await browser.value("document.getElementById('again').click()");
    await felt(browser, "touches.length === 1");
  });
  const touched = seen.filter(({ contacts }) => contacts.length).map(({ contacts: [touch] }) => touch);
  assert.equal(touched[0].panel, 2);
  near(touched.at(-1).row - touched[0].row, 12, 1.5, "taxels");
  const saved = await fetch(await browser.value("document.getElementById('save-touches').href"));
  assert.match(saved.headers.get("content-disposition"), /attachment/);
  const script = await saved.text();
  assert.match(script, /^panel = "left arm"$/m);
  assert.match(script, /^path = \[/m);
  await browser.value("document.getElementById('clear').click()");
  await browser.until("taxel.store.states.hand.touches === 0");
});

test("a script is chosen from the list, and played", async () => {
  const { browser } = both;
  await browser.value("document.getElementById('script').value = 'pat'");
  await browser.value("document.getElementById('play-script').click()");
  await browser.until("taxel.store.states.hand.playing === 'pat'");
  const [touch] = await felt(browser, `touches[0]?.total > ${6 * NEWTON}`);
  assert.equal(touch.panel, BACK);
  await browser.until("taxel.store.states.hand.playing === null && document.getElementById('play-script').textContent === 'Play'");
});

test("one tool is chosen by the arrow keys of the palette, which do not step back in time", async () => {
  const { browser } = both;
  await choose(browser, "fingertip");
  await browser.value("document.querySelector('#tools [aria-checked=true]').focus()");
  const names = [];
  for (const key of ["ArrowRight", "ArrowRight", "ArrowLeft"]) {
    await browser.key(key);
    names.push(await browser.value("[document.activeElement.textContent, document.activeElement.ariaChecked].join()"));
  }
  assert.deepEqual(names, ["pen,true", "palm,true", "pen,true"]);
  assert.equal(await browser.value("taxel.store.paused"), false);
  assert.equal(await browser.value("document.querySelectorAll('#tools [tabindex=\"0\"]').length"), 1);
  await browser.value("document.activeElement.blur()");
});

for (const [name, size] of Object.entries({
  light: {},
  dark: { dark: true },
  telephone: { width: 390, height: 844, mobile: true },
})) {
  test(`axe-core finds nothing on what presses, and there is room for it: ${name}`, async () => {
    const { browser, view } = both;
    await browser.open(view.url, size);
    for (const tab of ["garment", "surface", "body"]) {
      await show(browser, tab);
      assert.equal(await browser.value("document.getElementById('hand').checkVisibility()"), true);
      assert.deepEqual(await violations(browser), [], tab);
      if (size.mobile) assert.deepEqual(await small(browser), [], tab);
      const wide = await browser.value("document.documentElement.scrollWidth");
      assert.ok(wide <= (size.width ?? 1280), `${tab}: ${wide} pixels`);
    }
    await browser.open(view.url);
  });
}

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));

test("a recording cannot be pressed", async () => {
  const folder = await mkdtemp(join(tmpdir(), "taxel-hand-"));
  const file = join(folder, "idle.mcap");
  await promisify(execFile)(process.env.TAXEL_PROGRAM, ["record", "--source", "sim:idle", "--for", "2s", "-o", file]);
  const view = await View.start("--source", `replay:${file}`);
  const browser = await Chromium.start();
  try {
    await browser.open(view.url);
    for (const tab of ["garment", "surface", "body"]) {
      await show(browser, tab);
      const shown = "['hand', 'invite'].some((id) => document.getElementById(id).checkVisibility())";
      assert.equal(await browser.value(shown), false, tab);
    }
    const keys = "(document.getElementById('help').click(), document.getElementById('keys').textContent)";
    assert.doesNotMatch(await browser.value(keys), /tool that presses/);
  } finally {
    await browser.stop();
    await view.stop();
    await rm(folder, { recursive: true });
  }
});
