// Whom the page speaks with: the program, by a WebSocket; in the site, which has none, a worker of the page.

/**
 * The part of a WebSocket that the page uses.
 * @typedef {object} Channel
 * @property {number} readyState
 * @property {BinaryType} binaryType
 * @property {((event: any) => void) | null} onopen
 * @property {((event: any) => void) | null} onclose
 * @property {((event: any) => void) | null} onmessage
 * @property {(text: string) => void} send
 * @property {() => void} close
 */

/** Script of the worker; none if a program serves the page. */
const WORKER = document.documentElement.dataset.worker;

/** A worker in the place of a program. */
export class WorkerChannel {
  /** @param {string} address */
  constructor(address) {
    /** @type {number} */
    this.readyState = WebSocket.CONNECTING;
    /** @type {BinaryType} */
    this.binaryType = "arraybuffer";
    /** @type {Channel["onopen"]} */
    this.onopen = null;
    /** @type {Channel["onclose"]} */
    this.onclose = null;
    /** @type {Channel["onmessage"]} */
    this.onmessage = null;
    /** @type {((bytes: Uint8Array) => void) | null} */
    this.onsend = null;
    /** @type {((bytes: Uint8Array<ArrayBuffer> | null) => void)[]} who waits for a file */
    this.waiting = [];
    this.worker = new Worker(address, { type: "module" });
    this.worker.onmessage = ({ data }) => this.hear(data);
    const script = new URLSearchParams(location.search).get("script");
    this.open(script === null ? {} : { script });
  }

  /** @param {any} data */
  hear(data) {
    if (typeof data === "string" || data instanceof ArrayBuffer) this.onmessage?.({ data });
    else if (data.opened) {
      this.readyState = WebSocket.OPEN;
      this.onopen?.(data);
    } else if (data.send) this.onsend?.(data.send);
    else this.waiting.shift()?.(data.bytes);
  }

  /**
   * Opens a board: see host/site/page/worker.js.
   * @param {{ script?: string, serial?: string }} open
   */
  open(open) {
    this.post({ open });
  }

  /**
   * A file that the worker makes; null if there is none.
   * @param {string} file
   * @returns {Promise<Uint8Array<ArrayBuffer> | null>}
   */
  file(file) {
    this.post({ file });
    return new Promise((made) => this.waiting.push(made));
  }

  /**
   * Sends what a socket has no need of.
   * @param {object} order see host/site/page/worker.js
   */
  post(order) {
    this.worker.postMessage(order);
  }

  /** @param {string} text */
  send(text) {
    this.worker.postMessage(text);
  }

  close() {
    this.worker.terminate();
    this.readyState = WebSocket.CLOSED;
  }
}

/** The worker; null if a program serves the page. */
export const worker = WORKER === undefined ? null : new WorkerChannel(WORKER);

// From then on the site works without a network.
if (worker) navigator.serviceWorker?.register("service-worker.js");

/**
 * Opens the way to a board.
 * @param {string} place beside the page
 * @returns {Channel}
 */
export function channel(place) {
  return worker ?? new WebSocket(new URL(place, location.href.replace(/^http/, "ws")));
}

/**
 * Address of a file that is saved; null if there is none.
 * @param {string} name
 */
export async function address(name) {
  if (!worker) return name;
  const bytes = await worker.file(name);
  return bytes && URL.createObjectURL(new Blob([bytes]));
}
