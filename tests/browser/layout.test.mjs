// Nothing on the page lies over anything else, whatever is opened: above all over the timeline and its buttons.

import { execFile } from "node:child_process";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import assert from "node:assert/strict";
import { Chromium } from "./chromium.mjs";
import { covered } from "./layout.fixture.mjs";
import { drawn } from "./page.fixture.mjs";
import { View } from "./program.mjs";

const SIZES = [
  { width: 1440, height: 900 },
  { width: 1280, height: 720 },
];
let folder;
let robot;
let recorded;
let browser;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "taxel-layout-"));
  const board = (name, source, garment) =>
    `[[boards]]\nname = "${name}"\nsource = "${source}"\ngarment = "${garment}"\n`;
  const boards = board("torso", "sim:five", "reference") + board("hand", "sim:press", "block-4x16");
  const [file, recording] = ["robot.toml", "five.mcap"].map((name) => join(folder, name));
  await writeFile(file, `name = "two"\nurdf = "reference"\n${boards}`);
  await promisify(execFile)(process.env.TAXEL_PROGRAM, ["record", "--source", "sim:five", "--for", "3s", "-o", recording]);
  // One after the other: what has started is stopped even if the next one fails.
  robot = await View.start(file);
  recorded = await View.start("--source", `replay:${recording}`);
  browser = await Chromium.start();
});
after(async () => {
  await browser?.stop();
  await Promise.all([robot?.stop(), recorded?.stop()]);
  await rm(folder, { recursive: true });
});

/** Looks at every view, with everything shut and with everything open. */
async function look(name) {
  for (const open of [false, true]) {
    await browser.value(`document.getElementById("mind-details").open = ${open}`);
    const isShut = 'document.getElementById("savings").hidden';
    if ((await browser.value(isShut)) === open) await browser.value('document.getElementById("save").click()');
    for (const view of ["garment", "surface", "body", "map", "health"]) {
      await browser.value(`document.getElementById("tab-${view}").click()`);
      await drawn(browser);
      assert.deepEqual(await covered(browser), [], `${name}, ${view}, ${open ? "open" : "shut"}`);
    }
  }
}

for (const size of SIZES) {
  const { width, height } = size;
  test(`on ${width} x ${height} a robot that is watched shows all of its timeline`, async () => {
    await browser.open(robot.url, size);
    await browser.until("taxel.store.states.robot_intent?.touches.length");
    await look("live");
  });

  test(`on ${width} x ${height} so does one that is recorded`, async () => {
    const lines = await browser.value("[taxel.store.states.robot, taxel.store.states.robot_intent]");
    await browser.open(recorded.url, size);
    await browser.until("taxel.store.states.overview");
    await browser.value(`${JSON.stringify(lines)}.forEach((line) => taxel.store.line(line)), taxel.changed()`);
    await browser.until('!document.getElementById("mind").hidden && !document.getElementById("boards").hidden');
    await look("recorded");
  });
}
