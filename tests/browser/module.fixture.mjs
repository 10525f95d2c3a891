// Modules of the page without a browser.

import { readFile } from "node:fs/promises";

/** A module of the page that imports no other. */
export async function load(name) {
  const text = await readFile(new URL(`../../host/cli/src/view/page/${name}.js`, import.meta.url), "utf8");
  return import(`data:text/javascript,${encodeURIComponent(text)}`);
}
