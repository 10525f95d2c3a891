// What presses on the robot: contacts, forces and links, by WebGL and by the canvas, for whoever uses no pointer, does not
// see the page, or holds a telephone.

import { test } from "node:test";
import assert from "node:assert/strict";
import { small, violations } from "./access.fixture.mjs";
import { Chromium } from "./chromium.mjs";
import { box, drawn, page, screen, show } from "./page.fixture.mjs";
import { arrows, cornerOf, OPTIONS, ROBOT } from "./robot.fixture.mjs";

const five = page("sim:five", { options: OPTIONS });

/** Pictures whose rate is printed. */
const PICTURES = 20;

/** Shows the robot with five contacts until it has been drawn so many times. */
async function pictures(t, browser, by) {
  await show(browser, "body", "contacts");
  await browser.until("!taxel.store.shown().head.frame.past && taxel.store.shown().head.frame.contacts.length === 5");
  const { painter, rate, images } = await browser.value(`(async () => {
    const robot = ${ROBOT};
    const [start, drawn, came] = [performance.now(), robot.pictures, taxel.store.count];
    while (robot.pictures < drawn + ${PICTURES}) await new Promise(requestAnimationFrame);
    const seconds = (performance.now() - start) / 1000;
    const rate = (robot.pictures - drawn) / seconds;
    return { painter: robot.painter.constructor.name, rate, images: (taxel.store.count - came) / seconds };
  })()`);
  t.diagnostic(
    `view: the robot with five contacts, by ${by}, ${rate.toFixed(1)} of ${images.toFixed(1)} images/s are drawn, ${PICTURES} in all`,
  );
  return painter;
}

test("five contacts have an arrow each, and the links the sum of their forces", async (t) => {
  const { browser } = five;
  assert.equal(await pictures(t, browser, "WebGL without a graphics card"), "GlPainter");
  await browser.until("taxel.store.shown().head.frame.contacts.length === 5 && (taxel.store.pause(true), true)");
  await browser.value("taxel.changed()");
  await browser.until(`[...${ROBOT}.names.children].some((name) => name.textContent.startsWith("torso "))`);
  assert.equal((await arrows(browser)).length, 5);
  const { pressing } = await browser.value("taxel.store.shown().head.frame");
  assert.equal(pressing.contacts.length, 5);
  const names = await browser.value(`[...${ROBOT}.names.children].map((name) => name.textContent)`);
  for (const { link } of pressing.links) assert.ok(names.some((name) => new RegExp(`^${link} [\\d.]+ N$`).test(name)), names.join());
  // What a figure shows needs no name.
  assert.deepEqual(names.filter((name) => name && !name.endsWith(" N")), []);
  await browser.value("taxel.store.pause(false)");
});

for (const [name, size] of Object.entries({
  light: {},
  dark: { dark: true },
  telephone: { width: 390, height: 844, mobile: true },
})) {
  test(`axe-core finds nothing on the robot: ${name}`, async () => {
    const { browser, view } = five;
    await browser.open(view.url, size);
    await show(browser, "body", "contacts");
    assert.deepEqual(await violations(browser), []);
    if (!size.mobile) return;
    assert.deepEqual(await small(browser), []);
    const stage = await box(browser, "#view-body .relief");
    assert.ok(stage.left >= 0 && stage.left + stage.width <= size.width && stage.height > 300, JSON.stringify(stage));
    // All of the robot is in it.
    const ends = await browser.value(`(() => {
      const { aspects: [{ seen }], stage } = ${ROBOT};
      const of = (axis) => [...seen].filter((_, at) => at % 3 === axis);
      const [x, y] = [of(0), of(1)];
      return Math.min(...x) >= 0 && Math.max(...x) <= stage.clientWidth && Math.min(...y) >= 0 && Math.max(...y) <= stage.clientHeight;
    })()`);
    assert.equal(ends, true);
    await browser.open(view.url);
  });
}

test("without WebGL the robot is seen from the front and from behind", async (t) => {
  const { browser, view } = five;
  // Two pictures at a time would be half as fast.
  await browser.visit("about:blank");
  const plain = await Chromium.start({ webgl: false });
  try {
    await plain.open(view.url);
    assert.equal(await pictures(t, plain, "the canvas without WebGL"), "FlatPainter");
    // The image that the page stands at is the newest, not the one that it has shown.
    const stands = "[taxel.store.shown().head.frame].every((at) => at.contacts.length === 5 && at.pressing?.contacts.length === 5)";
    await plain.until(`(taxel.store.pause(true), ${stands}) || (taxel.store.pause(false), false)`);
    await plain.value("taxel.changed()");
    await drawn(plain);
    assert.deepEqual(await violations(plain), []);
    assert.equal(await plain.value("document.querySelector('#view-body .relief').getAttribute('role')"), "img");
    // Each contact is shown once, on the side that it is on.
    await plain.until(`[...${ROBOT}.forces.children].filter((group) => group.getAttribute("display") !== "none").length === 5`);
    const { left, width } = await box(plain, "#view-body");
    for (const panel of ["chest", "back"]) {
      const taxel = await plain.value(`(() => {
        const { head, image } = taxel.store.shown();
        const { base, columns } = taxel.store.garment.panels.find(({ name }) => name === "${panel}");
        const { peak_row: row, peak_column: column } = head.frame.contacts.find((touch) => touch.panel_name === "${panel}");
        return base + row * columns + column;
      })()`);
      const side = panel === "chest" ? 0 : 1;
      const { x, y, facing } = await cornerOf(plain, taxel, side);
      assert.ok(facing > 0 && (side === 0 ? x < left + width / 2 : x > left + width / 2), `${panel} at ${x}`);
      const found = await (await screen(plain)).colours({ left: x - 8, top: y - 8, width: 16, height: 16 });
      assert.ok(found.length > 3, `${panel}: ${found.join(" ")}`);
    }
    assert.deepEqual(plain.complaints, []);
  } finally {
    await plain.stop();
    await browser.open(view.url);
  }
});

test("the robot can be saved as a picture, and a lost graphics card leaves it to the canvas", async () => {
  const { browser } = five;
  await show(browser, "body", "contacts");
  const size = await browser.value(`(async () => {
    const { picture } = await import("./save.js");
    const image = new Image();
    image.src = await picture(document.getElementById("view-body"));
    await image.decode();
    return [image.width, image.height, image.src.length];
  })()`);
  assert.ok(size[0] > 600 && size[1] > 300 && size[2] > 5000, `${size}`);
  await browser.value(`void ${ROBOT}.painter.gl.getExtension("WEBGL_lose_context").loseContext()`);
  await browser.until(`${ROBOT}.painter.constructor.name === "FlatPainter" && ${ROBOT}.aspects.length === 2`);
});

test("the page has complained of nothing", () => assert.deepEqual(five.browser.complaints, []));
