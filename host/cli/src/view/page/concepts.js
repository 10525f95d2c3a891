// The concepts of the map in three groups, which are folded until somebody wants the numbers.

import { Bars } from "./bars.js";
import { palette } from "./colours.js";
import { make, say } from "./dom.js";

/** Title of each part of a map, in reading order. */
const TITLES = /** @type {const} */ ({ felt: "What is felt", meaning: "What it means", feeling: "Feelings" });
/** Least activation that a folded group names. */
const STRONG = 0.5;

/**
 * Colour of a concept: an intention and a feeling have theirs everywhere.
 * @param {{ name: string, role: string }} concept
 */
export const colourOf = ({ name, role }) => palette.intentions[name] ?? (role === "feeling" ? palette.feeling : null);

/** The groups; `why` explains a concept. */
export class Concepts {
  /**
   * @param {HTMLElement} root
   * @param {(concept: string) => void} why
   * @param {() => void} changed
   */
  constructor(root, why, changed) {
    this.root = root;
    this.why = why;
    this.changed = changed;
    this.key = "";
    /** @type {{ names: string[], group: HTMLDetailsElement, bars: Bars, brief: HTMLElement }[]} */
    this.groups = [];
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const shown = store.shown();
    const map = store.garment?.map ?? null;
    this.root.hidden = !map;
    if (!shown || !map) return;
    const key = JSON.stringify(map);
    if (key !== this.key) this.build(map);
    this.key = key;
    const { concepts, leading } = shown.head.frame.intent;
    for (const { names, group, bars, brief } of this.groups) {
      const value = (/** @type {string} */ name) => concepts[name] ?? 0;
      const strong = names.filter((name) => Math.abs(value(name)) >= STRONG);
      strong.sort((a, b) => Math.abs(value(b)) - Math.abs(value(a)));
      say(brief, group.open ? "" : strong.map((name) => (value(name) < 0 ? `not ${name}` : name)).join(", ") || "–");
      // What is folded is not read.
      if (group.open) bars.draw(Object.fromEntries(names.map((name) => [name, value(name)])), leading);
    }
  }

  /** @param {import("./types.d.ts").CognitiveMapOf} map */
  build({ concepts, edges }) {
    const caused = new Set(edges.map(({ to }) => concepts[to]?.name));
    const parts = Object.entries(TITLES).map(([role, title]) => ({ title, of: concepts.filter((one) => one.role === role) }));
    this.groups = parts.filter(({ of }) => of.length).map(({ title, of }) => {
      const list = make("ul", { class: "bars" });
      const brief = make("span", { class: "quiet" });
      const group = make("details", { toggle: this.changed }, make("summary", {}, make("b", {}, title), brief), list);
      const colours = Object.fromEntries(of.map((concept) => [concept.name, colourOf(concept)]));
      const bars = new Bars(list, { colours, why: (name) => (caused.has(name) ? () => this.why(name) : null) });
      return { names: of.map(({ name }) => name), group, bars, brief };
    });
    this.root.replaceChildren(...this.groups.map(({ group }) => group));
  }
}
