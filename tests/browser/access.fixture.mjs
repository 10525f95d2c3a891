// What hinders whoever uses no pointer, does not see the page, or holds a telephone.

import { readFile } from "node:fs/promises";

const AXE = await readFile(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
/** What an element needs to be hit by a finger, pixels. */
const FINGER = 44;

/** What axe-core finds wrong. */
export async function violations(browser) {
  if (!(await browser.value("'axe' in window"))) await browser.value(`${AXE}; 1`);
  return browser.value(`axe.run().then(({ violations }) =>
    violations.map(({ id, nodes }) => id + ": " + nodes.map(({ html }) => html.slice(0, 100)).join(" and ")))`);
}

/** Controls that are smaller than a finger. */
export const small = (browser) =>
  browser.value(`[...document.querySelectorAll("button, select, input, a.button")]
    .filter((control) => control.checkVisibility())
    .map((control) => [control.id || control.textContent, control.getBoundingClientRect()])
    .filter(([, { width, height }]) => width < ${FINGER} || height < ${FINGER})
    .map(([name, { width, height }]) => name + " " + width + " x " + height)`);
