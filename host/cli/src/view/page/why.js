// Why the board means that: what the inputs of its map contribute to an activation, reported by the program.

import { $, make, one, say } from "./dom.js";

/** @typedef {import("./messages.d.ts").WhyLine} WhyLine */

const signed = (/** @type {number} */ share) => `${share < 0 ? "−" : "+"}${Math.abs(share).toFixed(2)}`;

/** The card that explains a concept of the moment shown. */
export class Why {
  /**
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} changed
   */
  constructor(ask, changed) {
    this.ask = ask;
    this.changed = changed;
    this.isOpen = false;
    /** @type {string | null} */
    this.concept = null;
    this.asked = "";
    /** @type {WhyLine | undefined} */
    this.drawn = undefined;
    $("why").addEventListener("click", () => (this.isOpen ? this.close() : this.open(null)));
    $("why-close").addEventListener("click", () => this.close());
  }

  /**
   * Explains a concept; null for what is announced or, if nothing is, the strongest intention.
   * @param {string | null} concept
   */
  open(concept) {
    this.concept = concept;
    this.show(true);
    $("reasons").focus();
  }

  close() {
    this.show(false);
    $("why").focus();
  }

  /** @param {boolean} open */
  show(open) {
    this.isOpen = open;
    this.asked = "";
    $("reasons").hidden = !open;
    $("why").setAttribute("aria-expanded", String(open));
    this.changed();
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const shown = store.shown();
    const map = store.garment?.map;
    if (!this.isOpen || !shown || !map) return;
    const { concepts, leading } = shown.head.frame.intent;
    const of = this.concept ?? (leading === "none" ? null : leading);
    const request = { why: { of, concepts: map.concepts.map(({ name }) => concepts[name] ?? 0) } };
    const asked = JSON.stringify(request);
    if (asked !== this.asked) this.ask(request);
    this.asked = asked;
    const { why } = store.states;
    if (why === this.drawn && why) return;
    this.drawn = why;
    say($("reasons-title"), why ? `Why ${why.concept} is ${why.activation.toFixed(2)}` : "Why");
    $("reasons-none").hidden = Boolean(why);
    one(HTMLTableElement, "reasons-inputs").replaceChildren(...(why ? [inputs(why)] : []));
    $("reasons-paths").replaceChildren(...(why ? paths(why) : []));
  }
}

/** @param {WhyLine} why */
function inputs({ inputs, rest, sum }) {
  const most = Math.max(0.01, ...inputs.map(([, share]) => Math.abs(share)));
  const others = rest.reduce((all, [, share]) => all + share, 0);
  const row = (/** @type {string} */ name, /** @type {number} */ share) => {
    const bar = make("b", { class: share < 0 ? "less" : "", style: `transform:scaleX(${share / most})` });
    return make("tr", {}, make("th", { scope: "row" }, name), make("td", {}, make("i", {}, bar)), make("td", {}, signed(share)));
  };
  const rows = inputs.map(([name, share]) => row(name, share));
  if (others) rows.push(row("no input", others));
  const total = make("tr", {}, make("th", { scope: "row" }, "sum"), make("td"), make("td", {}, signed(sum)));
  return make("tbody", {}, ...rows, total);
}

/**
 * The ways from inputs to the concept.
 * @param {WhyLine} why
 */
function paths({ concept, paths, rest }) {
  const ways = paths.map(({ concepts, share }) => `${signed(share)}  ${[...concepts, concept].join(" → ")}`);
  return [...ways, ...rest.map(([reason, share]) => `${signed(share)}  ${reason}`)].map((text) => make("li", {}, text));
}
