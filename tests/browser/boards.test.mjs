// The pages of a robot's boards.

import { mkdtemp, writeFile } from "node:fs/promises";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { Chromium } from "./chromium.mjs";
import { View } from "./program.mjs";
import { violations } from "./access.fixture.mjs";
import { drawn } from "./page.fixture.mjs";

/** A place where no board is: whoever connects is sent away. */
const nobody = createServer((stream) => stream.destroy());
let file;
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
  ].join("");
  file = join(await mkdtemp(join(tmpdir(), "taxel-boards-")), "robot.toml");
  await writeFile(file, robot);
  view = await View.start(file, "--requests", "-");
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

const SAID = 'document.getElementById("mind-said").textContent';

test("what touches mean to the robot is above the picture, and opened by the keyboard", async () => {
  await browser.until("taxel.store.states.robot_intent?.touches.length > 5");
  await drawn(browser);
  assert.match(await browser.value(SAID), /^(none|kindness|threat|attack)(; .+ -?\d\.\d\d)*$/);
  const bars = 'document.querySelectorAll("#mind-concepts li").length';
  assert.equal(await browser.value(bars), 0);
  await browser.value('document.querySelector("#mind summary").focus()');
  await browser.key(" ");
  await browser.until(`${bars} > 10`);
  const concepts = "Object.keys(taxel.store.states.robot_intent.concepts).length";
  assert.equal(await browser.value(bars), await browser.value(concepts));
  // Nobody has sent anything, and nothing is known of the joints.
  assert.match(await browser.value('document.getElementById("mind-defaults").textContent'), /vision/);
  const touches = '[...document.querySelectorAll("#mind-touches tbody tr")].map((row) => row.textContent)';
  // Touches come and go: those of the two boards need not be there in one moment.
  for (const board of ["hand", "torso"]) {
    await browser.until(`${touches}.some((text) => text.startsWith("${board} ") && text.includes("unsure"))`);
  }
  assert.deepEqual(await violations(browser), []);
  await browser.key(" ");
  await browser.until('!document.getElementById("mind-details").open');
});

test("what is reported reaches the robot of the page", async () => {
  view.send("host_input vision -1");
  await browser.until('!taxel.store.states.robot_intent.defaults.includes("vision")');
});

test("the page of a board is that of its garment, and grey while it is not live", async () => {
  await browser.open(`${view.url}boards/hand/`);
  await browser.until("taxel.store.garment?.taxels === 64 && taxel.store.latest");
  assert.equal(await browser.value('document.body.classList.contains("lost")'), false);
  await browser.visit(`${view.url}boards/foot/`);
  await browser.until('document.body.classList.contains("lost")');
  const grey = 'getComputedStyle(document.querySelector(".view:not([hidden])")).filter';
  assert.match(await browser.value(grey), /grayscale/);
  // The program is there: the page reports the other boards, and does not look disconnected.
  await new Promise((done) => setTimeout(done, 3500));
  assert.equal(await browser.value('document.getElementById("absence").hidden'), true);
  assert.equal(await browser.value("taxel.store.states.robot.boards[0].state"), "live");
});

test("a robot that is recorded is shown like one that is only watched", async () => {
  const recorded = await View.run(
    ...["record", file, "--output", join(dirname(file), "boards.mcap")],
    ...["--realtime", "--for", "30s", "--view"],
  );
  try {
    await browser.open(`${recorded.url}boards/torso/`);
    await browser.until("taxel.store.latest?.head.frame.contacts.length === 5");
    await browser.until('taxel.store.states.robot.boards[2].state === "absent"');
    await browser.until("taxel.store.states.robot_intent.leading");
  } finally {
    await recorded.stop();
  }
});
