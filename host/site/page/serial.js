// A board on a serial port of this machine: the page opens it by Web Serial, and carries its bytes to the client in the
// worker and back.

import { worker } from "./channel.js";
import { $, make, say } from "./dom.js";

/** Speed of a board's port, bits per second, as that of `serial:PATH`; one on USB ignores it. */
const BAUD = 921_600;
/** Most bytes that a port keeps until the page reads them. */
const KEPT = 1 << 16;
/** Where there is no Web Serial. */
const NONE =
  "This browser reads no serial ports: Chrome, Edge and Opera do, on a computer. With any browser, the program `taxel view` shows a board.";
const ASK =
  "The page reads the board's stream and asks it for a tare only if you do. Nothing leaves this machine.";

/**
 * The part of Web Serial that is used.
 * @typedef {object} SerialPort
 * @property {(options: { baudRate: number, bufferSize: number }) => Promise<void>} open
 * @property {ReadableStream<Uint8Array> | null} readable
 * @property {WritableStream<Uint8Array> | null} writable
 * @property {() => Promise<void>} close
 * @property {() => { usbVendorId?: number, usbProductId?: number }} getInfo
 */

/** @typedef {EventTarget & { requestPort: () => Promise<SerialPort> }} Serial */

/** @type {Serial | undefined} */
const serial = /** @type {any} */ (navigator).serial;

/** The port, from its opening until the page is closed. */
class Carrier {
  /**
   * @param {import("./channel.js").WorkerChannel} to
   * @param {SerialPort} port
   */
  constructor(to, port) {
    this.to = to;
    this.port = port;
    this.isOpen = false;
    /** @type {Promise<void>} what is being written */
    this.written = Promise.resolve();
  }

  /** Opens the port, and carries what comes until it is gone. */
  async run() {
    await this.port.open({ baudRate: BAUD, bufferSize: KEPT });
    this.isOpen = true;
    const { usbVendorId: vendor, usbProductId: product } = this.port.getInfo();
    const hex = (/** @type {number | undefined} */ number) => (number ?? 0).toString(16).padStart(4, "0");
    this.to.onsend = (bytes) => this.write(bytes);
    this.to.open({ serial: vendor === undefined ? "serial port" : `serial port ${hex(vendor)}:${hex(product)}` });
    await this.read();
  }

  /** Opens the port again once it is back. */
  async again() {
    if (this.isOpen) return;
    await this.port.open({ baudRate: BAUD, bufferSize: KEPT });
    this.isOpen = true;
    this.to.post({ gone: "" });
    await this.read();
  }

  /** Carries what the board sends, until the port is gone. */
  async read() {
    let why = "the port was closed";
    try {
      // After an error that the port survives, such as lost bytes, it has another stream.
      while (this.port.readable) {
        const reader = this.port.readable.getReader();
        try {
          for (let part = await reader.read(); !part.done; part = await reader.read()) this.to.post({ received: part.value });
        } catch (error) {
          why = /** @type {Error} */ (error).message;
        } finally {
          reader.releaseLock();
        }
      }
    } finally {
      this.isOpen = false;
      await this.port.close().catch(() => {});
      this.to.post({ gone: why });
    }
  }

  /**
   * Carries what the board is sent, in its order.
   * @param {Uint8Array} bytes
   */
  write(bytes) {
    this.written = this.written.then(async () => {
      const writer = this.isOpen ? this.port.writable?.getWriter() : null;
      // What is lost with the port the client asks for again.
      await writer?.write(bytes).catch(() => {});
      writer?.releaseLock();
    });
  }
}

/** @type {Carrier | null} */
let carrier = null;
const text = make("p", { id: "ask-board-text" }, serial ? ASK : NONE);
const choose = make("button", { value: "port", id: "choose-port" }, "Choose a port");
const cancel = make("button", { value: "no" }, serial ? "Cancel" : "Close");
const form = make("form", { method: "dialog" }, cancel, ...(serial ? [choose] : []));
const title = make("h2", { id: "ask-board-title" }, "A board on this machine");
const dialog = make("dialog", { id: "ask-board" }, title, text, form);
dialog.setAttribute("aria-labelledby", title.id);
dialog.setAttribute("aria-describedby", text.id);
const button = make("button", { id: "board", title: "Show a board that is plugged in" }, "Board …");
button.setAttribute("aria-haspopup", "dialog");
button.addEventListener("click", () => dialog.showModal());
$("tare").before(button);
document.body.append(dialog);

choose.addEventListener("click", async (event) => {
  event.preventDefault();
  if (!serial || !worker) return;
  try {
    const port = await serial.requestPort();
    carrier = new Carrier(worker, port);
    dialog.close();
    await carrier.run();
  } catch (error) {
    if (!dialog.open) dialog.showModal();
    say(text, `The port cannot be read: ${/** @type {Error} */ (error).message}`);
  }
});

// The event's target is the port that is there again.
serial?.addEventListener("connect", ({ target }) => {
  if (carrier && target === /** @type {unknown} */ (carrier.port)) carrier.again().catch(() => {});
});
