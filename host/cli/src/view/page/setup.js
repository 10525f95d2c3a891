// Sets limits and filter on the board: each step is felt at once, can be undone, and is saved on request.

import { $, make, one, say } from "./dom.js";
import { FILTERS, LIMITS, changed, passed } from "./limits.js";

/**
 * @typedef {import("./limits.js").Limits} Limits
 * @typedef {import("./messages.d.ts").SetupLine} SetupLine
 */

/** Questions that a real board is worth. */
const QUESTIONS = {
  set: "The board takes other limits at once, for everyone who uses it: what touches the garment now may end, or begin anew. Undo takes them back.",
  save: "The board keeps its present garment, scene, gains and baseline in its flash: it starts with them from now on. It stops scanning while it writes.",
};

/** The card. */
export class Setup {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} redraw
   */
  constructor(store, ask, redraw) {
    this.store = store;
    this.ask = ask;
    /** @type {Limits | null} what a slider shows before the board has answered */
    this.tried = null;
    /** @type {SetupLine | undefined} what was known when the board was asked; undefined: it is not asked */
    this.asked = undefined;
    /** True once it was said that this board may be set. */
    this.isAgreed = false;
    /** @type {() => void} what is done if the question is answered with yes */
    this.next = () => {};
    /** @type {Map<string, HTMLInputElement>} */
    this.sliders = new Map();
    const rows = LIMITS.map(([name, label, least, most, title]) => {
      const slider = make("input", { type: "range", min: least, max: most, id: `limit-${name}`, title });
      slider.addEventListener("input", () => {
        this.tried = this.limits && changed(this.limits, name, slider.valueAsNumber);
        this.asked = undefined;
        redraw();
      });
      slider.addEventListener("change", () => this.set(this.tried));
      this.sliders.set(name, slider);
      const value = make("output", { id: `value-${name}`, for: slider.id });
      return make("div", {}, make("label", { for: slider.id }, label), slider, value);
    });
    this.filter = make("select", { id: "filter" }, ...FILTERS.map(([name, label, title]) => make("option", { value: name, title }, label)));
    this.filter.addEventListener("change", () => this.set(this.limits && { ...this.limits, filter: this.filter.value }));
    rows.push(make("div", {}, make("label", { for: "filter" }, "Filter"), this.filter));
    $("limits").append(...rows);
    $("set-up").addEventListener("click", () => {
      $("setup").hidden = !$("setup").hidden;
      redraw();
    });
    $("undo").addEventListener("click", () => ask({ setup: "undo" }));
    $("save-board").addEventListener("click", () => this.question("save", () => ask({ setup: "save" })));
    const dialog = one(HTMLDialogElement, "ask-setup");
    dialog.addEventListener("close", () => {
      if (dialog.returnValue === "yes") this.next();
      else this.tried = null;
      redraw();
    });
  }

  /** @returns {SetupLine | undefined} */
  get line() {
    const { recorded, states } = this.store;
    return recorded || states.end || states.lost ? undefined : states.setup;
  }

  /** @returns {Limits | null} those of the board, or those that a slider tries */
  get limits() {
    return this.tried ?? this.line?.limits ?? null;
  }

  /**
   * Sets limits on the board; a real one is worth a question, once.
   * @param {Limits | null} limits
   */
  set(limits) {
    if (!limits) return;
    const act = () => {
      this.isAgreed = true;
      this.asked = this.line;
      this.ask({ limits });
    };
    this.tried = limits;
    if (this.isAgreed) act();
    else this.question("set", act);
  }

  /**
   * Does something, after a question unless the board is simulated.
   * @param {keyof typeof QUESTIONS} which
   * @param {() => void} act
   */
  question(which, act) {
    if (this.line?.simulated) return act();
    this.next = act;
    say($("ask-setup-text"), QUESTIONS[which]);
    const dialog = one(HTMLDialogElement, "ask-setup");
    dialog.returnValue = "";
    dialog.showModal();
  }

  draw() {
    const { line } = this;
    if (this.asked && line !== this.asked) {
      this.tried = null;
      this.asked = undefined;
    }
    const offers = Boolean(line && !line.read_only);
    $("tare").hidden = Boolean(line?.read_only);
    $("set-up").hidden = !offers;
    $("set-up").setAttribute("aria-expanded", String(offers && !$("setup").hidden));
    if (!line || !offers) $("setup").hidden = true;
    const limits = this.limits;
    if (!line || !limits || $("setup").hidden) return;
    for (const [name] of LIMITS) {
      const slider = this.sliders.get(name);
      if (slider && document.activeElement !== slider) slider.value = String(limits[name]);
      say($(`value-${name}`), String(limits[name]));
    }
    if (document.activeElement !== this.filter) this.filter.value = limits.filter;
    const shown = this.store.shown();
    say($("passed"), shown ? passed(shown.image, limits) : "");
    one(HTMLButtonElement, "undo").disabled = line.undo === 0;
    one(HTMLButtonElement, "save-board").disabled = !line.unsaved;
    say($("unsaved"), line.unsaved ? "not saved" : "");
  }
}
