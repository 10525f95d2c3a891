// Modules of the page without a browser.

import { readFile } from "node:fs/promises";

/** A module of the page. */
export const load = async (name) => import(await address(name));

/** Its text as an address, and so those of the modules that it imports. */
async function address(name) {
  let text = await readFile(new URL(`../../host/cli/src/view/page/${name}.js`, import.meta.url), "utf8");
  for (const [, other] of text.matchAll(/^import .* from "\.\/(.*)\.js";$/gm))
    text = text.replace(`"./${other}.js"`, JSON.stringify(await address(other)));
  return `data:text/javascript,${encodeURIComponent(text)}`;
}
