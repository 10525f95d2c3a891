// Hands on a simulated garment: mouse, pen, fingers and the keyboard press where they meet it in the picture.

import { $ } from "./dom.js";
import { Finger } from "./finger.js";
import { newtons } from "./tools.js";
import { ToolMarks } from "./tool-marks.js";

/**
 * @typedef {import("./types.d.ts").Plot} Plot
 * @typedef {import("./types.d.ts").Spot} Spot
 * @typedef {import("./types.d.ts").View} View
 * @typedef {import("./tool-marks.js").Mark} Mark
 */

/** Keys, for the list of keys. */
export const KEYS = [
  ["Tab", "to a panel: space presses the taxel that the arrow keys have chosen, as long as it is down"],
  ["[ ]", "tool that presses"],
  [", .", "press less, harder; also the wheel over the garment"],
  ["{ }", "turn the tool; also the wheel with shift"],
];
/** Views in which the garment is pressed. */
const VIEWS = ["panels", "surface", "body"];
/** Numbers of the fingers that can press at a time. */
const NUMBERS = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];
/** Distance of a notch of the wheel by the unit in which the browser reports it: pixels, lines, pages. */
const NOTCH = [100, 3, 1];

/** Pointers and keys that press. */
export class Hand {
  /**
   * @param {object} page
   * @param {import("./store.js").Store} page.store
   * @param {import("./types.d.ts").Ask} page.ask
   * @param {import("./hover.js").Hover} page.hover
   * @param {import("./tools.js").Tools} page.tools
   * @param {() => View[]} page.views those that are shown
   */
  constructor({ store, ask, hover, tools, views }) {
    this.store = store;
    this.ask = ask;
    this.hover = hover;
    this.tools = tools;
    this.views = views;
    this.marks = new ToolMarks();
    /** @type {Finger[]} */
    this.fingers = [];
    /** @type {Map<number, Finger | null>} pointers that are down; null where they have left the garment */
    this.pointers = new Map();
    /** @type {Finger | null} that of the keyboard */
    this.keyed = null;
    /** @type {PointerEvent | null} of a pointer that is not down */
    this.pointed = null;
    this.hasPressed = false;
    this.listen();
  }

  /** True if something can be pressed now: the picture is that of a simulated board, and live. */
  get offers() {
    const { states, paused, recorded } = this.store;
    return Boolean(states.hand && !recorded && !paused && !states.lost && !states.end && this.hasGarment);
  }

  /** True if a view shows the garment. */
  get hasGarment() {
    return this.views().some(({ aim }) => aim);
  }

  /** Offer of the palette: it stays while the picture stands still. */
  get offered() {
    return this.store.recorded || !this.hasGarment ? null : (this.store.states.hand ?? null);
  }

  /** Force of the newest touch, N; null if nothing presses. */
  get force() {
    return this.fingers.at(-1)?.force ?? null;
  }

  listen() {
    const first = { capture: true, passive: false };
    for (const root of VIEWS.map((name) => $(`view-${name}`))) {
      root.addEventListener("pointerdown", (event) => this.press(event), first);
      root.addEventListener("pointermove", (event) => this.point(event));
      root.addEventListener("pointerleave", () => (this.pointed = null));
      // What scrolls the page beside the garment presses on it.
      root.addEventListener("touchstart", (event) => this.aim(event.changedTouches[0]) && event.preventDefault(), first);
      root.addEventListener("wheel", (event) => this.wheel(event), first);
      root.addEventListener("dblclick", (event) => this.aim(event) && event.stopPropagation(), first);
      root.addEventListener("keydown", (event) => this.keyDown(event), first);
      root.addEventListener("focusout", () => this.keyUp());
    }
    window.addEventListener("pointermove", (event) => this.pointers.has(event.pointerId) && this.follow(event), first);
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
      window.addEventListener(kind, (event) => this.lift(event), first);
    window.addEventListener("keyup", ({ key }) => key === " " && this.keyUp(), first);
    window.addEventListener("blur", () => this.drop());
    document.addEventListener("visibilitychange", () => document.hidden && this.drop());
  }

  /**
   * Spot at which a pointer meets the garment, if it can be pressed.
   * @param {{ clientX: number, clientY: number } | null | undefined} event
   * @returns {Spot | null}
   */
  aim(event) {
    if (!event || !this.offers) return null;
    for (const view of this.views()) {
      const spot = view.aim?.([event.clientX, event.clientY]);
      if (spot) return spot;
    }
    return null;
  }

  /** @param {PointerEvent} event */
  press(event) {
    if (event.button !== 0 || !this.aim(event)) return;
    // Beside the garment a pointer turns the picture.
    if (event.target instanceof Element) event.target.setPointerCapture(event.pointerId);
    this.hover.set(null);
    this.pointed = null;
    this.pointers.set(event.pointerId, null);
    this.follow(event);
  }

  /**
   * A pointer that is down has moved.
   * @param {PointerEvent} event
   */
  follow(event) {
    event.stopPropagation();
    const { pointerId, timeStamp: now } = event;
    const spot = this.aim(event);
    let finger = this.pointers.get(pointerId) ?? null;
    if (finger && finger.panel.index !== spot?.panel.index) finger.lift(now);
    if (finger?.lifted !== null) finger = null;
    const isNew = !finger && spot;
    if (finger && spot) finger.move(spot.at, now);
    if (isNew) finger = this.touch(spot, now);
    if (finger && event.pointerType === "pen") finger.pressure = event.pressure;
    if (finger && isNew) this.send(finger, now);
    this.pointers.set(pointerId, finger);
  }

  /** @param {PointerEvent} event */
  lift(event) {
    this.pointers.get(event.pointerId)?.lift(event.timeStamp);
    if (this.pointers.delete(event.pointerId)) this.point(event);
  }

  /** @param {PointerEvent} event */
  point(event) {
    this.pointed = event.pointerType === "touch" ? null : event;
  }

  /**
   * A new touch; null if all fingers press.
   * @param {Spot} spot
   * @param {number} now ms
   */
  touch(spot, now) {
    const { tool, factor, angle } = this.tools;
    const used = this.fingers.map((finger) => finger.number);
    const number = NUMBERS.find((one) => !used.includes(one));
    if (!tool || number === undefined) return null;
    const finger = new Finger({ number, tool, spot, factor, angle, now });
    this.fingers.push(finger);
    this.hasPressed = true;
    return finger;
  }

  /**
   * @param {Finger} finger
   * @param {number} now ms
   */
  send(finger, now) {
    const request = finger.next(now);
    if (request) this.ask(request);
  }

  /** All fingers lift at once. */
  drop() {
    for (const { number } of this.fingers) this.ask({ release: number });
    this.fingers = [];
    this.pointers.clear();
    this.keyed = null;
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    // With control it is a pinch: nearer or farther.
    if (event.ctrlKey || !this.aim(event)) return;
    event.preventDefault();
    event.stopPropagation();
    const notches = -(event.deltaY || event.deltaX) / (NOTCH[event.deltaMode] ?? 1);
    if (event.shiftKey) this.tools.turn(Math.sign(notches));
    else this.tools.strengthen(notches);
    for (const finger of this.fingers) finger.factor = this.tools.factor;
  }

  /** @param {KeyboardEvent} event */
  keyDown(event) {
    const { target, key, ctrlKey, altKey, metaKey } = event;
    if (key !== " " || ctrlKey || altKey || metaKey || !(target instanceof HTMLCanvasElement)) return;
    const { left, top, width, height } = target.getBoundingClientRect();
    const panel = this.aim({ clientX: left + width / 2, clientY: top + height / 2 })?.panel;
    const hasChosen = this.hover.place?.byKeys && this.hover.place.panel.index === panel?.index;
    // After a click the panel has the focus, too, and space is the page's.
    if (!panel || (!hasChosen && !target.matches(":focus-visible"))) return;
    event.preventDefault();
    event.stopPropagation();
    if (event.repeat || this.keyed) return;
    if (!hasChosen) this.hover.go(target, panel, [0, 0]);
    const spot = this.chosen();
    this.keyed = spot && this.touch(spot, event.timeStamp);
    if (this.keyed) this.send(this.keyed, event.timeStamp);
  }

  keyUp() {
    this.keyed?.lift(performance.now());
    this.keyed = null;
  }

  /**
   * The taxel that the keys have chosen.
   * @returns {Spot | null}
   */
  chosen() {
    const { place } = this.hover;
    return place?.byKeys ? { panel: place.panel, at: [place.column, place.row] } : null;
  }

  /**
   * A frame of the screen: sends the program what has changed, and draws the tools.
   * @param {number} now ms
   */
  frame(now) {
    if (!this.offers) this.drop();
    const spot = this.chosen();
    if (this.keyed && spot) this.keyed.move(spot.at, now);
    else this.keyUp();
    this.fingers = this.fingers.filter((finger) => {
      const isOver = finger.isOver(now);
      if (isOver) this.ask({ release: finger.number });
      else this.send(finger, now);
      return !isOver;
    });
    this.draw();
  }

  draw() {
    const { tool, angle } = this.tools;
    const pointed = this.aim(this.pointed);
    document.body.classList.toggle("aimed", Boolean(pointed));
    const spots = [pointed, this.offers && !this.keyed ? this.chosen() : null];
    /** @type {Mark[]} */
    const marks = spots.flatMap((spot) => (spot && tool ? [{ tool, angle, spot, text: "" }] : []));
    for (const finger of this.fingers) {
      marks.push({ tool: finger.tool, angle: finger.angle, spot: finger, text: newtons(finger.force) });
    }
    const plotted = (/** @type {View} */ view) =>
      marks.map((mark) => /** @type {[Mark, Plot | undefined]} */ ([mark, view.plot?.(mark.spot.panel)]));
    this.marks.draw(this.views().flatMap(plotted));
    $("invite").hidden = !this.offers || this.hasPressed || Boolean(this.offered?.touches);
  }
}
