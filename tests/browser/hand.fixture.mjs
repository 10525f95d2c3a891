// What a test presses on the page, and what the board feels of it.

import assert from "node:assert/strict";
import { box } from "./page.fixture.mjs";

/** Number of the back among the panels of the reference garment. */
export const BACK = 1;
/** Counts of a newton on a simulated board. */
export const NEWTON = 1000;
const [ROWS, COLUMNS] = [32, 16];

/** That a number is within so much of another. */
export const near = (value, wanted, within, what) =>
  assert.ok(Math.abs(value - wanted) <= within, `${what}: ${value}, not ${wanted}`);

/** The force of a contact, N. */
export const force = (touch) => touch.total / NEWTON;

/** Where a place of a panel is on the page, in the view of the panels. */
export async function onPanel(browser, panel, [x, y]) {
  const { left, top, width, height } = await box(browser, `#view-panels figure:nth-child(${panel + 1}) canvas`);
  return [left + ((x + 0.5) * width) / COLUMNS, top + ((y + 0.5) * height) / ROWS];
}

/** Where a place of a panel is on the page, in a view; in that of the garment, on its panels. */
export const inView = (browser, view, panel, at) =>
  browser.value(`taxel.views.${view === "garment" ? "panels" : view}.plot(taxel.store.garment.panels[${panel}])(${JSON.stringify(at)})`);

/** The contacts of the newest image. */
export const contacts = (browser) => browser.value("taxel.store.latest.head.frame.contacts");

/** Waits until something is true of the contacts, `touches`, of the newest image: those contacts. */
export async function felt(browser, condition, seconds) {
  const found = `(() => {
    const touches = taxel.store.latest?.head.frame.contacts ?? [];
    if (!(${condition})) return false;
    window.felt = touches;
    return true;
  })()`;
  await browser.until(found, seconds);
  return browser.value("window.felt");
}

/** Waits until nothing touches. */
export const rest = (browser) => felt(browser, "touches.length === 0");

/** The greatest newtons of a contact and its places while `act` goes on, by the board's images, oldest first. */
export async function watch(browser, act) {
  await browser.value(`(() => {
    window.seen = [];
    let last = taxel.store.count;
    const look = () => {
      for (; last < taxel.store.count; last += 1) {
        const { frame } = taxel.store.at(last).head;
        seen.push({ time: frame.time_us, leading: frame.intent.leading, contacts: frame.contacts });
      }
      window.looking = requestAnimationFrame(look);
    };
    look();
  })()`);
  await act();
  await felt(browser, "touches.length === 0 && seen.some(({ contacts }) => contacts.length)");
  return browser.value("(cancelAnimationFrame(looking), seen)");
}

/** Chooses a tool by its button. */
export const choose = (browser, tool) =>
  browser.value(`[...document.querySelectorAll("#tools button")].find((button) => button.textContent === "${tool}").click()`);

/**
 * Drags from one place of a panel to another in so many ms, and lifts. The pointer goes by the page's own frames, so that
 * it is as fast as wanted on a busy machine, too. Resolves to how long it took, ms.
 */
export async function drag(browser, panel, from, to, ms) {
  const [start, end] = [await onPanel(browser, panel, from), await onPanel(browser, panel, to)];
  await browser.pointer(...start);
  await browser.pointer(...start, "mousePressed");
  const took = await browser.value(`new Promise((resolve) => {
    const [start, end] = ${JSON.stringify([start, end])};
    let began = null;
    const step = (now) => {
      began ??= now;
      const share = Math.min(1, (now - began) / ${ms});
      const [clientX, clientY] = start.map((part, axis) => part + share * (end[axis] - part));
      dispatchEvent(new PointerEvent("pointermove", { pointerId: 1, pointerType: "mouse", clientX, clientY }));
      if (share < 1) requestAnimationFrame(step);
      else resolve(now - began);
    };
    requestAnimationFrame(step);
  })`);
  await browser.pointer(...end, "mouseReleased");
  return took;
}
