// Activations as bars from the middle.

import { make, say } from "./dom.js";

/**
 * @typedef {object} Look
 * @property {Record<string, string | null>} [colours] of concepts that have one of their own
 * @property {(name: string) => (() => void) | null} [why] explains a concept
 */

/** A list of concepts. */
export class Bars {
  /**
   * @param {HTMLElement} list
   * @param {Look} look
   */
  constructor(list, look = {}) {
    this.list = list;
    this.look = look;
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
      bar.style.background = (activation > 0 && this.look.colours?.[name]) || "";
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
      const why = this.look.why?.(name);
      const title = why ? make("button", { click: why, title: `Why ${name}?` }, name) : make("span", {}, name);
      const item = make("li", {}, title, make("i", {}, bar), value);
      return { name, item, bar, value };
    });
    this.list.replaceChildren(...this.parts.map(({ item }) => item));
  }
}
