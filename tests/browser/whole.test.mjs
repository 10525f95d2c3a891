// The picture of a robot with the garments of all its boards.

import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { Chromium } from "./chromium.mjs";
import { load } from "./module.fixture.mjs";
import { drawn, show } from "./page.fixture.mjs";
import { View } from "./program.mjs";
import { ROBOT } from "./robot.fixture.mjs";

const { Whole } = await load("whole");

/** A board with one row of two taxels on a link. */
const part = (name, links, link, more = {}) => ({
  name,
  panels: [{ name: "mat", index: 0, base: 0, rows: 1, columns: 2, mm: [10, 10], known: true }],
  body: { type: "body", name, links, taxels: [[link, [0, 0, 0], [1, 0, 0]], null] },
  poses: null,
  image: [7, 9],
  pressing: null,
  folding: [],
  scale: { pressure: 1, force: 1 },
  ...more,
});
const CHAIN = [
  { name: "base", parent: null },
  { name: "arm", parent: 0 },
];

test("boards of one robot are one garment on its links", () => {
  const contact = { id: 3, link: "arm", at_m: [0, 0, 0], normal: [1, 0, 0], force_counts: [-4, 0, 0] };
  const poses = { base: { at_m: [0, 0, 0], turn: [0, 0, 0, 1] } };
  const scene = new Whole().scene([
    part("torso", CHAIN, 1, { folding: [1] }),
    part("hand", [CHAIN[0], { name: "palm", parent: 0 }, { name: "arm", parent: 0 }], 2, {
      poses,
      scale: { pressure: 2, force: 3 },
      pressing: { contacts: [contact], links: [{ link: "arm", pressed_counts: 4 }] },
      folding: [0],
    }),
    part("foot", [], 0, { body: null, image: null }),
  ]);
  assert.deepEqual(
    scene.body.links.map(({ name, parent }) => [name, parent]),
    [
      ["base", null],
      ["arm", 0],
      ["palm", 0],
    ],
  );
  assert.deepEqual(
    scene.body.taxels.map((place) => place && place[0]),
    [1, null, 1, null, null, null],
  );
  assert.deepEqual(
    scene.panels.map(({ name, base, index }) => [name, base, index]),
    [
      ["torso: mat", 0, 0],
      ["hand: mat", 2, 1],
      ["foot: mat", 4, 2],
    ],
  );
  assert.deepEqual([...scene.image], [7, 9, 14, 18, 0, 0]);
  assert.deepEqual([...scene.unknown], [0, 0, 0, 0, 1, 1]);
  assert.deepEqual(scene.folding, [1, 2]);
  assert.equal(scene.poses, poses);
  assert.deepEqual(scene.pressing.contacts, [{ ...contact, board: "hand", force_counts: [-12, 0, 0] }]);
  assert.deepEqual(scene.pressing.links, [{ link: "arm", pressed_counts: 12 }]);
});

test("places are joined anew only if they are others", () => {
  const whole = new Whole();
  const parts = [part("torso", CHAIN, 1), part("hand", CHAIN, 1)];
  const { body } = whole.scene(parts);
  assert.equal(whole.scene(parts.map((one) => ({ ...one, image: [1, 2] }))).body, body);
  assert.notEqual(whole.scene(parts.map((one) => ({ ...one, body: { ...one.body } }))).body, body);
});

let view;
let browser;

before(async () => {
  const board = (name, source, garment, body) =>
    `[[boards]]\nname = "${name}"\nsource = "${source}"\ngarment = "${garment}"\n${body ? `body = "${body}"\n` : ""}`;
  const folder = await mkdtemp(join(tmpdir(), "taxel-whole-"));
  const mat = [
    '[[patches]]\npanel = "mat"\nlink = "left_hand"\n',
    "on.plane = { at = [0.0, 0.0, -0.1], normal = [1, 0, 0], down = [0, 0, -1] }\n",
  ];
  await writeFile(join(folder, "palm.toml"), mat.join(""));
  const robot = [
    'name = "three"\nurdf = "reference"\n',
    board("torso", "sim:five", "reference", "reference"),
    board("hand", "sim:press", "block-4x16", "palm.toml"),
    board("bare", "sim:press", "block-4x16"),
  ];
  await writeFile(join(folder, "robot.toml"), robot.join(""));
  view = await View.start(join(folder, "robot.toml"), "--requests", "-");
  browser = await Chromium.start();
  await browser.open(view.url);
  await browser.until("taxel.store.states.robot && taxel.store.latest");
});
after(async () => {
  await browser?.stop();
  await view?.stop();
});

const LABELS = `[...${ROBOT}.forces.children].filter((group) => group.getAttribute("display") !== "none")
  .map((group) => group.children[2].textContent)`;

test("other boards are followed while the robot is looked at, and no longer", async () => {
  const followed = "[...taxel.views.body.others.boards.keys()]";
  await show(browser, "surface");
  await browser.until(`${followed}.length === 0`);
  await show(browser, "body", "contacts");
  await browser.until(`${followed}.length === 2`);
  await show(browser, "map");
  await browser.until(`${followed}.length === 0`);
});

test("the robot carries the garments of all boards, and contacts have their names", async () => {
  await show(browser, "body", "contacts");
  await browser.until(`${ROBOT}.cloth?.taxels.some((taxel) => taxel >= 2048)`);
  await browser.until(`${LABELS}.some((text) => text.startsWith("hand "))`);
  await browser.until(`${LABELS}.some((text) => text.startsWith("torso "))`);
  const corner = `${ROBOT}.cloth.taxels.findIndex((taxel) => taxel >= 2048)`;
  const link = `${ROBOT}.body.links[${ROBOT}.cloth.links[${corner}]].name`;
  assert.equal(await browser.value(link), "left_hand");
  assert.match(await browser.value(`${ROBOT}.note.textContent`), /No place on the robot: bare: mat\./);
});

test("the joints that are sent move it", async () => {
  const height = `${ROBOT}.standing.places[3 * ${ROBOT}.cloth.taxels.findIndex((taxel) => taxel >= 2048) + 2]`;
  const before = await browser.value(height);
  view.send('{"positions": {"left_shoulder_pitch": 1.5}}');
  await browser.until(`Math.abs(${height} - ${before}) > 50`);
});

test("a board that is lost is grey, and the others are not", async () => {
  const shares = await browser.value(`(async () => {
    const { robot } = taxel.store.states;
    const boards = robot.boards.map((board) => (board.name === "hand" ? { ...board, state: "lost" } : board));
    taxel.store.line({ ...robot, boards });
    taxel.views.body.draw(taxel.store, taxel.settings);
    const { cloth, data } = ${ROBOT};
    // The robot's own corners have no taxel.
    const isCloth = (taxel) => taxel !== 0xffffffff;
    const share = (isHand) =>
      [...cloth.taxels].flatMap((taxel, at) => (isCloth(taxel) && taxel >= 2048 === isHand ? [data[3 * at + 1]] : []));
    return [share(true), share(false)];
  })()`);
  const [hand, torso] = shares;
  assert.ok(hand.length >= 64 && hand.every((share) => share === -1), String(hand.slice(0, 9)));
  assert.ok(torso.length >= 2048 && torso.every((share) => share >= 0));
});

test("paused, the other boards stand still, too", async () => {
  await browser.value("taxel.store.pause(true)");
  await drawn(browser);
  const image = `(() => {
    const { body } = taxel.views;
    body.draw(taxel.store, taxel.settings);
    return [...${ROBOT}.data].filter((_, at) => at % 3 === 1 && ${ROBOT}.cloth.taxels[(at - 1) / 3] >= 2048).join();
  })()`;
  const then = await browser.value(image);
  const count = await browser.value('taxel.views.body.others.of("hand").count');
  await browser.until(`taxel.views.body.others.of("hand").count > ${count} + 20`);
  assert.equal(await browser.value(image), then);
  await browser.value("taxel.store.pause(false)");
});
