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
  await browser.until("document.querySelector('.js-plotly-plot canvas')");
  await pauseAtTouch(browser, 7000);
  await browser.until("document.querySelector('.js-plotly-plot').data[0].z.some((kpa) => kpa > 0.5)");
  // What plotly.js was given is the image of this moment, in kPa.
  const given = await browser.value("document.querySelector('.js-plotly-plot').data[0].z");
  const { image, kpa } = await browser.value(`(async () => {
    const { pascalsOf } = await import("./units.js");
    return { image: [...taxel.store.shown().image], kpa: pascalsOf(taxel.store.garment) };
  })()`);
  assert.deepEqual(
    given,
    image.map((counts) => counts * kpa),
  );
  await browser.until("document.querySelector('.js-plotly-plot').data[1].z.length > 0");
  const marks = await browser.value("document.querySelector('.js-plotly-plot').data[1]");
  const id = await browser.value("taxel.store.shown().head.frame.contacts[0].id");
  assert.ok(marks.text.includes(String(id)), marks.text.join());
  await drawn(browser);
  const found = await colours(browser, "#view-surface");
  assert.ok(found.length > 200, `${found.length} colours`);
});

test("the body shows the back from behind", async () => {
  const { browser } = both;
  await show(browser, "body");
  await pauseAtTouch(browser, 7000);
  const seen = await screen(browser);
  const { left, top, width, height } = await box(browser, "#view-body canvas");
  const half = (side) => ({ left: left + (side * width) / 2, top, width: width / 2, height });
  // Colours of pressed taxels, exactly as the scale has them.
  const pressed = await browser.value(`(async () => {
    const { RAMP, stepOf } = await import("./colours.js");
    const { image } = taxel.store.shown();
    return [...new Set([...image].filter(Boolean).map((value) => RAMP[stepOf(value, taxel.settings.top)].join()))];
  })()`);
  assert.ok(pressed.length > 20, `${pressed.length} colours`);
  const touched = async (side) => {
    const found = new Set(await seen.colours(half(side)));
    return pressed.filter((rgb) => found.has(rgb)).length / pressed.length;
  };
  const [front, back] = [await touched(0), await touched(1)];
  assert.ok(back > 0.9 && front < 0.3, `${front} of the colours of pressed taxels in front, ${back} behind`);
});

test("the map shows the activations of the frame", async () => {
  const { browser } = both;
  await show(browser, "map");
  await drawn(browser);
  const { concepts, leading } = await browser.value("taxel.store.shown().head.frame.intent");
  assert.equal(leading, await browser.value("document.getElementById('leading').textContent"));
  const texts = await browser.value(
    "[...document.querySelectorAll('#view-map svg text')].map((text) => text.textContent)",
  );
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
  for (const view of ["panels", "surface", "body", "map", "health"]) {
    await show(browser, view);
    const size = await browser.value(`(async () => {
      const { picture } = await import("./save.js");
      const image = new Image();
      image.src = await picture(document.getElementById("view-${view}"));
      await image.decode();
      return [image.width, image.height, image.src.length, image.src.slice(0, 22)];
    })()`);
    assert.ok(
      size[0] > 600 && size[1] > 300 && size[2] > 5000 && size[3] === "data:image/png;base64,",
      `${view}: ${size}`,
    );
  }
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
