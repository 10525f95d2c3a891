// The page that needs no program: it has the program's messages, is pressed as the program's page, saves, and works
// without a network.

import { test } from "node:test";
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { gzipSync } from "node:zlib";
import { violations } from "./access.fixture.mjs";
import { BACK, NEWTON, felt, near, onPanel, rest } from "./hand.fixture.mjs";
import { show } from "./page.fixture.mjs";
import { SITE, board, site } from "./site.fixture.mjs";

const PROGRAM = process.env.TAXEL_PROGRAM ?? "taxel";
const MOST_BYTES = 4 << 20;
const run = promisify(execFile);
const both = site();

/** What the program says. */
const said = async (...words) => (await run(PROGRAM, words, { maxBuffer: 1 << 28 })).stdout;

test("each shipped script gives the program's lines, byte for byte", async () => {
  const names = JSON.parse(await said("config", "touches", "--json")).map(({ name }) => name);
  assert.ok(names.length >= 13, names.join());
  for (const name of names) {
    const [own, program] = [(await board()).lines(name), await said("live", "--json", "--source", `sim:${name}`)];
    assert.ok(program.length > 100_000 && own === program, `${name}: ${own.length} bytes, ${program.length}`);
  }
});

test("a script that is not there is refused in a sentence", async () => {
  const own = await board();
  assert.throws(() => own.lines("pit"), /no script of touches "?pit|pit/);
  assert.throws(() => own.open({ script: "pit" }), /pit/);
});

test("it is small", async (t) => {
  const files = await Promise.all((await readdir(SITE)).map((name) => readFile(join(SITE, name))));
  const bytes = files.reduce((sum, file) => sum + gzipSync(file, { level: 9 }).length, 0);
  t.diagnostic(`view: site ${Math.ceil(bytes / 1024)} KiB compressed`);
  assert.ok(bytes < MOST_BYTES, String(bytes));
});

test("a board in the page is felt where it is pressed", async () => {
  const { browser } = both;
  assert.match(await browser.value("document.getElementById('source').textContent"), /^SIMULATED/);
  await show(browser, "garment");
  const [x, y] = await onPanel(browser, BACK, [7.5, 11]);
  await browser.pointer(x, y);
  await browser.pointer(x, y, "mousePressed");
  const [touch] = await felt(browser, `touches[0]?.total > ${2.4 * NEWTON}`);
  await browser.pointer(x, y, "mouseReleased");
  assert.equal(touch.panel, BACK);
  near(touch.column, 7.5, 0.4, "x");
  near(touch.row, 11, 0.4, "y");
  await rest(browser);
});

test("a script of touches is played, and its meaning is reported", async () => {
  const { browser } = both;
  await browser.value('(document.getElementById("script").value = "lash", document.getElementById("play-script").click())');
  await browser.until("taxel.store.log.some(({ kind, said }) => kind === 'intention' && said.includes('attack'))");
});

test("a recording that it saves is whole, and what was pressed is a script", async () => {
  const { browser } = both;
  const saved = (name) => browser.value(`(async () => {
    const { worker } = await import("./channel.js");
    const bytes = await worker.file("${name}");
    return [...bytes].map((byte) => String.fromCharCode(byte)).join("");
  })()`);
  const folder = await mkdtemp(join(tmpdir(), "taxel-site-"));
  try {
    const file = join(folder, "saved.mcap");
    await writeFile(file, Buffer.from(await saved("recording.mcap"), "latin1"));
    const found = await said("info", file, "--check");
    assert.match(found, /contacts/);
    const script = join(folder, "touches.toml");
    await writeFile(script, Buffer.from(await saved("touches.toml"), "latin1"));
    const played = await said("live", "--json", "--source", `sim:${script}`);
    assert.match(played, /"type":"contacts"|"contacts":\[\{/);
  } finally {
    await rm(folder, { recursive: true });
  }
});

test("axe-core finds nothing", async () => assert.deepEqual(await violations(both.browser), []));

test("it asks for its own files alone, and for none once it is kept", async () => {
  const { browser, server } = both;
  await browser.value("navigator.serviceWorker.ready.then(() => true)");
  const names = await readdir(SITE);
  const foreign = server.asked.filter((path) => !names.includes(path));
  assert.deepEqual(foreign, []);
  await server.stop();
  await browser.open(`${server.url}?script=pat`);
  await browser.until("taxel.store.garment.label === 'sim:pat' && taxel.store.latest.head.frame.contacts.length > 0");
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
