// The tools that press a simulated garment, the scripts that press it, and what can be done with the touches by hand.

import { $, draw, make, one, say } from "./dom.js";
import { shortForce, turnedBy } from "./force-law.js";
import { icon } from "./outline.js";

/**
 * @typedef {import("./force-law.js").Tool} Tool
 * @typedef {import("./messages.d.ts").HandLine} HandLine
 */

/** A turn of the tool, degrees. */
const TURN = 15;
/** Time for which a change by keys is spoken, ms. */
const SPOKEN_MS = 2000;

/** A force in words. */
export const newtons = (/** @type {number} */ force) => `${force >= 10 ? force.toFixed(0) : force.toFixed(1)} N`;

/** The palette. */
export class Tools {
  /**
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} changed
   */
  constructor(ask, changed) {
    this.changed = changed;
    /** @type {HandLine | null} */
    this.hand = null;
    this.chosen = 0;
    /** Multiple of the tools' forces. */
    this.factor = 1;
    /** Direction of the tool's length from +x towards +y, degrees. */
    this.angle = 0;
    this.key = "";
    /** @type {HTMLElement[]} */
    this.buttons = [];
    /** Change by the keys, and when, ms. */
    this.keyed = { text: "", at: -Infinity };
    const script = one(HTMLSelectElement, "script");
    $("play-script").addEventListener("click", () => script.value && ask({ script: script.value }));
    $("again").addEventListener("click", () => ask({ hand: "again" }));
    $("clear").addEventListener("click", () => ask({ hand: "clear" }));
    $("tools").addEventListener("keydown", (event) => this.toolKey(event));
  }

  /**
   * The tool that is chosen; null before the program has named any.
   * @returns {Tool | null}
   */
  get tool() {
    return this.hand?.tools[this.chosen] ?? null;
  }

  /** @param {number} tool */
  choose(tool) {
    const count = this.hand?.tools.length ?? 1;
    this.chosen = (tool + count) % count;
    this.changed();
  }

  /** @param {number} notches of the wheel, below 0 for less force */
  strengthen(notches) {
    this.factor = turnedBy(this.factor, notches);
    this.changed();
  }

  /** @param {number} steps */
  turn(steps) {
    this.angle = (this.angle + 180 + steps * TURN) % 180;
    this.changed();
  }

  /**
   * Keys among the tools.
   * @param {KeyboardEvent} event
   */
  toolKey(event) {
    const way = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.choose(this.chosen + way);
    this.mark();
    this.buttons[this.chosen]?.focus();
  }

  /**
   * True if the key was handled.
   * @param {{ key: string }} event
   */
  press({ key }) {
    /** @type {Record<string, () => void>} */
    const acts = {
      "[": () => this.choose(this.chosen - 1),
      "]": () => this.choose(this.chosen + 1),
      ",": () => this.strengthen(-1),
      ".": () => this.strengthen(1),
      "{": () => this.turn(-1),
      "}": () => this.turn(1),
    };
    if (!acts[key] || !this.tool) return false;
    acts[key]();
    const force = newtons(shortForce(this.tool, this.factor));
    this.keyed = { text: `${this.tool.name}, ${force}, ${this.angle} degrees`, at: performance.now() };
    return true;
  }

  /**
   * Change that the keys have just made, in words; null if that is long ago.
   * @param {number} now ms
   */
  text(now) {
    return now - this.keyed.at < SPOKEN_MS ? this.keyed.text : null;
  }

  /**
   * @param {HandLine | null} hand null where nothing can be pressed
   * @param {number | null} force of a touch that presses, N
   */
  draw(hand, force) {
    $("hand").hidden = !hand;
    this.hand = hand;
    if (!hand) return;
    const key = JSON.stringify([hand.tools, hand.scripts]);
    if (key !== this.key) this.build(hand);
    this.key = key;
    this.mark();
    const { tool } = this;
    say($("tool-force"), tool ? newtons(force ?? shortForce(tool, this.factor)) : "");
    say($("play-script"), hand.playing === null ? "Play" : "Playing");
    // It keeps its place: a picture that moves is missed by the finger.
    $("pressed").style.visibility = hand.touches > 0 ? "" : "hidden";
  }

  /** @param {HandLine} hand */
  build({ tools, scripts }) {
    this.buttons = tools.map((tool, at) => {
      const [length, width] = tool.size_mm;
      const size = length === width ? `${length} mm` : `${length} x ${width} mm`;
      const title = `${size}; ${newtons(tool.force_n)}, by a long press up to ${newtons(tool.most_n)} ([ and ])`;
      const { d, length: long } = icon(tool);
      const wide = Math.ceil(long) + 2;
      const image = draw("svg", { viewBox: `${-wide / 2} -8 ${wide} 16`, width: wide, height: 16, "aria-hidden": "true" });
      image.append(draw("path", { d, fill: "none", stroke: "currentColor", "stroke-width": 1.5 }));
      return make("button", { role: "radio", title, click: () => this.choose(at) }, image, tool.name);
    });
    $("tools").replaceChildren(...this.buttons);
    $("scripts").hidden = !scripts.length;
    const options = scripts.map(({ name, title }) => make("option", { value: name }, title));
    one(HTMLSelectElement, "script").replaceChildren(...options);
  }

  mark() {
    this.buttons.forEach((button, at) => {
      button.setAttribute("aria-checked", String(at === this.chosen));
      button.tabIndex = at === this.chosen ? 0 : -1;
    });
  }
}
