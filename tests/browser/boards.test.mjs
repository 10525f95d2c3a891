// The pages of a robot's boards.

import { mkdtemp, writeFile } from "node:fs/promises";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { Chromium } from "./chromium.mjs";
import { View } from "./program.mjs";
import { drawn } from "./page.fixture.mjs";

/** A place where no board is: whoever connects is sent away. */
const nobody = createServer((stream) => stream.destroy());
let view;
let browser;

before(async () => {
  await new Promise((done) => nobody.listen(0, "127.0.0.1", done));
  const board = (name, source, garment) =>
    `[[boards]]\nname = "${name}"\nsource = "${source}"\ngarment = "${garment}"\n`;
  const robot = [
    'name = "three"\n',
    board("torso", "sim:five", "reference"),
    board("hand", "sim:press", "block-4x16"),
    board("foot", `tcp:127.0.0.1:${nobody.address().port}`, "block-4x16"),
    '[[seams]]\na = { board = "torso", panel = "left arm", side = "bottom" }\n',
    'b = { board = "hand", panel = "mat", side = "top" }\nlength = 16\n',
  ].join("");
  const file = join(await mkdtemp(join(tmpdir(), "taxel-boards-")), "robot.toml");
  await writeFile(file, robot);
  view = await View.robot(file);
  browser = await Chromium.start();
  await browser.open(view.url);
});
after(async () => {
  await browser?.stop();
  await view?.stop();
  nobody.close();
});

const links = () =>
  browser.value(`[...document.querySelectorAll("#boards a")].map((link) => ({
    text: link.textContent, to: link.getAttribute("href"), lost: link.classList.contains("lost"), title: link.title,
    shown: link.getAttribute("aria-current"), grey: getComputedStyle(link).filter }))`);

test("each board has a link, and one that is not there is grey and says why", async () => {
  await browser.until('taxel.store.states.robot?.boards[1].state === "live" && taxel.store.latest');
  await browser.until('document.querySelectorAll("#boards a").length === 3');
  await drawn(browser);
  const [torso, hand, foot] = await links();
  assert.deepEqual([torso.to, hand.to, foot.to], ["/boards/torso/", "/boards/hand/", "/boards/foot/"]);
  assert.deepEqual([torso.shown, hand.shown, foot.shown], ["page", null, null]);
  assert.deepEqual([torso.lost, hand.lost, foot.lost], [false, false, true]);
  assert.equal(torso.grey, "none");
  assert.equal(foot.grey, "grayscale(1)");
  assert.match(torso.title, /^\d+ contacts?$/);
  assert.match(foot.title, /^absent: /);
  assert.equal(foot.text, "footabsent");
});

test("contacts of the robot are on every page", async () => {
  const rows = '[...document.querySelectorAll("#robot-contacts tbody tr")].map((row) => row.textContent)';
  await browser.until(`${rows}.some((text) => text.includes("torso: left arm"))`);
  await browser.until(`${rows}.some((text) => text.includes("hand: mat"))`);
});

test("the page of a board is that of its garment, and grey while it is not live", async () => {
  await browser.open(`${view.url}boards/hand/`);
  await browser.until("taxel.store.garment?.taxels === 64 && taxel.store.latest");
  assert.equal(await browser.value('document.body.classList.contains("lost")'), false);
  await browser.visit(`${view.url}boards/foot/`);
  await browser.until('document.body.classList.contains("lost")');
  const grey = 'getComputedStyle(document.querySelector(".stage")).filter';
  assert.match(await browser.value(grey), /grayscale/);
  // The program is there: the page tells of the other boards, and does not look disconnected.
  await new Promise((done) => setTimeout(done, 3500));
  assert.equal(await browser.value('document.getElementById("absence").hidden'), true);
  assert.equal(await browser.value("taxel.store.states.robot.boards[0].state"), "live");
});
