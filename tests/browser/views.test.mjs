// The other views: they show what is there, and are not blank.

import { test } from "node:test";
import assert from "node:assert/strict";
import { box, drawn, page, pauseAtTouch, screen, show } from "./page.fixture.mjs";

const both = page("sim:pat");

async function colours(browser, selector) {
  return (await (await screen(browser)).colours(await box(browser, selector))).map((text) =>
    text.split(",").map(Number),
  );
}

test("the surface stands where the pat is", async () => {
  const { browser } = both;
  await show(browser, "surface", "peaks");
  await pauseAtTouch(browser, 7000);
  // What stands there is the image of this moment, and the highest taxel of the contact has its id.
  const { heights, image, contact, text } = await browser.value(`(async () => {
    const { surface } = taxel.views;
    const { relief } = surface.relief;
    const { image, head } = taxel.store.shown();
    const [contact] = head.frame.contacts;
    const { panels } = taxel.store.garment;
    const taxel_ = panels[contact.panel].base + contact.peak_row * panels[contact.panel].columns + contact.peak_column;
    const scene = surface.scene(taxel.store, taxel.store.garment, taxel.store.shown(), taxel.settings);
    return {
      heights: [...image].map((_, taxel) => relief.data[3 * taxel]),
      image: [...image],
      contact,
      text: scene.peaks.find(({ taxel }) => taxel === taxel_)?.text,
    };
  })()`);
  const up = Math.max(...heights) / Math.max(...image);
  heights.forEach((height, taxel) => assert.ok(Math.abs(height - image[taxel] * up) < 1e-3, `taxel ${taxel}`));
  assert.equal(text, String(contact.id));
  const found = await colours(browser, "#view-surface");
  assert.ok(found.length > 200, `${found.length} colours`);
});

/** Where a taxel is seen, and the step of the ramp that it has there. */
const seenAt = (browser, taxel) =>
  browser.value(`(async () => {
    const { palette, stepOf } = await import("./colours.js");
    const { relief } = taxel.views.surface;
    const { left, top } = relief.stage.getBoundingClientRect();
    const [x, y] = relief.seen.slice(3 * ${taxel}, 3 * ${taxel} + 2);
    return { x: x + left, y: y + top, rgb: palette.ramp[stepOf(taxel.store.shown().image[${taxel}], taxel.settings.top)] };
  })()`);

test("a taxel of the surface has its colour, and is read by the pointer", async () => {
  const { browser } = both;
  await show(browser, "surface");
  // At rest, in the middle of the left arm.
  const taxel = 2 * 512 + 15 * 16 + 8;
  const { x, y, rgb } = await seenAt(browser, taxel);
  assert.deepEqual(await (await screen(browser)).at(x, y), rgb);
  await browser.pointer(x, y);
  await drawn(browser);
  assert.equal(await browser.value('document.querySelector("#hover b").textContent'), "left arm, row 15, column 8");
  await browser.pointer(2, 2);
  await drawn(browser);
  assert.equal(await browser.value("document.getElementById('hover').hidden"), true);
});

test("the surface is turned by pointer and keys, and comes back", async () => {
  const { browser } = both;
  await show(browser, "surface");
  const camera = () => browser.value("taxel.views.surface.relief.camera");
  const first = await camera();
  // Beside the garment: on it a pointer presses.
  const { left, top } = await box(browser, "#view-surface");
  await browser.pointer(left + 10, top + 10, "mousePressed");
  await browser.pointer(left + 70, top + 30);
  await browser.pointer(left + 70, top + 30, "mouseReleased");
  const dragged = await camera();
  assert.ok(dragged.turn < first.turn - 0.3 && dragged.tilt > first.tilt + 0.1, JSON.stringify(dragged));
  await browser.value("document.querySelector('.relief').focus()");
  for (const key of ["ArrowLeft", "ArrowUp", "PageUp"]) await browser.key(key);
  const moved = await camera();
  assert.ok(moved.turn > dragged.turn && moved.tilt < dragged.tilt && moved.zoom > 1.2, JSON.stringify(moved));
  // None of them were the page's: it would have stepped through the half minute.
  assert.equal(await browser.value("taxel.settings.view"), "surface");
  await browser.key("Home");
  assert.deepEqual(await camera(), first);
  await browser.value("document.activeElement.blur()");
});

test("without a body the panels stand by region, and say what is felt there", async () => {
  const { browser } = both;
  await show(browser, "body");
  await pauseAtTouch(browser, 7000);
  const regions = await browser.value(`[...document.querySelectorAll("#view-body li")].map((item) =>
    [item.querySelector("h2").textContent, item.querySelector("p").textContent])`);
  const { contacts, panels } = await browser.value(
    "({ contacts: taxel.store.shown().head.frame.contacts, panels: taxel.store.garment.panels })",
  );
  assert.deepEqual(
    regions.map(([name]) => name),
    [...new Set(panels.map(({ region }) => region))],
  );
  for (const [name, written] of regions) {
    const count = contacts.filter(({ region }) => region === name).length;
    const wanted = count === 0 ? /^no contact$/ : new RegExp(`^${count} contacts?, [\\d.]+ N, at most [\\d.]+ kPa$`);
    assert.match(written, wanted, name);
  }
  assert.ok(contacts.length > 0);
  // A touched panel has the colours of the scale.
  const [pressed] = contacts;
  const found = await colours(browser, `#view-body [aria-label="Pressure on the ${panels[pressed.panel].name}"]`);
  assert.ok(found.length > 10, `${found.length} colours`);
});

test("the map shows the activations of the frame", async () => {
  const { browser } = both;
  await show(browser, "map");
  await drawn(browser);
  const { concepts, leading } = await browser.value("taxel.store.shown().head.frame.intent");
  const meaning = await browser.value("document.getElementById('leading').textContent");
  if (leading !== "none") assert.equal(meaning, leading);
  const texts = await browser.value(
    "[...document.querySelectorAll('#view-map svg text')].map((text) => text.textContent)",
  );
  const sizes = await browser.value(
    "[...document.querySelectorAll('#view-map svg text')].map((text) => text.getBoundingClientRect().height)",
  );
  assert.ok(Math.min(...sizes) >= 11, `${Math.min(...sizes)} pixels`);
  const said = Object.fromEntries(texts.flatMap((text, at) => (at % 2 ? [] : [[text, texts[at + 1]]])));
  const wanted = Object.fromEntries(Object.entries(concepts).map(([name, value]) => [name, value.toFixed(2)]));
  assert.deepEqual(said, wanted);
  assert.equal(await browser.value("document.querySelectorAll('#view-map path[marker-end]').length > 10"), true);
});

test("bands and strips are filled", async () => {
  const { browser } = both;
  const found = await colours(browser, "#strips");
  assert.ok(found.length > 10, `${found.length} colours`);
  const bands = await browser.value(`(async () => {
    const { histogram } = await import("./ranges.js");
    const { image } = taxel.store.shown();
    return histogram(image, taxel.store.garment.low, taxel.settings.top);
  })()`);
  const pressed = await browser.value(
    "taxel.store.shown().image.filter((value) => value >= taxel.store.garment.low).length",
  );
  assert.equal(
    bands.reduce((a, b) => a + b),
    pressed,
  );
  assert.ok(pressed > 50);
});

test("every view can be saved as a picture", async () => {
  const { browser } = both;
  for (const view of ["garment", "surface", "body", "map", "health"]) {
    await show(browser, view);
    const size = await browser.value(`(async () => {
      const { picture } = await import("./save.js");
      const image = new Image();
      image.src = await picture(document.getElementById("view"));
      await image.decode();
      return [image.width, image.height, image.src.length, image.src.slice(0, 22)];
    })()`);
    assert.ok(
      size[0] > 600 && size[1] > 300 && size[2] > 5000 && size[3] === "data:image/png;base64,",
      `${view}: ${size}`,
    );
  }
});

test("a lost graphics card leaves the surface to the canvas", async () => {
  const { browser } = both;
  await show(browser, "surface");
  const painter = "taxel.views.surface.relief.painter";
  await browser.value(`void ${painter}.gl.getExtension("WEBGL_lose_context").loseContext()`);
  await browser.until(`${painter}.constructor.name === "FlatPainter"`);
  await drawn(browser);
  const found = await colours(browser, "#view-surface");
  assert.ok(found.length > 50, `${found.length} colours`);
});

test("light and dark, and a telephone, fit", async () => {
  const { browser, view } = both;
  const back = () => browser.value("getComputedStyle(document.body).backgroundColor");
  await browser.key("d");
  await drawn(browser);
  assert.equal(await back(), "rgb(14, 17, 22)");
  await browser.key("d");
  assert.equal(await back(), "rgb(243, 244, 246)");
  for (const [width, height] of [
    [1280, 800],
    [390, 844],
    [320, 640],
  ]) {
    await browser.open(view.url, { width, height, mobile: width < 600 });
    const wide = await browser.value("document.documentElement.scrollWidth");
    assert.ok(wide <= width, `${wide} of ${width} pixels`);
  }
  // Whoever listens instead of looking hears what each button does.
  const names = await browser.value(
    `[...document.querySelectorAll("button")].map((button) => button.ariaLabel ?? button.textContent)`,
  );
  assert.ok(names.length > 15 && names.every((name) => name.trim()), names.join());
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
