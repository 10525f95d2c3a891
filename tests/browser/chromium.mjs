// Debian's Chromium without a screen, driven through its DevTools protocol.

import { spawn } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import WebSocket from "ws";

const PROGRAM = process.env.TAXEL_CHROMIUM ?? "chromium";
// No sandbox, because checks may run as root.
const OPTIONS = [
  "--headless=new",
  "--no-sandbox",
  "--disable-dev-shm-usage",
  "--remote-debugging-port=0",
  "--hide-scrollbars",
  "--no-first-run",
  "--disable-extensions",
  "--enable-precise-memory-info",
  "--js-flags=--expose-gc",
];
/** WebGL by software, and nothing else that a graphics card would draw: that takes the processor longer. */
const SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-rasterization", "--disable-accelerated-2d-canvas"];
/** Neither WebGL nor any other imitation of a graphics card. */
const PLAIN = ["--disable-gpu", "--disable-gpu-rasterization", "--disable-software-rasterizer"];
const STARTS_MS = 30_000;

/** A running browser with one page. */
export class Chromium {
  /** Starts it, with WebGL or without. */
  static async start({ webgl = true } = {}) {
    const folder = await mkdtemp(join(tmpdir(), "taxel-chromium-"));
    const process = spawn(PROGRAM, [...OPTIONS, ...(webgl ? SOFTWARE : PLAIN), `--user-data-dir=${folder}`, "about:blank"], { stdio: "ignore" });
    const failed = new Promise((_, fail) => process.once("error", fail));
    const port = await Promise.race([portOf(folder), failed]);
    const pages = await (await fetch(`http://127.0.0.1:${port}/json/list`)).json();
    const socket = new WebSocket(pages.find(({ type }) => type === "page").webSocketDebuggerUrl, {
      maxPayload: 1 << 28,
    });
    await new Promise((open, fail) => socket.once("open", open).once("error", fail));
    const browser = new Chromium(process, folder, socket);
    await Promise.all(["Page", "Runtime", "Log"].map((domain) => browser.send(`${domain}.enable`)));
    return browser;
  }

  constructor(process, folder, socket) {
    Object.assign(this, { process, folder, socket, next: 1, waiting: new Map(), complaints: [] });
    socket.on("message", (text) => this.take(JSON.parse(text)));
  }

  take({ id, result, error, method, params }) {
    if (id) {
      const { done, fail } = this.waiting.get(id);
      this.waiting.delete(id);
      return error ? fail(new Error(error.message)) : done(result);
    }
    if (method === "Runtime.exceptionThrown") this.complaints.push(params.exceptionDetails.exception?.description);
    if (method === "Log.entryAdded" && params.entry.level === "error")
      this.complaints.push(`${params.entry.text} ${params.entry.url}`);
  }

  /** A command of the protocol. */
  send(method, params = {}) {
    const id = this.next++;
    this.socket.send(JSON.stringify({ id, method, params }));
    return new Promise((done, fail) => this.waiting.set(id, { done, fail }));
  }

  /** Shows the page of `taxel view`, of that size. */
  async open(url, size) {
    await this.visit(url, size);
    await this.until("window.taxel?.store.latest");
  }

  /** Shows any page. */
  async visit(url, { width = 1280, height = 800, dark = false, mobile = false } = {}) {
    await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile });
    await this.send("Emulation.setEmulatedMedia", {
      features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }],
    });
    await this.send("Page.navigate", { url });
    await this.until(`document.readyState === "complete" && location.href.startsWith(${JSON.stringify(url)})`);
  }

  /** The value of an expression in the page. */
  async value(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", {
      expression,
      returnByValue: true,
      awaitPromise: true,
    });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Waits until an expression is true: its value. */
  async until(expression, seconds = 20) {
    const end = Date.now() + seconds * 1000;
    for (;;) {
      const value = await this.value(`Boolean(${expression})`).catch(() => false);
      if (value) return value;
      if (Date.now() > end) throw new Error(`not true in ${seconds} s: ${expression}; ${this.complaints.join("; ")}`);
      await sleep(20);
    }
  }

  /** Moves the pointer, presses or releases its button. */
  pointer(x, y, type = "mouseMoved") {
    if (type !== "mouseMoved") this.pressed = type === "mousePressed";
    const button = type === "mouseMoved" && !this.pressed ? "none" : "left";
    const buttons = this.pressed ? 1 : 0;
    return this.send("Input.dispatchMouseEvent", { type, x, y, button, buttons, clickCount: 1 });
  }

  /** Presses a key. */
  async key(key) {
    await this.keyEvent("keyDown", key);
    await this.keyEvent("keyUp", key);
  }

  /** A key goes down or up. */
  keyEvent(type, key) {
    const text = type === "keyDown" && key.length === 1 ? key : undefined;
    // A dialog and the tabulator go by the number of the key.
    const windowsVirtualKeyCode = { Escape: 27, Tab: 9 }[key];
    return this.send("Input.dispatchKeyEvent", { type, key, text, windowsVirtualKeyCode });
  }

  /** Fingers on the screen: `touchStart`, `touchMove` with all that are down, and `touchEnd` with those that stay. */
  fingers(type, points) {
    const touchPoints = points.map(([x, y], id) => ({ x, y, id }));
    return this.send("Input.dispatchTouchEvent", { type, touchPoints });
  }

  /** Turns the wheel by notches, below 0 towards the user. */
  wheel(x, y, notches, modifiers = 0) {
    return this.send("Input.dispatchMouseEvent", { type: "mouseWheel", x, y, deltaX: 0, deltaY: -100 * notches, modifiers });
  }

  /** What is seen, as PNG; or all of the page, however long. */
  async picture(isWhole = false) {
    const { data } = await this.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: isWhole });
    return Buffer.from(data, "base64");
  }

  /** Ends it. */
  async stop() {
    const gone = new Promise((done) => this.process.once("exit", done));
    this.socket.close();
    this.process.kill();
    await gone;
    await rm(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

async function portOf(folder) {
  const end = Date.now() + STARTS_MS;
  while (Date.now() < end) {
    const text = await readFile(join(folder, "DevToolsActivePort"), "utf8").catch(() => "");
    if (text.includes("\n")) return text.split("\n")[0];
    await sleep(20);
  }
  throw new Error(`${PROGRAM} did not start in ${STARTS_MS / 1000} s`);
}
