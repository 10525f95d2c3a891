// A simulated pat on the page: its place, its colours, its numbers.

import { test } from "node:test";
import assert from "node:assert/strict";
import { box, drawn, page, pauseAtTouch, screen, show } from "./page.fixture.mjs";

// As host/sim/scenes/pat.toml has it: a palm on the back, column 7.5 and row 11, 8 N at most.
const [PANEL, COLUMN, ROW] = [1, 7.5, 11];
const [ROWS, COLUMNS] = [32, 16];
// The ends of cividis (Nunez, Anderton, Renslow 2018), and the colour in its middle.
const [LOW, MIDDLE, HIGH] = [
  [0, 34, 78],
  [125, 124, 120],
  [254, 232, 56],
];

const both = page("sim:pat");
const figure = (panel) => `#view-panels figure:nth-child(${panel + 1}) canvas`;
const close = (a, b, by) => a.every((part, at) => Math.abs(part - b[at]) <= by);

test("the header says for as long as it lasts that the board is simulated", async () => {
  const { browser } = both;
  await show(browser, "garment");
  assert.match(await browser.value("document.getElementById('source').textContent"), /^SIMULATED · sim:pat · /);
});

test("a pat appears on the back, at its place, in the colours of its pressure", async () => {
  const { browser } = both;
  await show(browser, "garment");
  await pauseAtTouch(browser, 7000);
  const { frame } = await browser.value("taxel.store.shown().head");
  assert.equal(frame.contacts.length, 1);
  const [touch] = frame.contacts;
  assert.equal(touch.panel_name, "back");
  assert.ok(Math.hypot(touch.column - COLUMN, touch.row - ROW) < 1, `${touch.column}, ${touch.row}`);
  const values = await browser.value("[...taxel.store.shown().image]");
  const seen = await screen(browser);
  // At rest: nothing but the colour of no pressure.
  for (const panel of [0, 2, 3]) {
    const { left, top, width, height } = await box(browser, figure(panel));
    const inner = { left: left + 4, top: top + 4, width: width - 8, height: height - 8 };
    assert.deepEqual(await seen.colours(inner), [LOW.join()], `panel ${panel}`);
  }
  // Pressed: the colour of a taxel grows as its pressure does, from blue to yellow, and says where it is.
  const place = await box(browser, figure(PANEL));
  const at = (row, column) =>
    seen.at(place.left + ((column + 0.5) * place.width) / COLUMNS, place.top + ((row + 0.5) * place.height) / ROWS);
  const top = await browser.value("taxel.settings.top");
  let pressed = 0;
  for (let row = 0; row < ROWS; row += 1) {
    for (let column = 0; column < COLUMNS; column += 1) {
      const share = Math.min(1, values[PANEL * ROWS * COLUMNS + row * COLUMNS + column] / top);
      if (share === 0) continue;
      pressed += 1;
      const [from, to, part] = share < 0.5 ? [LOW, MIDDLE, share * 2] : [MIDDLE, HIGH, share * 2 - 1];
      const straight = from.map((low, at) => low + (to[at] - low) * part);
      // The scale bends away from the straight line between these three colours by so much.
      assert.ok(close(await at(row, column), straight, 36), `row ${row}, column ${column}: ${await at(row, column)}`);
    }
  }
  assert.ok(pressed > 50, `${pressed} taxels`);
  assert.ok(close(await at(1, 1), LOW, 2));
});

test("layers are drawn where the contact is, and interpolation makes steps smaller", async () => {
  const { browser } = both;
  const count = async () => (await (await screen(browser)).colours(await box(browser, figure(PANEL)))).length;
  await show(browser, "garment");
  const raw = await count();
  await show(browser, "garment", "smooth");
  assert.ok((await count()) > 1.5 * raw);
  for (const layer of ["contours", "contacts", "peaks"]) {
    await show(browser, "garment", layer);
    const white = (await (await screen(browser)).colours(await box(browser, figure(PANEL)))).map((c) =>
      c.split(",").map(Number),
    );
    assert.ok(
      white.some((rgb) => Math.min(...rgb) > 150 && rgb[2] > 150),
      layer,
    );
  }
});

test("the pointer reads code, pressure, health and wiring of a taxel", async () => {
  const { browser } = both;
  await browser.value("taxel.store.pause(false)");
  const { left, top, width, height } = await box(browser, figure(PANEL));
  await browser.pointer(left + (7.5 * width) / COLUMNS, top + (11.5 * height) / ROWS);
  const cell = (name) =>
    `[...document.querySelectorAll("#hover dt")].find((dt) => dt.textContent === "${name}")?.nextSibling.textContent`;
  await browser.until(`/^\\d+$/.test(${cell("raw code")})`);
  assert.equal(await browser.value('document.querySelector("#hover b").textContent'), "back, row 11, column 7");
  assert.equal(await browser.value(cell("health")), "good");
  assert.equal(await browser.value(cell("wired")), "block 10, row 3, column 7");
  await browser.until(`Number(${cell("counts")}) > 60`);
  await pauseAtTouch(browser, 7000);
  const counts = await browser.value(`taxel.store.shown().image[${PANEL * ROWS * COLUMNS + 11 * COLUMNS + 7}]`);
  assert.equal(await browser.value(cell("counts")), String(counts));
  // 1,000 counts are a newton, a taxel is 12 mm x 10 mm: a count is 1 / 120 of a N/cm2.
  assert.equal(await browser.value(cell("pressure")), `${(counts / 120).toFixed(1)} kPa`);
  await browser.pointer(2, 2);
  await drawn(browser);
  assert.equal(await browser.value("document.getElementById('hover').hidden"), true);
});

test("the arrow keys read taxels without a pointer", async () => {
  const { browser } = both;
  await browser.value(`document.querySelector("${figure(2)}").focus()`);
  for (const key of ["ArrowUp", "ArrowLeft", "ArrowLeft"]) await browser.key(key);
  await drawn(browser);
  assert.equal(await browser.value('document.querySelector("#hover b").textContent'), "left arm, row 15, column 6");
  await browser.key("Escape");
  await drawn(browser);
  assert.equal(await browser.value("document.getElementById('hover').hidden"), true);
  await browser.value("document.activeElement.blur()");
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
