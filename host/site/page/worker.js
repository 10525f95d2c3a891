// The worker of the site: tells the page what the program would, in the same messages.
//
// Texts from the page are requests, texts to it are lines, buffers to it are images, as on the program's socket. Objects
// are what a socket has no need of: the board to open, files, and the bytes of a serial port.

import { Board } from "./board.js";

/** Time between two looks at the board, ms. */
const LOOK_MS = 4;

/**
 * @typedef {object} Order
 * @property {{ script?: string, serial?: string }} [open] board to open
 * @property {string} [file] name of a file to make
 * @property {Uint8Array} [received] bytes of the serial port
 * @property {string} [gone] reason why the port is gone; empty: it is there again
 */

const scope = /** @type {DedicatedWorkerGlobalScope} */ (/** @type {unknown} */ (self));
const loaded = WebAssembly.compileStreaming(fetch("taxel.wasm")).then(Board.load);
/** @type {Board | null} */
let board = null;
/** @type {Set<string>} kinds of lines that the page was sent of a board */
const kinds = new Set();

/** @param {string} text */
const end = (text) => scope.postMessage(JSON.stringify({ type: "end", text }));

/** @param {string | ArrayBuffer} message */
function pass(message) {
  const kind = typeof message === "string" && /^\{"type":"(\w+)"/.exec(message)?.[1];
  if (kind) kinds.add(kind);
  scope.postMessage(message, typeof message === "string" ? [] : [message]);
}

/** @param {Order} order */
async function obey({ open, file, received, gone }) {
  if (open) {
    const next = await loaded;
    scope.postMessage({ opened: true });
    // What the page knows is of the board before.
    for (const of of kinds) scope.postMessage(JSON.stringify({ type: "none", of }));
    kinds.clear();
    next.open(open);
    board = next;
  }
  if (received) board?.receive(received);
  if (gone !== undefined) board?.gone(gone);
  if (file !== undefined) scope.postMessage({ file, bytes: made(file) });
}

/**
 * A file; null if it cannot be made, which the log says.
 * @param {string} name
 */
function made(name) {
  try {
    return board?.file(name) ?? null;
  } catch (error) {
    const said = `${name} could not be saved: ${/** @type {Error} */ (error).message}`;
    scope.postMessage(JSON.stringify({ type: "say", kind: "note", time_us: null, said }));
    return null;
  }
}

/** @param {MessageEvent<string | Order>} event */
scope.onmessage = ({ data }) => {
  if (typeof data === "string") board?.ask(data);
  else obey(data).catch((error) => end(error.message));
};

setInterval(() => {
  if (!board) return;
  try {
    board.turn();
    const sent = board.toSend();
    if (sent.length > 0) scope.postMessage({ send: sent }, [sent.buffer]);
    for (const message of board.messages()) pass(message);
  } catch (error) {
    board = null;
    end(`the page's board has failed: ${/** @type {Error} */ (error).message}`);
  }
}, LOOK_MS);
