// One program and one browser for the tests of a file.

import { after, before } from "node:test";
import { Chromium } from "./chromium.mjs";
import { View } from "./program.mjs";

/** Both, filled before the first test runs. */
export function page(source, { search = "", options = [], ...size } = {}) {
  const both = {};
  before(async () => {
    both.view = await View.start("--source", source, ...options);
    both.browser = await Chromium.start();
    await both.browser.open(both.view.url + search, size);
  });
  after(async () => {
    await both.browser?.stop();
    await both.view?.stop();
  });
  return both;
}

/** Shows a view, with these layers and no others. */
export async function show(browser, view, ...layers) {
  await browser.value(`document.getElementById("tab-${view}").click()`);
  for (const layer of ["smooth", "contours", "contacts", "peaks", "folds", "glow", "held"]) {
    const id = JSON.stringify(`layer-${layer}`);
    const pressed = await browser.value(`document.getElementById(${id}).getAttribute("aria-pressed") === "true"`);
    if (pressed !== layers.includes(layer)) await browser.value(`document.getElementById(${id}).click()`);
  }
  await drawn(browser);
}

/** Waits until what has changed is drawn. */
export const drawn = (browser) =>
  browser.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");

/** Stands still while a touch presses with at least so many counts in all. */
export async function pauseAtTouch(browser, total) {
  const pressed = `taxel.store.latest?.head.frame.contacts.some((touch) => touch.total >= ${total})`;
  await browser.value("taxel.store.pause(false)");
  await browser.until(`${pressed} && (taxel.store.pause(true), true)`);
  await browser.value("taxel.changed()");
  await drawn(browser);
}

/** The colour in the middle of a taxel on the screen, as [red, green, blue]; the screen as it is shown. */
export async function screen(browser) {
  // The invitation to press lies over the picture until somebody does.
  await browser.value('void document.getElementById("invite")?.style.setProperty("visibility", "hidden")');
  const png = (await browser.picture()).toString("base64");
  await browser.value(`(async () => {
    const image = new Image();
    image.src = "data:image/png;base64,${png}";
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    window.seen = context.getImageData(0, 0, image.width, image.height);
  })()`);
  return {
    at: (x, y) =>
      browser.value(`[...seen.data.slice((${Math.floor(y)} * seen.width + ${Math.floor(x)}) * 4).slice(0, 3)]`),
    /** Colours within a rectangle, each once. */
    colours: ({ left, top, width, height }) =>
      browser.value(`(() => {
      const found = new Set();
      for (let y = ${Math.ceil(top)}; y < ${Math.floor(top + height)}; y += 1)
        for (let x = ${Math.ceil(left)}; x < ${Math.floor(left + width)}; x += 1)
          found.add(seen.data.slice((y * seen.width + x) * 4, (y * seen.width + x) * 4 + 3).join());
      return [...found];
    })()`),
  };
}

/** Where an element is. */
export const box = (browser, selector) =>
  browser.value(
    `(({ left, top, width, height }) => ({ left, top, width, height }))(document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect())`,
  );
