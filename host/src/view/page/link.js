// Who is there, and how well it comes through.

import { make, say } from "./dom.js";
import { provenance } from "./units.js";

/** The figures at the top. */
export class Link {
  constructor(list, source, note) {
    Object.assign(this, { list, source, note, cells: new Map(), images: [], connected: false });
  }

  /** An image has been drawn. */
  drawn() {
    const now = performance.now();
    this.images.push(now);
    while (this.images[0] < now - 1000) this.images.shift();
  }

  draw(store) {
    const { garment, states, latest } = store;
    const { link, end } = states;
    const about =
      garment &&
      `${garment.label} · ${garment.garment}, ${garment.taxels} taxels · scene ${garment.scene} · ${garment.firmware}`;
    const closed = this.connected ? "" : "The program has gone; trying again … ";
    say(this.source, closed + (end ? `${end.text} · ` : "") + (about ?? "waiting for a board …"));
    if (garment) say(this.note, provenance(garment));
    if (!link) return;
    this.set("board", `${link.rate.toFixed(1)} /s`, "Images a second of the board");
    this.set("page", `${this.images.length} /s`, "Images a second that this page draws; it draws the newest");
    this.set("lost", String(link.lost), "Messages that the board sent and that did not come", link.lost > 0);
    this.set("thinned", String(link.thinned), "Images that the board left out, because the line had no room");
    const missed = latest?.head.missed ?? 0;
    this.set("missed", String(missed), "Samples and lines that this page did not read in time", missed > 0);
    const latency = link.latency_ms;
    this.set("latency", latency === null ? "–" : `${latency.toFixed(1)} ms`, "Half of the way to the board and back");
  }

  set(name, value, title, warn = false) {
    if (!this.cells.has(name)) {
      const cell = make("dd", { id: `link-${name}` });
      this.list.append(make("div", { title }, make("dt", {}, name), cell));
      this.cells.set(name, cell);
    }
    const cell = this.cells.get(name);
    cell.classList.toggle("warn", warn);
    say(cell, value);
  }
}
