// A board on a serial port that the page opens itself: `navigator.serial` is made up, the bytes are a simulated board's.

import { after, before, test } from "node:test";
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { violations } from "./access.fixture.mjs";
import { Chromium } from "./chromium.mjs";
import { board, serve } from "./site.fixture.mjs";

const WIRE = process.env.TAXEL_WIRE ?? new URL("../../target/tmp", import.meta.url).pathname;
/** Bytes that the made-up port has at once. */
const FIRST = 150_000;
const page = {};

before(async () => {
  page.server = await serve();
  page.browser = await Chromium.start();
});
after(async () => {
  await page.browser?.stop();
  await page.server?.stop();
});

/** The pieces that host/site/tests/serial.rs has left. */
const pieces = () => readFile(join(WIRE, "serial.pieces"));

/** Bytes of the pieces together. */
function joined(pieces) {
  const parts = [];
  for (let at = 0; at < pieces.length; ) {
    const length = pieces.readUInt32LE(at);
    parts.push(pieces.subarray(at + 4, at + 4 + length));
    at += 4 + length;
  }
  return Buffer.concat(parts);
}

/** A serial port in the page that sends these bytes, and keeps what it is sent. */
const port = (bytes) => `
  const bytes = Uint8Array.from(atob("${bytes.toString("base64")}"), (sign) => sign.charCodeAt(0));
  class Port extends EventTarget {
    sent = [];
    opened = 0;
    async open(options) {
      this.options = options;
      this.opened += 1;
      this.readable = new ReadableStream({ start: (control) => (this.control = control) });
      this.writable = new WritableStream({ write: (part) => void this.sent.push(...part) });
      for (let at = 0; at < bytes.length; at += 4096) this.control.enqueue(bytes.slice(at, at + 4096));
    }
    async close() {}
    getInfo() { return { usbVendorId: 0x2e8a, usbProductId: 10 }; }
    unplug() {
      const { control } = this;
      this.readable = this.writable = null;
      control.error(new Error("The device has been lost."));
    }
  }
  window.port = new Port();
  const serial = new EventTarget();
  serial.requestPort = async () => window.port;
  Object.defineProperty(navigator, "serial", { value: serial });
  window.plug = () => {
    const event = new Event("connect");
    Object.defineProperty(event, "target", { value: window.port });
    serial.dispatchEvent(event);
  };`;

test("pieces and losses give the events that the program has of them", async () => {
  const lines = await readFile(join(WIRE, "serial.lines"), "utf8");
  assert.ok(lines.split("\n").length > 500);
  assert.ok((await board()).linesOf(await pieces()) === lines);
});

test("a board on a port is shown, lost, and asked again once its port is back", async () => {
  const { browser, server } = page;
  const source = port(joined(await pieces()).subarray(0, FIRST));
  await browser.send("Page.addScriptToEvaluateOnNewDocument", { source });
  await browser.open(server.url);
  await browser.value("document.getElementById('board').click()");
  assert.deepEqual(await violations(browser), []);
  await browser.value("document.getElementById('choose-port').click()");
  await browser.until("taxel.store.garment.label === 'serial port 2e8a:000a'");
  await browser.until("taxel.store.latest?.head.frame.contacts.length > 0");
  assert.equal(await browser.value("taxel.store.states.hand === undefined"), true, "a real board is pressed by no mouse");
  assert.deepEqual(await browser.value("[port.options.baudRate, port.sent.length > 0, port.opened]"), [921_600, true, 1]);
  await browser.value("port.unplug()");
  await browser.until("/device has been lost/.test(taxel.store.states.lost?.why)");
  // What is made up answers nothing: that settings are restored is tested with boards that do.
  const asked = await browser.value("port.sent.length");
  await browser.value("plug()");
  await browser.until(`port.opened === 2 && port.sent.length > ${asked}`);
});

test("where there is no Web Serial a sentence says so", async () => {
  const { browser } = page;
  const without = await Chromium.start();
  try {
    await without.send("Page.addScriptToEvaluateOnNewDocument", {
      source: "Object.defineProperty(navigator, 'serial', { value: undefined })",
    });
    await without.open(page.server.url);
    await without.value("document.getElementById('board').click()");
    const said = await without.value("document.getElementById('ask-board').innerText");
    assert.match(said, /reads no serial ports: Chrome, Edge and Opera do/);
    assert.equal(await without.value("document.getElementById('choose-port')"), null);
    assert.deepEqual(without.complaints, []);
  } finally {
    await without.stop();
  }
  assert.deepEqual(browser.complaints, []);
});
