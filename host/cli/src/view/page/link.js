// The connection, and its figures.

import { $, make, say } from "./dom.js";
import { absence, agoText } from "./presence.js";
import { provenance } from "./units.js";

/** The figures at the top. */
export class Link {
  /**
   * @param {HTMLElement} list
   * @param {HTMLElement} source
   * @param {HTMLElement} note
   */
  constructor(list, source, note) {
    this.list = list;
    this.source = source;
    this.note = note;
    /** @type {Map<string, HTMLElement>} */
    this.cells = new Map();
    /** @type {number[]} */
    this.images = [];
    this.connected = false;
    /** @type {number | null} */
    this.heard = null;
    /** @type {number | null} */
    this.lost = null;
  }

  /**
   * The connection is open, or lost.
   * @param {boolean} connected
   */
  connection(connected) {
    if (this.connected && !connected) this.lost = Date.now();
    this.connected = connected;
  }

  /** A message was received. */
  hear() {
    this.heard = Date.now();
  }

  /**
   * Reason why the picture is not live; null if it is.
   * @param {import("./store.js").Store} store
   */
  absence(store) {
    const { end, lost } = store.states;
    const quiet = Boolean(store.recorded) || Boolean(end);
    const board = lost && { since: lost.since_us / 1000, text: lost.why };
    return absence({ ...this, quiet, board }, Date.now());
  }

  /**
   * Shows the reason and since when; the passing seconds are not announced by screen readers.
   * @param {import("./store.js").Store} store
   */
  presence(store) {
    const gone = this.absence(store);
    document.body.classList.toggle("gone", gone !== null);
    $("absence").hidden = gone === null;
    if (!gone) return;
    const { since, text, again } = gone;
    const clock = since === null ? "" : ` since ${new Date(since).toLocaleTimeString()}`;
    say($("absence-what"), text + clock);
    const ago = since === null ? "" : ` (${agoText(Date.now() - since)})`;
    say($("absence-ago"), `${ago}${again ? " — trying again …" : ""}`);
  }

  /** An image was drawn. */
  drawn() {
    const now = performance.now();
    this.images.push(now);
    while ((this.images[0] ?? now) < now - 1000) this.images.shift();
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const { garment, states, latest } = store;
    const { link, end } = states;
    const about =
      garment &&
      `${garment.simulated ? "SIMULATED · " : ""}${garment.label} · ${garment.garment}, ${garment.taxels} taxels · scene ${garment.scene} · ${garment.firmware}`;
    say(this.source, (end ? `${end.text} · ` : "") + (about ?? "waiting for a board …"));
    this.source.title = about ?? "";
    if (garment) say(this.note, provenance(garment));
    this.presence(store);
    if (!link) return;
    if (this.absence(store) || end) {
      for (const cell of this.cells.values()) say(cell, "–");
      return;
    }
    const rate = store.recorded && store.paused ? "–" : `${link.rate.toFixed(1)} /s`;
    this.set("board", rate, "Images per second of the board");
    this.set("page", `${this.images.length} /s`, "Images per second drawn by this page; it draws the newest");
    if (store.recorded) return;
    this.count("lost", link.lost, "Messages lost on the link", true);
    this.count("thinned", link.thinned, "Images that the board left out for lack of bandwidth: the others are whole");
    this.count("missed", latest?.head.missed ?? 0, "Samples and lines that this page, in the background, did not read");
    const latency = link.latency_ms;
    this.set("latency", latency === null ? "–" : `${latency.toFixed(1)} ms`, "Half of the round trip to the board");
  }

  /**
   * Shows a count that is worth a word.
   * @param {string} name
   * @param {number} count
   * @param {string} title
   * @param {boolean} warn
   */
  count(name, count, title, warn = false) {
    if (count > 0 || this.cells.has(name)) this.set(name, String(count), title, warn && count > 0);
  }

  /**
   * @param {string} name
   * @param {string} value
   * @param {string} title
   * @param {boolean} warn
   */
  set(name, value, title, warn = false) {
    let cell = this.cells.get(name);
    if (!cell) {
      cell = make("dd", { id: `link-${name}` });
      this.list.append(make("div", { title }, make("dt", {}, name), cell));
      this.cells.set(name, cell);
    }
    cell.classList.toggle("warn", warn);
    say(cell, value);
  }
}
