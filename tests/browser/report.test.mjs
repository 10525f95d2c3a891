// The page of `taxel report`: its surface is that of `taxel view`, and a touch has one colour wherever it is shown.

import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";
import { violations } from "./access.fixture.mjs";
import { box, drawn, page, screen } from "./page.fixture.mjs";

const run = promisify(execFile);
const PROGRAM = process.env.TAXEL_PROGRAM ?? "taxel";
// The page in which the other two are compared with it.
const both = page("sim:pat");
let [folder, report] = ["", ""];

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "taxel-report-"));
  report = join(folder, "pat.html");
  await run(PROGRAM, ["report", "--source", "sim:pat", "-o", report]);
});
after(() => rm(folder, { recursive: true }));

const visit = (size) => both.browser.visit(pathToFileURL(report).href, size);

for (const [name, size] of Object.entries({
  light: {},
  dark: { dark: true },
  telephone: { width: 390, height: 844, mobile: true },
})) {
  test(`axe-core finds nothing on a report: ${name}`, async () => {
    const { browser } = both;
    await visit(size);
    await drawn(browser);
    assert.deepEqual(await violations(browser), []);
    const wide = await browser.value("document.documentElement.scrollWidth");
    assert.ok(wide <= (size.width ?? 1280), `${wide} pixels`);
  });
}

test("a report has the surface of the page, which turns and is read", async () => {
  const { browser } = both;
  await visit({});
  await browser.value('document.getElementById("surface").scrollIntoView()');
  await drawn(browser);
  const first = await screen(browser);
  const place = await box(browser, "#surface");
  const before = await first.colours(place);
  assert.ok(before.length > 200, `${before.length} colours`);
  const marks = await browser.value(`[...document.querySelectorAll(".marks b")].map((mark) => mark.textContent)`);
  const { peaks } = await browser.value('JSON.parse(document.getElementById("data").textContent)');
  assert.deepEqual(
    marks,
    peaks.map(({ text }) => text),
  );
  const where = () => browser.value('document.querySelector(".marks b").style.transform');
  const still = await where();
  await browser.value('document.querySelector(".relief").focus()');
  await browser.key("ArrowLeft");
  await drawn(browser);
  assert.notEqual(await where(), still);
  await browser.key("Home");
  await drawn(browser);
  assert.equal(await where(), still);
  // Just below the peak.
  const mark = await box(browser, ".marks b");
  await browser.pointer(mark.left + mark.width / 2, mark.top + 28);
  await browser.until(`/, row \\d+, column \\d+: [\\d.]+ N$/.test(document.getElementById("pointed").textContent)`);
});

test("a report shows the garment on its robot, which turns and is read", async () => {
  const { browser } = both;
  const file = join(folder, "five.html");
  await run(PROGRAM, ["report", "--source", "sim:five", "--body", "reference", "--robot", "reference", "-o", file]);
  await browser.visit(pathToFileURL(file).href, {});
  await browser.value('document.getElementById("robot").scrollIntoView()');
  await browser.until("document.querySelectorAll('#robot svg g g').length === 5");
  assert.deepEqual(await violations(browser), []);
  const written = () => browser.value("[...document.querySelectorAll('#robot svg g g text')].map((text) => text.textContent)");
  for (const text of await written()) assert.match(text, /^\d+ · [\d.]+ N$/);
  const found = await (await screen(browser)).colours(await box(browser, "#robot"));
  assert.ok(found.length > 50, `${found.length} colours`);
  const bones = () => browser.value("document.querySelector('#robot svg path').getAttribute('d')");
  const still = await bones();
  await browser.value('document.querySelector("#robot .relief").focus()');
  await browser.key("ArrowLeft");
  await browser.until(`document.querySelector('#robot svg path').getAttribute('d') !== ${JSON.stringify(still)}`);
  await browser.key("Home");
  await browser.until(`document.querySelector('#robot svg path').getAttribute('d') === ${JSON.stringify(still)}`);
  // Where the torso's name stands, there is cloth above.
  const names = "[...document.querySelectorAll('#robot svg g text')].find((text) => text.textContent.startsWith('torso'))";
  const { left, top, width } = await browser.value(
    `(({ left, top, width }) => ({ left, top, width }))(${names}.getBoundingClientRect())`,
  );
  await browser.pointer(left + width / 2, top - 20);
  await browser.until(`/^(chest|back), row \\d+, column \\d+: [\\d.]+ N$/.test(document.getElementById("pointed-robot").textContent)`);
});

test("page and report show a touch in one palette on one scale", async () => {
  const { browser, view } = both;
  const html = await readFile(report, "utf8");
  const { image, top, panels } = JSON.parse(/id="data">(.*?)<\/script>/s.exec(html)[1]);
  await browser.open(view.url);
  // The page's colours of the report's image.
  const wanted = await browser.value(`(async () => {
    const { css } = await import("./colours.js");
    const hex = (text) => "#" + text.match(/\\d+/g).map((part) => Number(part).toString(16).padStart(2, "0")).join("");
    const share = (value) => Math.min(1, value / ${top});
    return ${JSON.stringify(image)}.map((value) => hex(css(share(value))));
  })()`);
  // Report: the cells of the panels, in the order of the taxels that are pressed.
  const drawnIn = html.split("<h2>Pressure, 3-D</h2>")[0];
  const cells = [...drawnIn.matchAll(/width="11\.2" height="[\d.]+" fill="(#\w{6})"/g)].map(([, fill]) => fill);
  assert.ok(cells.length > 50 && panels.length === 4, `${cells.length} cells`);
  assert.deepEqual(
    cells,
    wanted.filter((_, taxel) => image[taxel] > 0),
  );
});

test("nothing has been complained of", () => assert.deepEqual(both.browser.complaints, []));
