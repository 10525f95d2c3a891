// A simulated garment is pressed on the page: by mouse, fingers and keys, in each view that shows it.

import { afterEach, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import assert from "node:assert/strict";
import { BACK, choose, contacts, drag, felt, force, inView, near, NEWTON, onPanel, rest, watch } from "./hand.fixture.mjs";
import { box, page, show } from "./page.fixture.mjs";
import { OPTIONS } from "./robot.fixture.mjs";

const both = page("sim:idle", { options: OPTIONS });
// What failed while it pressed does not press on in the next test.
afterEach(async () => {
  await both.browser.value("dispatchEvent(new Event('blur'))");
  if (both.browser.pressed) await both.browser.pointer(2, 2, "mouseReleased");
});

test("the palm presses where the pointer is, with its force, for as long as it is down", async (t) => {
  const { browser } = both;
  await show(browser, "garment");
  await rest(browser);
  await choose(browser, "palm");
  const [x, y] = await onPanel(browser, BACK, [7.5, 11]);
  await browser.pointer(x, y);
  const began = Date.now();
  await browser.pointer(x, y, "mousePressed");
  await felt(browser, "touches.length === 1");
  t.diagnostic(`view: a press of the mouse is in the picture's data after ${Date.now() - began} ms`);
  const [touch] = await felt(browser, `touches[0]?.total > ${7 * NEWTON}`);
  assert.equal(touch.panel, BACK);
  near(touch.column, 7.5, 0.3, "x");
  near(touch.row, 11, 0.3, "y");
  // It has grown while the test was looking, but stands there in newtons.
  assert.match(await browser.value("document.querySelector('#tool-marks g:nth-child(2) text').textContent"), /^\d+(\.\d)? N$/);
  assert.equal(await browser.value("document.getElementById('hover').hidden"), true);
  // Whoever presses longer presses harder.
  const [later] = await felt(browser, `touches[0]?.total > ${14 * NEWTON}`);
  assert.equal(later.id, touch.id);
  await browser.pointer(x, y, "mouseReleased");
  await rest(browser);
  assert.equal(await browser.value("document.getElementById('invite').hidden"), true);
});

test("a pen presses as hard as it is pressed, however long", async () => {
  const { browser } = both;
  const [x, y] = await onPanel(browser, BACK, [7.5, 11]);
  const pen = (type, force) => {
    const pressed = { button: "left", buttons: 1, clickCount: 1, pointerType: "pen", force };
    return browser.send("Input.dispatchMouseEvent", { type, x, y, ...pressed });
  };
  await pen("mousePressed", 0.5);
  await felt(browser, "touches[0]?.duration_ms > 1000");
  near(force((await contacts(browser))[0]), 8, 1, "N");
  await pen("mouseMoved", 0.75);
  await felt(browser, `Math.abs(touches[0]?.total - ${12 * NEWTON}) < ${1.5 * NEWTON}`);
  await pen("mouseReleased", 0);
  await rest(browser);
});

test("short clicks are pats: kindness", async () => {
  const { browser } = both;
  const [x, y] = await onPanel(browser, BACK, [7.5, 11]);
  const seen = await watch(browser, async () => {
    for (let pat = 0; pat < 3; pat += 1) {
      await browser.pointer(x, y, "mousePressed");
      await browser.pointer(x, y, "mouseReleased");
      await sleep(270);
    }
  });
  const touched = seen.filter(({ contacts }) => contacts.length);
  assert.equal(new Set(touched.map(({ contacts: [touch] }) => touch.id)).size, 3);
  near(Math.max(...touched.map(({ contacts: [touch] }) => touch.peak_total)) / NEWTON, 8, 1.2, "N");
  await browser.until("taxel.store.marks.some(([, kind, said]) => kind === 'intention' && said.includes('kindness'))");
});

test("a drag is one touch that moves at the pointer's speed", async () => {
  const { browser } = both;
  const seen = await watch(browser, () => drag(browser, 2, [7.5, 6], [7.5, 26], 1000));
  const touched = seen.filter(({ contacts }) => contacts.length).map(({ contacts: [touch] }) => touch);
  assert.equal(new Set(touched.map(({ id }) => id)).size, 1);
  near(touched.at(-1).row - touched[0].row, 20, 1.5, "taxels");
  const speeds = touched.filter(({ duration_ms: ms }) => ms > 300 && ms < 900).map(({ rows_per_s: speed }) => speed);
  near(speeds.reduce((sum, speed) => sum + speed, 0) / speeds.length, 20, 4, "taxels/s");
  for (const touch of touched) assert.ok(force(touch) < 9.5, `${force(touch)} N`);
  // A stroke is kind, and nothing else.
  const meant = new Set(seen.map(({ leading }) => leading));
  meant.delete("none");
  assert.deepEqual([...meant], ["kindness"]);
});

test("from one panel to the next it is another touch", async () => {
  const { browser } = both;
  const [x, y] = await onPanel(browser, 0, [8, 15]);
  await browser.pointer(x, y, "mousePressed");
  await felt(browser, "touches.length === 1 && touches[0].panel === 0");
  await browser.pointer(...(await onPanel(browser, 1, [8, 15])));
  await felt(browser, "touches.length === 1 && touches[0].panel === 1");
  // Off the garment nothing presses.
  await browser.pointer(2, 2);
  await rest(browser);
  await browser.pointer(2, 2, "mouseReleased");
});

test("a flick of the strap is a lash: an attack", async () => {
  const { browser } = both;
  await choose(browser, "strap");
  // A busy machine draws a flick out: that is a stroke, and the hand tries again.
  let [seen, took, tries] = [[], Infinity, 0];
  for (; took > 75; tries += 1) {
    assert.ok(tries < 20, `the last flick took ${took} ms`);
    seen = await watch(browser, async () => (took = await drag(browser, BACK, [7.5, 8], [7.5, 22], 50)));
  }
  const greatest = Math.max(...seen.flatMap(({ contacts }) => contacts.map(({ peak_total: total }) => total)));
  // Three times a rested strap. `pure.test.mjs` has the law itself.
  assert.ok(greatest > 25 * NEWTON, `${greatest / NEWTON} N`);
  await browser.until("taxel.store.marks.some(([, kind, said]) => kind === 'intention' && said.includes('attack'))");
});

test("several fingers are several touches, and do not scroll the page", async () => {
  const { browser } = both;
  await choose(browser, "fingertip");
  const wanted = [[0, [4, 6]], [0, [12, 24]], [1, [8, 16]]];
  const places = await Promise.all(wanted.map(([panel, at]) => onPanel(browser, panel, at)));
  for (const count of [1, 2, 3]) await browser.fingers("touchStart", places.slice(0, count));
  const touches = await felt(browser, `touches.length === 3 && touches.every(({ total }) => total > ${2.4 * NEWTON})`);
  const [first] = touches.filter(({ panel }) => panel === 0).sort((a, b) => a.row - b.row);
  near(first.column, 4, 0.4, "x");
  near(first.row, 6, 0.4, "y");
  await browser.fingers("touchMove", [...places.slice(0, 2), await onPanel(browser, 1, [8, 20])]);
  await felt(browser, "touches.some(({ panel, row }) => panel === 1 && Math.abs(row - 20) < 0.5)");
  await browser.fingers("touchEnd", []);
  await rest(browser);
});

test("both arms around it are no attack", async () => {
  const { browser } = both;
  await browser.until("taxel.store.latest.head.frame.intent.leading === 'none'");
  await choose(browser, "forearm");
  const places = await Promise.all([0, BACK].map((panel) => onPanel(browser, panel, [7.5, 14])));
  for (const count of [1, 2]) await browser.fingers("touchStart", places.slice(0, count));
  // Whoever holds on presses harder and harder, up to 300 N, which is no embrace any more.
  await felt(browser, `touches.reduce((sum, { total }) => sum + total, 0) > ${30 * NEWTON}`);
  const { concepts } = await browser.value("taxel.store.latest.head.frame.intent");
  assert.ok(concepts.attack < 0.1, JSON.stringify(concepts));
  await browser.fingers("touchEnd", []);
  await rest(browser);
  await choose(browser, "fingertip");
});

test("the keys choose a taxel and press it, and space does not pause meanwhile", async () => {
  const { browser } = both;
  await browser.value('document.querySelector("#view-panels figure:nth-child(2) canvas").focus()');
  for (const key of ["ArrowUp", "ArrowLeft"]) await browser.key(key);
  await browser.keyEvent("keyDown", " ");
  const [touch] = await felt(browser, `touches[0]?.total > ${2.4 * NEWTON}`);
  assert.equal(touch.panel, BACK);
  near(touch.column, 7, 0.4, "x");
  near(touch.row, 15, 0.4, "y");
  await browser.key("ArrowDown");
  await felt(browser, "Math.abs(touches[0]?.row - 16) < 0.4");
  assert.equal(await browser.value("taxel.store.paused"), false);
  await browser.keyEvent("keyUp", " ");
  await rest(browser);
  // Tools and forces are those of the keys, too, and what they have become is spoken.
  for (const key of ["]", "]", "."]) await browser.key(key);
  await browser.until("document.getElementById('spoken').textContent === 'palm, 9.2 N, 0 degrees'");
  for (const key of [",", "[", "["]) await browser.key(key);
  await browser.key("Escape");
  await browser.value("document.activeElement.blur()");
  await browser.key(" ");
  assert.equal(await browser.value("taxel.store.paused"), true, "elsewhere it pauses");
  await browser.key(" ");
});

for (const [view, panel, at] of [
  ["surface", 2, [8.25, 15.5]],
  ["body", 0, [8.25, 15.5]],
]) {
  test(`in the view ${view} what begins on the garment presses, and what begins beside it turns`, async () => {
    const { browser } = both;
    await show(browser, view);
    await choose(browser, "fingertip");
    const scene = view === "surface" ? "taxel.views.surface.relief" : "taxel.views.body.onRobot";
    const turn = () => browser.value(`${scene}.orbit.camera.turn`);
    const before = await turn();
    const [x, y] = await inView(browser, view, panel, at);
    await browser.pointer(x, y);
    await browser.pointer(x, y, "mousePressed");
    const [touch] = await felt(browser, `touches[0]?.total > ${2.4 * NEWTON}`);
    assert.equal(touch.panel, panel);
    near(touch.column, at[0], 0.6, "x");
    near(touch.row, at[1], 0.6, "y");
    assert.match(await browser.value("document.querySelector('#tool-marks text').textContent"), /^\d\.\d N$/);
    await browser.pointer(x + 4, y + 4);
    await browser.pointer(x + 4, y + 4, "mouseReleased");
    await rest(browser);
    assert.equal(await turn(), before);
    const { left, top } = await box(browser, `#view-${view}`);
    await browser.pointer(left + 8, top + 8, "mousePressed");
    await browser.pointer(left + 60, top + 8);
    await browser.pointer(left + 60, top + 8, "mouseReleased");
    assert.ok((await turn()) < before - 0.2);
    assert.deepEqual(await contacts(browser), []);
  });
}

test("while the picture stands still nothing is pressed", async () => {
  const { browser } = both;
  await show(browser, "garment");
  await browser.value("(taxel.store.pause(true), taxel.changed())");
  const [x, y] = await onPanel(browser, BACK, [7.5, 11]);
  for (const type of ["mousePressed", "mouseReleased"]) await browser.pointer(x, y, type);
  await sleep(300);
  assert.deepEqual(await contacts(browser), []);
  await browser.value("taxel.store.pause(false)");
});

test("a finger beside the garment scrolls a telephone's page, one on it does not", async () => {
  const { browser, view } = both;
  await browser.open(view.url, { width: 390, height: 844, mobile: true });
  await show(browser, "garment");
  await choose(browser, "fingertip");
  const top = () => browser.value("Math.round(scrollY)");
  const swipe = async ([x, y]) => {
    await browser.fingers("touchStart", [[x, y]]);
    for (let way = 20; way <= 120; way += 20) await browser.fingers("touchMove", [[x, y - way]]);
    await browser.fingers("touchEnd", []);
  };
  await browser.value("document.querySelector('#view-panels').scrollIntoView({ block: 'center' })");
  const before = await top();
  await swipe(await onPanel(browser, 0, [8, 25]));
  // What is felt may take another line above: that is less than a swipe.
  assert.ok((await top()) < before + 60, `${before} to ${await top()}`);
  await rest(browser);
  const still = await top();
  const { left, width, top: above } = await box(browser, "#view-panels");
  await swipe([left + width / 2, above - 10]);
  await browser.until(`Math.round(scrollY) > ${still + 60}`);
  await browser.open(view.url);
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
