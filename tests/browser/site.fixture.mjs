// The site of `cargo xtask site` on a static server of its own, and its module without a browser.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { after, before } from "node:test";
import { Chromium } from "./chromium.mjs";

/** The folder of the site. */
export const SITE = process.env.TAXEL_SITE ?? new URL("../../target/site", import.meta.url).pathname;
const KINDS = { html: "text/html", css: "text/css", js: "text/javascript", wasm: "application/wasm" };

/** A board in the module of the site. */
export async function board() {
  const { Board } = await import(join(SITE, "board.js"));
  return Board.load(await WebAssembly.compile(await readFile(join(SITE, "taxel.wasm"))));
}

/** Serves the site below a folder of its own; `asked` lists the paths that were asked for. */
export async function serve() {
  const asked = [];
  const server = createServer(async ({ url }, response) => {
    const path = new URL(url, "http://site").pathname.replace(/^\/taxel\//, "") || "index.html";
    asked.push(path);
    try {
      const content = await readFile(join(SITE, path));
      response.writeHead(200, { "Content-Type": KINDS[path.split(".").at(-1)] ?? "text/plain" }).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  const stop = async () => {
    server.closeAllConnections();
    await new Promise((closed) => server.close(closed));
  };
  return { url: `http://127.0.0.1:${server.address().port}/taxel/`, asked, stop };
}

/** The site in a browser, filled before the first test runs. */
export function site(search = "") {
  const both = {};
  before(async () => {
    both.server = await serve();
    both.browser = await Chromium.start();
    await both.browser.open(both.server.url + search);
  });
  after(async () => {
    await both.browser?.stop();
    await both.server?.stop();
  });
  return both;
}
