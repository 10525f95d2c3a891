// The page for whoever uses no pointer, does not see it, or holds a telephone: axe-core finds nothing on any tab.

import { test } from "node:test";
import assert from "node:assert/strict";
import { small, violations } from "./access.fixture.mjs";
import { box, drawn, page, show } from "./page.fixture.mjs";

const both = page("sim:pat");
const VIEWS = ["garment", "surface", "body", "map", "health"];
const SIZES = {
  light: {},
  dark: { dark: true },
  telephone: { width: 390, height: 844, mobile: true },
};

for (const [name, size] of Object.entries(SIZES)) {
  test(`axe-core finds nothing on any tab: ${name}`, async () => {
    const { browser, view } = both;
    await browser.open(view.url, size);
    for (const tab of VIEWS) {
      await browser.value(`document.getElementById("tab-${tab}").click()`);
      await drawn(browser);
      assert.deepEqual(await violations(browser), [], tab);
    }
    for (const dialog of ["help", "tare"]) {
      await browser.value(`document.getElementById("${dialog}").click()`);
      assert.deepEqual(await violations(browser), [], dialog);
      await browser.value('document.querySelector("dialog[open]").close()');
    }
  });
}

test("on a telephone every control is as large as a finger", async () => {
  const { browser, view } = both;
  await browser.open(view.url, SIZES.telephone);
  assert.deepEqual(await small(browser), []);
  await show(browser, "surface");
  const surface = await box(browser, ".relief");
  assert.ok(surface.left >= 0 && surface.left + surface.width <= SIZES.telephone.width, JSON.stringify(surface));
  await browser.open(view.url);
});

test("the arrow keys of the tabs are the tabs'", async () => {
  const { browser } = both;
  await browser.value('document.getElementById("tab-garment").click()');
  await browser.value('document.getElementById("tab-garment").focus()');
  const chosen = () => browser.value('[document.activeElement.id, document.querySelector("[aria-selected=true]").id]');
  for (const [key, tab] of [
    ["ArrowRight", "surface"],
    ["End", "health"],
    ["ArrowRight", "garment"],
    ["ArrowLeft", "health"],
    ["Home", "garment"],
  ]) {
    await browser.key(key);
    assert.deepEqual(await chosen(), [`tab-${tab}`, `tab-${tab}`], key);
  }
  // None of them stepped back through the half minute, and one tab is a stop of the tabulator.
  assert.equal(await browser.value("taxel.store.paused"), false);
  assert.equal(await browser.value(`document.querySelectorAll('[role="tab"][tabindex="0"]').length`), 1);
});

test("nothing that is spoken changes faster than it can be listened to", async () => {
  const { browser } = both;
  const spoken = await browser.value(`(async () => {
    const live = document.querySelectorAll("[role=status], [role=alert], [role=log], [aria-live=polite], output");
    let changes = 0;
    const watch = new MutationObserver((list) => (changes += list.length));
    for (const region of live) watch.observe(region, { childList: true, characterData: true, subtree: true });
    const before = taxel.store.count;
    while (taxel.store.count < before + 180) await new Promise(requestAnimationFrame);
    watch.disconnect();
    return { changes, regions: live.length };
  })()`);
  assert.ok(spoken.regions >= 3 && spoken.changes <= 4, JSON.stringify(spoken));
});

test("a taxel that the keys read is spoken", async () => {
  const { browser } = both;
  await show(browser, "garment");
  await browser.value('document.querySelector("#view-panels canvas").focus()');
  await browser.key("ArrowUp");
  await browser.until(`/^chest, row 15, column 8: [\\d.]+ kPa$/.test(document.getElementById("spoken").textContent)`);
  await browser.key("Escape");
  await browser.value("document.activeElement.blur()");
});

test("a tare is asked for before it is done", async () => {
  const { browser } = both;
  const open = () => browser.value('document.getElementById("ask-tare").open');
  const opened = () => browser.until('document.querySelector("#ask-tare[open] [value=no]") === document.activeElement');
  const tared = () => browser.value('taxel.store.log.some(({ said }) => said.includes("tare over"))');
  await browser.key("t");
  await opened();
  // What is at hand is the way out.
  await browser.value("document.activeElement.click()");
  assert.deepEqual([await open(), await tared()], [false, false]);
  // The way out may still have the focus: keys are the page's again nevertheless.
  await browser.value(`document.querySelector("#ask-tare [value=no]")
    .dispatchEvent(new KeyboardEvent("keydown", { key: "t", bubbles: true }))`);
  await opened();
  await browser.key("Escape");
  await browser.until("!document.getElementById('ask-tare').open");
  assert.equal(await tared(), false);
  await browser.value('document.getElementById("tare").click()');
  await browser.value(`document.querySelector('#ask-tare [value="tare"]').click()`);
  await browser.until('taxel.store.log.some(({ said }) => said.includes("tare over"))');
});

test("the menu is one of keys, too, and keys without a focus can be switched off", async () => {
  const { browser } = both;
  const focused = () => browser.value("document.activeElement.dataset.save ?? document.activeElement.id");
  await browser.key("s");
  const seen = [await focused()];
  for (const key of ["ArrowDown", "ArrowDown", "ArrowDown", "End", "Escape"]) {
    await browser.key(key);
    seen.push(await focused());
  }
  assert.deepEqual(seen, ["png", "json", "mcap", "png", "mcap", "save"]);
  assert.equal(await browser.value("document.getElementById('savings').hidden"), true);
  await browser.value("document.activeElement.blur()");
  await browser.value("document.getElementById('keys-on').click()");
  await browser.key("2");
  assert.equal(await browser.value("taxel.settings.view"), "garment");
  await browser.value("document.getElementById('keys-on').click()");
  await browser.key("2");
  assert.equal(await browser.value("taxel.settings.view"), "surface");
});

test("one colour has one meaning", async () => {
  const { browser } = both;
  const NAMES = ["accent", "more", "less", "force", "lost", "mark-note", "mark-gesture", "mark-intention", "mark-reaction"];
  for (const theme of ["light", "dark"]) {
    const seen = await browser.value(`(async () => {
      document.documentElement.dataset.theme = "${theme}";
      const { palette } = await import("./colours.js");
      const { CLASSES } = await import("./health.js");
      const style = getComputedStyle(document.documentElement);
      return {
        ...Object.fromEntries(${JSON.stringify(NAMES)}.map((name) => [name, style.getPropertyValue("--" + name).trim()])),
        ...palette.intentions,
        feeling: palette.feeling,
        ...Object.fromEntries(Object.entries(CLASSES).map(([health, [, fill]]) => [health, fill])),
      };
    })()`);
    const names = Object.keys(seen);
    assert.ok(names.length >= NAMES.length + 3 + 1 + 5, names.join());
    const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
    for (const one of names)
      for (const other of names.filter((name) => name > one)) {
        const apart = Math.hypot(...rgb(seen[one]).map((part, at) => part - rgb(seen[other])[at]));
        assert.ok(apart > 30, `${theme}: ${one} ${seen[one]}, ${other} ${seen[other]}: ${apart.toFixed(0)}`);
      }
  }
  await browser.open(both.view.url);
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
