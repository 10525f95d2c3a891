// The board, its simulation and the client in WebAssembly: see host/site/src/exports.rs.

/**
 * @typedef {object} Exports functions of the module; texts and bytes are passed by two buffers in its memory
 * @property {WebAssembly.Memory} memory
 * @property {(length: number) => number} taxel_room
 * @property {() => number} taxel_out
 * @property {(steady: number, calendar: number) => void} taxel_clock
 * @property {() => number} taxel_open
 * @property {() => number} taxel_turn
 * @property {() => void} taxel_ask
 * @property {() => number} taxel_next
 * @property {() => number} taxel_file
 * @property {() => void} taxel_received
 * @property {() => number} taxel_to_send
 * @property {() => void} taxel_gone
 * @property {() => number} taxel_lines
 * @property {() => number} taxel_lines_of
 */

/** Longest work at a time, ms: messages of the page are heard in between. */
const SLICE_MS = 8;

/** A board. */
export class Board {
  /** @param {Exports} exports */
  constructor(exports) {
    this.exports = exports;
  }

  /**
   * Loads the module.
   * @param {WebAssembly.Module} module
   */
  static async load(module) {
    const { exports } = await WebAssembly.instantiate(module, {});
    return new Board(/** @type {Exports} */ (/** @type {unknown} */ (exports)));
  }

  /**
   * Writes what the next call takes.
   * @param {Uint8Array | string} content
   */
  write(content) {
    const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
    const at = this.exports.taxel_room(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
  }

  /**
   * What the last call has returned.
   * @param {number} length
   */
  read(length) {
    const at = this.exports.taxel_out();
    return new Uint8Array(this.exports.memory.buffer, at, length).slice();
  }

  /**
   * What the last call has returned; throws its sentence if it is one.
   * @param {number} length negative for a sentence
   */
  answer(length) {
    const bytes = this.read(Math.abs(length));
    if (length < 0) throw new Error(new TextDecoder().decode(bytes));
    return bytes;
  }

  clock() {
    this.exports.taxel_clock(performance.now() * 1000, Date.now() * 1000);
  }

  /**
   * Opens a simulated board that plays a script or waits for hands, or the one on a serial port of this name.
   * @param {{ script?: string, serial?: string }} opening
   */
  open(opening) {
    this.clock();
    this.write(JSON.stringify(opening));
    this.answer(this.exports.taxel_open());
  }

  /** Handles what has come from the board. */
  turn() {
    const until = performance.now() + SLICE_MS;
    do this.clock();
    while (this.exports.taxel_turn() && performance.now() < until);
  }

  /**
   * Handles a request of the page.
   * @param {string} request
   */
  ask(request) {
    this.write(request);
    this.exports.taxel_ask();
  }

  /**
   * Messages to the page that are due: texts, and images as bytes.
   * @returns {Generator<string | ArrayBuffer>}
   */
  *messages() {
    for (let length = this.exports.taxel_next(); length !== 0; length = this.exports.taxel_next()) {
      const bytes = this.read(Math.abs(length));
      yield length < 0 ? bytes.buffer : new TextDecoder().decode(bytes);
    }
  }

  /**
   * A file that the page saves.
   * @param {string} name
   */
  file(name) {
    this.clock();
    this.write(name);
    return this.answer(this.exports.taxel_file());
  }

  /**
   * Takes bytes of the serial port.
   * @param {Uint8Array} bytes
   */
  receive(bytes) {
    this.write(bytes);
    this.exports.taxel_received();
  }

  /** Bytes that the serial port is to send. */
  toSend() {
    return this.read(this.exports.taxel_to_send());
  }

  /**
   * The serial port is gone for this reason, or there again.
   * @param {string} why empty if it is there again
   */
  gone(why) {
    this.write(why);
    this.exports.taxel_gone();
  }

  /**
   * Lines of JSON of a script that is played once, as `taxel live --json` prints them.
   * @param {string} script
   */
  lines(script) {
    this.write(script);
    return new TextDecoder().decode(this.answer(this.exports.taxel_lines()));
  }

  /**
   * The same of a board whose bytes come in pieces, each after its length in four bytes, the least first.
   * @param {Uint8Array} pieces
   */
  linesOf(pieces) {
    this.write(pieces);
    return new TextDecoder().decode(this.answer(this.exports.taxel_lines_of()));
  }
}
