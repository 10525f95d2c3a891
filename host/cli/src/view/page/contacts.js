// Contacts and intention in words and numbers.

import { make, say } from "./dom.js";
import { force } from "./units.js";

/**
 * The table of contacts.
 * @param {HTMLTableElement} table
 * @param {HTMLElement} count
 * @param {import("./store.js").Store} store
 */
export function contacts(table, count, store) {
  const shown = store.shown();
  const list = shown ? shown.head.frame.contacts : [];
  say(count, list.length ? String(list.length) : "none");
  const body = table.tBodies[0] ?? table.createTBody();
  const { garment } = store;
  if (!garment) return;
  while (body.rows.length > list.length) body.deleteRow(-1);
  list.forEach((touch, at) => {
    const row = body.rows[at] ?? body.insertRow();
    const mm = garment.panels[touch.panel]?.mm ?? [10, 10];
    const speed = Math.hypot(touch.vx * mm[0], touch.vy * mm[1]);
    const cells = [
      String(touch.id),
      touch.region,
      touch.shape,
      force(garment, touch.total),
      String(touch.area),
      `${touch.slip ? "slips " : ""}${speed.toFixed(0)}`,
    ];
    cells.forEach((text, column) => say(row.cells[column] ?? row.insertCell(), text));
  });
}

/** Activation of each concept as a bar from the middle. */
export class Bars {
  /** @param {HTMLElement} list */
  constructor(list) {
    this.list = list;
    this.key = "";
    /** @type {{ name: string, item: HTMLElement, bar: HTMLElement, value: HTMLElement }[]} */
    this.parts = [];
  }

  /**
   * @param {Record<string, number>} concepts
   * @param {string} leading
   */
  draw(concepts, leading) {
    const names = Object.keys(concepts);
    if (names.join() !== this.key) this.build(names);
    for (const { name, item, bar, value } of this.parts) {
      const activation = concepts[name] ?? 0;
      item.classList.toggle("leads", name === leading);
      bar.classList.toggle("less", activation < 0);
      bar.style.transform = `scaleX(${Math.max(-1, Math.min(1, activation))})`;
      say(value, activation.toFixed(2));
    }
  }

  /** @param {string[]} names */
  build(names) {
    this.key = names.join();
    this.parts = names.map((name) => {
      const bar = make("b");
      const value = make("span", { class: "value" });
      const item = make("li", {}, make("span", {}, name), make("i", {}, bar), value);
      return { name, item, bar, value };
    });
    this.list.replaceChildren(...this.parts.map(({ item }) => item));
  }
}

/** The intention and the concepts of the image that is shown. */
export class Concepts {
  /**
   * @param {HTMLElement} list
   * @param {HTMLElement} leading
   */
  constructor(list, leading) {
    this.bars = new Bars(list);
    this.leading = leading;
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const shown = store.shown();
    if (!shown) return;
    const { concepts, leading } = shown.head.frame.intent;
    say(this.leading, leading);
    this.bars.draw(concepts, leading);
  }
}
