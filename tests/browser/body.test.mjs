// The robot's body: cloth stands where the links are, and goes along with the robot.

import { test } from "node:test";
import assert from "node:assert/strict";
import { drawn, page, pauseAtTouch, screen, show } from "./page.fixture.mjs";
import { arrows, cornerOf, OPTIONS, ROBOT } from "./robot.fixture.mjs";

const both = page("sim:pat", { options: [...OPTIONS, "--joint-states", "-"] });

/** The taxel of the greatest pressure. */
const PRESSED = "taxel.store.shown().image.reduce((best, value, at, image) => (value > image[best] ? at : best), 0)";

test("a pat on the back is seen from behind, in the colours of the scale", async () => {
  const { browser } = both;
  await show(browser, "body", "contacts");
  await pauseAtTouch(browser, 7000);
  assert.equal(await browser.value(`${ROBOT}.painter.constructor.name`), "GlPainter");
  const taxel = await browser.value(PRESSED);
  assert.ok((await cornerOf(browser, taxel)).facing < 0);
  await browser.value("document.querySelector('#view-body .relief').focus()");
  for (let turn = 0; turn < 30; turn += 1) await browser.key("ArrowRight");
  await drawn(browser);
  const { x, y, facing } = await cornerOf(browser, taxel);
  assert.ok(facing > 0.7, `${facing}`);
  // The arrow ends where the contact is: within two taxels of its greatest pressure.
  const [arrow, ...others] = await arrows(browser);
  assert.equal(others.length, 0);
  assert.ok(Math.hypot(arrow.x - x, arrow.y - y) < 25, `${JSON.stringify(arrow)} at ${x}, ${y}`);
  const { id } = await browser.value("taxel.store.shown().head.frame.contacts[0]");
  assert.match(arrow.text, new RegExp(`^${id} · [\\d.]+ N$`));
  await show(browser, "body");
  const colourOf = (taxel) =>
    browser.value(`(async () => {
      const { palette, stepOf } = await import("./colours.js");
      return palette.ramp[stepOf(taxel.store.shown().image[${taxel}], taxel.settings.top)];
    })()`);
  const seen = await screen(browser);
  // Between two taxels the colour goes from that of one to that of the other: a pixel beside the place is a little off.
  const [got, wanted] = [await seen.at(x, y), await colourOf(taxel)];
  assert.ok(Math.hypot(...got.map((part, channel) => part - wanted[channel])) < 60, `${got} instead of ${wanted}`);
  // At rest, exactly: row 30, column 8 of the back.
  const rest = await cornerOf(browser, 512 + 30 * 16 + 8);
  assert.ok(rest.facing > 0.7, `${rest.facing}`);
  assert.deepEqual(await seen.at(rest.x, rest.y), await colourOf(512 + 30 * 16 + 8));
  assert.deepEqual(await arrows(browser), []);
});

test("the taxel under the pointer is read, and the camera comes home", async () => {
  const { browser } = both;
  const taxel = await browser.value(PRESSED);
  const { x, y } = await cornerOf(browser, taxel);
  await browser.pointer(x, y);
  await drawn(browser);
  const { panels } = await browser.value("taxel.store.garment");
  const { name, base, columns } = panels.find(({ base, rows, columns }) => taxel < base + rows * columns);
  assert.equal(
    await browser.value('document.querySelector("#hover b").textContent'),
    `${name}, row ${Math.floor((taxel - base) / columns)}, column ${(taxel - base) % columns}`,
  );
  assert.equal(await browser.value(`${ROBOT}.ring.getAttribute("display")`), "inline");
  await browser.pointer(2, 2);
  const camera = () => browser.value(`${ROBOT}.orbit.camera`);
  const turned = await camera();
  await browser.key("ArrowDown");
  for (let step = 0; step < 30; step += 1) await browser.key("ArrowUp");
  // From below, too: a robot has no floor.
  assert.ok((await camera()).tilt < -1);
  await browser.key("Home");
  assert.ok((await camera()).turn < 1 && turned.turn < 0);
  assert.equal(await browser.value("taxel.settings.view"), "body");
  await browser.value("document.activeElement.blur()");
});

test("the robot goes along with its joints, without another image", async () => {
  const { browser, view } = both;
  await show(browser, "body");
  await browser.value("taxel.store.pause(false)");
  const links = () => browser.value("taxel.store.states.poses.links");
  // From the robot's root, mm of the scene.
  const origin = (name) =>
    browser.value(`(() => {
      const { body, standing } = ${ROBOT};
      const [base, link] = [standing.origins[0], standing.origins[body.links.findIndex(({ name }) => name === "${name}")]];
      return link.map((part, axis) => part - base[axis]);
    })()`);
  const [still, rest] = [await links(), await origin("left_hand")];
  view.send('{"positions": {"waist": 1.0471975511965976}}');
  await browser.until("taxel.store.states.poses.links.torso.turn[2] > 0.49");
  await browser.until(`${ROBOT}.poses === taxel.store.states.poses.links`);
  // About the vertical: the left (x) goes back (y) by the sine.
  const moved = await origin("left_hand");
  const wanted = [rest[0] / 2 + rest[1] * Math.sqrt(0.75), rest[1] / 2 - rest[0] * Math.sqrt(0.75), rest[2]];
  moved.forEach((part, axis) => assert.ok(Math.abs(part - wanted[axis]) < 0.1, `${rest} to ${moved}, not ${wanted}`));
  assert.deepEqual((await links()).base_link, still.base_link);
  view.send('{"positions": {"waist": 0}}');
  await browser.until("taxel.store.states.poses.links.torso.turn[2] === 0");
});

test("an image keeps the posture in which it was taken", async () => {
  const { browser, view } = both;
  // The links stand straight again before the images do: one that is under way is of the posture before.
  await browser.until("taxel.store.shown().head.poses.links.torso.turn[2] === 0");
  await pauseAtTouch(browser, 1000);
  const turn = () => browser.value(`taxel.views.body.parts(taxel.store, taxel.store.garment, taxel.store.shown(),
    taxel.settings)[0].poses.torso.turn[2]`);
  assert.equal(await turn(), 0);
  view.send('{"positions": {"waist": 0.5235987755982988}}');
  await browser.until("taxel.store.states.poses.links.torso.turn[2] > 0.2");
  assert.equal(await turn(), 0);
  await browser.value("taxel.store.pause(false)");
  await browser.until("taxel.store.shown().head.poses.links.torso.turn[2] > 0.2");
  assert.ok((await turn()) > 0.2);
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
