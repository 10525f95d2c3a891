// The first thing that one reads: what is felt, and why that is its meaning.

import { test } from "node:test";
import assert from "node:assert/strict";
import { violations } from "./access.fixture.mjs";
import { drawn, page } from "./page.fixture.mjs";

const both = page("sim:pat");
const text = (id) => both.browser.value(`document.getElementById(${JSON.stringify(id)}).textContent`);
const click = (id) => both.browser.value(`document.getElementById(${JSON.stringify(id)}).click()`);

test("one sentence says what touches, how much, and what that means", async () => {
  const { browser } = both;
  await browser.until(`(({ contacts: [touch], intent }) => touch?.total > 7000 && intent.leading === "kindness")(
    taxel.store.latest.head.frame) && (taxel.store.pause(true), taxel.changed(), true)`);
  await drawn(browser);
  assert.match(await text("what"), /^a (sliding )?touch on the back, [78] N$/);
  assert.equal(await text("basis"), "simulated newtons");
  assert.match(await text("when"), /^at \d+\.\d\d s$/);
  const [chip, ribbon] = await browser.value(`(async () => {
    const { palette } = await import("./colours.js");
    const seen = document.createElement("i");
    seen.style.background = palette.intentions.kindness;
    return [document.getElementById("leading").style.background, seen.style.background];
  })()`);
  assert.equal(chip, ribbon);
});

test("concepts are folded in groups, and an intention has its colour", async () => {
  const { browser } = both;
  const groups = await browser.value(`[...document.querySelectorAll("#concepts details")].map((group) =>
    [group.querySelector("b").textContent, group.open, group.querySelectorAll("li").length])`);
  assert.deepEqual(groups, [
    ["What is felt", false, 0],
    ["What it means", false, 0],
    ["Feelings", false, 0],
  ]);
  await browser.value(`document.querySelectorAll("#concepts summary")[1].click()`);
  await browser.until(`document.querySelectorAll("#concepts li").length === 5`);
  const names = `[...document.querySelectorAll("#concepts li")].map((item) => item.firstChild.textContent)`;
  assert.deepEqual(await browser.value(names), ["kindness", "threat", "attack", "sting", "grip"]);
  const fill = `getComputedStyle(document.querySelector("#concepts li b")).backgroundColor`;
  assert.equal(await browser.value(fill), "rgb(0, 158, 115)");
});

test("why adds up, also of a moment that is past, and closes again", async () => {
  const { browser } = both;
  await click("why");
  await browser.until(`document.getElementById("reasons-title").textContent.startsWith("Why kindness is")`);
  const rows = await browser.value(`[...document.querySelectorAll("#reasons-inputs tr")].map((row) =>
    [row.cells[0].textContent, Number(row.cells[2].textContent.replace("−", "-"))])`);
  const sum = rows.at(-1);
  assert.equal(sum[0], "sum");
  const parts = rows.slice(0, -1).reduce((all, [, share]) => all + share, 0);
  assert.ok(Math.abs(parts - sum[1]) < 0.005 * rows.length, JSON.stringify(rows));
  assert.ok(rows.some(([name, share]) => name === "goodwill" && share > 0), JSON.stringify(rows));
  const paths = await browser.value(`[...document.querySelectorAll("#reasons-paths li")].map((item) => item.textContent)`);
  assert.ok(paths.some((path) => path.endsWith("goodwill → kindness")), paths.join("; "));
  assert.deepEqual(await violations(browser), []);
  // An intention's name asks the same.
  await browser.value(`[...document.querySelectorAll("#concepts li button")].find((one) => one.textContent === "attack").click()`);
  await browser.until(`document.getElementById("reasons-title").textContent.startsWith("Why attack is")`);
  await click("why-close");
  assert.equal(await browser.value(`document.getElementById("reasons").hidden`), true);
});

test("a paused log ends at the moment shown, and its lines lead to theirs", async () => {
  const { browser } = both;
  await browser.value("taxel.store.pause(false)");
  await browser.until("taxel.store.latest.head.frame.time_us > 8e6", 30);
  const link = `[...document.querySelectorAll("#log a")].at(-20)`;
  await browser.until(link);
  const at = await browser.value(`(${link}.click(), Number(${link}.dataset.at))`);
  await drawn(browser);
  assert.ok(await browser.value("taxel.store.paused"));
  const shown = await browser.value("taxel.store.shown().head.frame.time_us");
  assert.ok(shown <= at && at - shown < 40_000, `${shown} of ${at}`);
  const newest = await browser.value(`Math.max(...[...document.querySelectorAll("#log a")].map((line) => line.dataset.at))`);
  assert.ok(newest <= at, `${newest} after ${at}`);
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
