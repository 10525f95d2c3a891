// Views, layers, theme and keys.

import { palette } from "./colours.js";
import { $, forgetColours, make, one } from "./dom.js";
import { Follow } from "./follow.js";
import { KEYS as HAND_KEYS } from "./hand.js";
import { KEYS as RECORDED_KEYS } from "./recorder.js";
import { toggleUnit } from "./units.js";

/** Name, label and key of each view. */
const VIEWS = /** @type {const} */ ([
  ["garment", "Garment", "1"],
  ["surface", "3-D", "2"],
  ["body", "Body", "3"],
  ["map", "Map", "4"],
  ["health", "Health", "5"],
]);
/** Parts of the page, by name: a view is one of them, but the garment is the figure with the panels beside it. */
const PARTS = /** @type {const} */ (["body", "panels", "surface", "map", "health"]);
/** Layers of pressure: setting, label, key, description. */
const LAYERS = /** @type {const} */ ([
  ["smooth", "Smooth", "i", "Interpolate between taxels"],
  ["contours", "Contours", "c", "Lines between the bands of pressure"],
  ["contacts", "Contacts", "e", "Ellipses with id, axis and arrow"],
  ["peaks", "Peaks", "p", "Every local maximum"],
  ["folds", "Folds", "f", "Taxels on which the garment folds"],
  ["glow", "Afterglow", "g", "Pressure of the last second, in red, fading"],
  ["held", "Hold", "h", "The highest pressure since it was cleared (x)"],
]);
/** Keys of the live half minute. */
const LIVE_KEYS = [
  ["space", "pause, resume"],
  ["← →", "one image back, forward; with shift one second"],
  ["t", "tare over 32 frames, after a question"],
];
/** Keys apart from these, and those of views and layers. */
const KEYS = [
  ["Tab", "to a panel: arrow keys read its taxels"],
  ["Tab", "to the surface or the robot: arrow keys turn it, Page Up and Page Down move it, Home resets it"],
  ["+ −", "scale"],
  ["a", "fit the scale to the next touch"],
  ["u", "kPa or counts"],
  ["x", "clear what is held"],
  ["s", "save"],
  ["d", "light or dark"],
  ["?", "these keys"],
];
const STORED = "taxel-view";
const TARE = 32;

/** @typedef {typeof LAYERS[number][0]} Layer */

/** The settings, kept by the browser, and the controls that change them. */
export class Controls {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} changed
   */
  constructor(store, ask, changed) {
    this.store = store;
    this.ask = ask;
    this.changed = changed;
    this.follow = new Follow();
    this.followed = "";
    /** @type {import("./types.d.ts").Settings} */
    this.settings = {
      view: "garment",
      smooth: false,
      contours: true,
      contacts: true,
      peaks: true,
      folds: true,
      glow: true,
      held: false,
      top: 0,
      auto: true,
      theme: null,
      keys: true,
    };
    try {
      Object.assign(this.settings, JSON.parse(localStorage.getItem(STORED) ?? "{}"));
    } catch {
      // Without storage the page still works.
    }
    this.buttons();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.set({}));
    this.set({});
  }

  buttons() {
    const tab = (/** @type {typeof VIEWS[number]} */ [name, text, key]) =>
      make(
        "button",
        {
          role: "tab",
          id: `tab-${name}`,
          "aria-controls": name === "garment" ? "view-body view-panels" : `view-${name}`,
          title: `${text} (${key})`,
          click: () => this.set({ view: name }),
          keydown: (event) => this.tabKey(event),
        },
        text,
      );
    $("views").replaceChildren(...VIEWS.map(tab));
    const layer = (/** @type {typeof LAYERS[number]} */ [name, text, key, title]) =>
      make("button", { id: `layer-${name}`, title: `${title} (${key})`, click: () => this.toggle(name) }, text);
    $("layers").replaceChildren(...LAYERS.map(layer));
    const acts = { finer: "-", coarser: "+", unit: "u", theme: "d", help: "?", tare: "t", auto: "a" };
    const asked = one(HTMLDialogElement, "ask-tare");
    asked.addEventListener("close", () => {
      if (asked.returnValue === "tare") this.ask({ tare: TARE });
      asked.returnValue = "";
    });
    const keys = one(HTMLInputElement, "keys-on");
    keys.addEventListener("change", () => this.set({ keys: keys.checked }));
    for (const [id, key] of Object.entries(acts)) $(id).addEventListener("click", () => this.key({ key }));
  }

  /**
   * Keys of the tabs.
   * @param {KeyboardEvent} event
   */
  tabKey(event) {
    const at = VIEWS.findIndex(([name]) => name === this.settings.view);
    /** @type {Record<string, number>} */
    const ways = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: VIEWS.length - 1 };
    const to = ways[event.key];
    if (to === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const [name] = VIEWS[(to + VIEWS.length) % VIEWS.length] ?? VIEWS[0];
    this.set({ view: name });
    $(`tab-${name}`).focus();
  }

  /**
   * The parts that are shown. Where nobody said how the garment lies on a body, the panels stand alone.
   * @returns {string[]}
   */
  get parts() {
    const { view } = this.settings;
    if (view !== "garment") return [view];
    return this.store.states.body ? ["body", "panels"] : ["panels"];
  }

  /** Shows these parts and hides the others. */
  arrange() {
    const { parts } = this;
    for (const name of PARTS) $(`view-${name}`).hidden = !parts.includes(name);
  }

  /** Asks before it tares: a garment that is touched would no longer feel it. */
  tare() {
    if (!this.store.recorded && !this.store.states.setup?.read_only) one(HTMLDialogElement, "ask-tare").showModal();
  }

  /** All keys, including those of the current view. */
  keys() {
    const rows = [
      ...VIEWS.map(([, text, key]) => [key, text]),
      ...(this.store.recorded ? RECORDED_KEYS : LIVE_KEYS),
      ...LAYERS.map(([, , key, title]) => [key, title]),
      ...KEYS,
      ...(this.store.states.hand ? HAND_KEYS : []),
    ];
    const list = rows.flatMap(([key = "", what = ""]) => [make("dt", {}, make("kbd", {}, key)), make("dd", {}, what)]);
    const dialog = one(HTMLDialogElement, "keys");
    dialog.querySelector("dl")?.replaceChildren(...list);
    dialog.showModal();
  }

  /** Adapts the scale to the pressure shown, if that is switched on. */
  scale() {
    const { settings, store } = this;
    const { garment } = store;
    if (!settings.top && palette.start) this.set({ top: palette.start });
    const shown = settings.auto && store.shown();
    if (!shown || !garment) return;
    if (garment.key !== this.followed) this.follow = new Follow();
    this.followed = garment.key;
    const image = settings.held && store.held ? store.held : shown.image;
    const greatest = image.reduce((most, value) => Math.max(most, value), 0);
    const top = this.follow.next(settings.top, greatest, garment.low, palette.ends);
    if (top !== settings.top) this.set({ top });
  }

  /** @param {Layer | "auto"} name */
  toggle(name) {
    if (name === "auto") this.follow = new Follow();
    this.set({ [name]: !this.settings[name] });
  }

  /**
   * Changes settings, and updates the page.
   * @param {Partial<import("./types.d.ts").Settings>} change
   */
  set(change) {
    const { settings } = this;
    Object.assign(settings, change);
    if (!VIEWS.some(([name]) => name === settings.view)) settings.view = "garment";
    const dark = settings.theme ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    document.documentElement.dataset.theme = dark;
    forgetColours();
    for (const [name] of VIEWS) {
      const chosen = name === settings.view;
      $(`tab-${name}`).setAttribute("aria-selected", String(chosen));
      // One tab is a stop of the tabulator; the arrow keys lead to the others.
      $(`tab-${name}`).tabIndex = chosen ? 0 : -1;
    }
    this.arrange();
    for (const [name] of LAYERS) $(`layer-${name}`).setAttribute("aria-pressed", String(settings[name]));
    $("auto").setAttribute("aria-pressed", String(settings.auto));
    one(HTMLInputElement, "keys-on").checked = settings.keys;
    const pressed = !["map", "health"].includes(settings.view);
    $("layers").hidden = $("scale").hidden = !pressed;
    try {
      localStorage.setItem(STORED, JSON.stringify(settings));
    } catch {
      // Without storage the page still works.
    }
    this.changed();
  }

  /** @param {number} factor */
  zoom(factor) {
    const [least, most] = palette.ends;
    this.set({ auto: false, top: Math.max(least, Math.min(most, this.settings.top * factor)) });
  }

  /**
   * True if the key was handled.
   * @param {{ key: string }} event
   */
  key({ key }) {
    /** @type {Record<string, () => void>} */
    const acts = {
      "+": () => this.zoom(2),
      "=": () => this.zoom(2),
      "-": () => this.zoom(0.5),
      u: () => {
        toggleUnit();
        this.set({});
      },
      x: () => {
        this.store.clearHeld();
        this.set({});
      },
      a: () => this.toggle("auto"),
      t: () => this.tare(),
      d: () => this.set({ theme: document.documentElement.dataset.theme === "dark" ? "light" : "dark" }),
      "?": () => this.keys(),
    };
    for (const [name, , its] of VIEWS) acts[its] = () => this.set({ view: name });
    for (const [name, , its] of LAYERS) acts[its] = () => this.toggle(name);
    acts[key]?.();
    return key in acts;
  }
}
