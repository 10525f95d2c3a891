// The stream at full speed: no memory and no queue grows, and whoever does not read holds up nobody.

import { test } from "node:test";
import assert from "node:assert/strict";
import { connect } from "node:net";
import { setTimeout as sleep } from "node:timers/promises";
import { Chromium } from "./chromium.mjs";
import { box, page, screen, show } from "./page.fixture.mjs";

// Seconds that are watched. The first have passed when everything that is kept for a while is full; in the last the
// host gives up the pages that do not read, and sends a recording again.
const [KEPT, BEFORE, WATCHED] = process.env.TAXEL_CAMPAIGN ? [30, 35, 600] : [5, 6, 13];
const MB = 1 << 20;
const both = page("sim:five", { search: `?keep=${KEPT}` });

/** What there is now; the page's memory without what is waiting to be collected. */
async function state() {
  const { browser, view } = both;
  await browser.send("HeapProfiler.collectGarbage");
  const { usedSize, embedderHeapUsedSize, backingStorageSize } = await browser.send("Runtime.getHeapUsage");
  const recording = await (await fetch(`${view.url}recording.mcap`)).arrayBuffer();
  const link = await browser.value("taxel.store.states.link");
  const head = await browser.value("taxel.store.latest.head");
  const count = await browser.value("taxel.store.count");
  return {
    heap: usedSize + embedderHeapUsedSize + backingStorageSize,
    host: await view.memory(),
    kept: recording.byteLength,
    link,
    head,
    count,
  };
}

test("nothing grows at 195 frames a second, while three pages do not read", async (t) => {
  const { browser, view } = both;
  // Fetching the recording takes memory once.
  await state();
  await sleep(BEFORE * 1000);
  const before = await state();
  const sockets = await Promise.all(Array.from({ length: 3 }, () => dead(view)));
  await browser.until("taxel.store.states.link.pages === 4");
  await sleep(WATCHED * 1000);
  const after = await state();
  sockets.forEach((socket) => socket.destroy());
  const frames = after.link.frames - before.link.frames;
  const seconds = (after.head.frame.time_us - before.head.frame.time_us) / 1e6;
  const images = after.count - before.count;
  const replaced = after.head.replaced - before.head.replaced;
  t.diagnostic(
    `view: ${((after.head.frame.frame - before.head.frame.frame) / seconds).toFixed(1)} frames/s of the board, ${(images / seconds).toFixed(1)} images/s to the page over ${seconds.toFixed(0)} s`,
  );
  const mb = (bytes) => (bytes / MB).toFixed(1);
  t.diagnostic(
    `view: memory of the page ${mb(before.heap)} to ${mb(after.heap)} MB, of the host ${mb(before.host)} to ${mb(after.host)} MB (its recording ${mb(before.kept)} to ${mb(after.kept)} MB)`,
  );
  t.diagnostic(
    `view: ${images} images shown and ${replaced} replaced by newer ones, of ${frames} frames; beside 3 pages that do not read`,
  );
  assert.equal(after.link.lost, 0);
  assert.equal(after.head.missed, 0);
  // Each frame was shown or replaced: what is neither is under way, and does not get more. A quarter of a second lies between
  // two counts of the link.
  const waiting = Math.abs(frames - images - replaced);
  assert.ok(waiting < 250, `${waiting} of ${frames} frames wait`);
  assert.ok(after.heap - before.heap < 4 * MB, `the page grew by ${mb(after.heap - before.heap)} MB`);
  // What is kept lies in pieces with some room, and each page that does not read has an image that waits.
  const grown = after.host - before.host - 2 * Math.max(0, after.kept - before.kept);
  assert.ok(grown < 8 * MB, `the host grew by ${mb(grown)} MB besides what it keeps`);
  // Their writers stood still until their time was over, which held up nobody.
  await browser.until("taxel.store.states.link.pages === 1");
});

/** A page that asks for everything and reads nothing. */
async function dead({ port }) {
  const socket = connect(port, "127.0.0.1");
  await new Promise((done, fail) => socket.once("connect", done).once("error", fail));
  socket.on("error", () => {});
  socket.pause();
  socket.write(
    `GET /socket HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n` +
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n",
  );
  return socket;
}

/** Pictures of the surface that are waited for: their rate is printed. */
const PICTURES = process.env.TAXEL_CAMPAIGN ? 90 : 20;

/** Shows the surface until it has been drawn so many times: what drew it, and where the panels lie. */
async function pictures(t, browser, by) {
  await show(browser, "surface", "peaks");
  // The images from before the page was opened have come.
  await browser.until("!taxel.store.shown().head.frame.past && taxel.store.shown().head.frame.contacts.length === 5");
  const missed = await browser.value("taxel.store.latest.head.missed");
  const { painter, floor, rate, images } = await browser.value(`(async () => {
    const { relief } = taxel.views.surface;
    const [start, drawn, came] = [performance.now(), relief.pictures, taxel.store.count];
    while (relief.pictures < drawn + ${PICTURES}) await new Promise(requestAnimationFrame);
    const seconds = (performance.now() - start) / 1000;
    const rate = (relief.pictures - drawn) / seconds;
    const floor = taxel.store.garment.panels.map(({ base }) => [...relief.seen.slice(3 * base, 3 * base + 2)]);
    return { painter: relief.painter.constructor.name, floor, rate, images: (taxel.store.count - came) / seconds };
  })()`);
  t.diagnostic(
    `view: in three dimensions, by ${by}, ${rate.toFixed(1)} of ${images.toFixed(1)} images/s are drawn, ${PICTURES} in all`,
  );
  assert.equal(await browser.value("taxel.store.states.link.lost"), 0);
  assert.equal(await browser.value("taxel.store.latest.head.missed"), missed);
  const found = await (await screen(browser)).colours(await box(browser, "#view-surface"));
  assert.ok(found.length > 200, `${found.length} colours`);
  return { painter, floor };
}

test("the surface goes along with the stream, and without WebGL the canvas draws the same", async (t) => {
  const { browser, view } = both;
  const gl = await pictures(t, browser, "WebGL without a graphics card");
  assert.equal(gl.painter, "GlPainter");
  await show(browser, "map");
  const plain = await Chromium.start({ webgl: false });
  try {
    await plain.open(`${view.url}?keep=${KEPT}`);
    const flat = await pictures(t, plain, "the canvas without WebGL");
    assert.deepEqual(flat, { ...gl, painter: "FlatPainter" });
    assert.deepEqual(plain.complaints, []);
  } finally {
    await plain.stop();
  }
  await show(browser, "garment", "contours", "contacts", "peaks");
});

test("two pages show the same frames", async () => {
  const { browser, view } = both;
  const { targetId } = await browser.send("Target.createTarget", { url: view.url });
  await browser.until("taxel.store.states.link.pages === 2");
  const count = await browser.value("taxel.store.count");
  await browser.until(`taxel.store.count > ${count + 60}`);
  await browser.send("Target.closeTarget", { targetId });
  await browser.until("taxel.store.states.link.pages === 1");
});

test("the page has complained of nothing", () => assert.deepEqual(both.browser.complaints, []));
