// The camera of a scene in three dimensions, moved by pointer, touch and keys.

import { home, nearer, turned } from "./camera.js";

/**
 * @typedef {import("./camera.js").Camera} Camera
 * @typedef {object} OrbitWatch
 * @property {() => void} changed the camera has moved
 * @property {(at: [number, number] | null, x: number, y: number) => void} point the pointer is here, pixels from the
 * left and the top of the stage, and on the page
 */

/** Radians per pixel of a drag, and per press of a key. */
const [DRAG, PRESS] = [0.008, 0.12];
const [WHEEL, CLOSER] = [0.0015, 1.25];

/** A camera, and what moves it. */
export class Orbit {
  /**
   * @param {HTMLElement} stage
   * @param {OrbitWatch} watch
   * @param {Partial<Camera>} first the camera at the beginning, where it is not at home
   * @param {number} [lowest] tilt
   */
  constructor(stage, watch, first = {}, lowest) {
    this.stage = stage;
    this.watch = watch;
    this.first = first;
    this.lowest = lowest;
    /** @type {Camera} */
    this.camera = { ...home(), ...first };
    /** @type {Map<number, [number, number]>} */
    this.pointers = new Map();
    this.listen();
  }

  /** The camera at the beginning. */
  reset() {
    this.camera = { ...home(), ...this.first };
    this.watch.changed();
  }

  listen() {
    const { stage } = this;
    stage.addEventListener("pointerdown", (event) => this.press(event));
    stage.addEventListener("pointermove", (event) => this.move(event));
    for (const kind of /** @type {const} */ (["pointerup", "pointercancel"]))
      stage.addEventListener(kind, ({ pointerId }) => this.pointers.delete(pointerId));
    stage.addEventListener("pointerleave", () => this.watch.point(null, 0, 0));
    stage.addEventListener("dblclick", () => this.reset());
    stage.addEventListener("keydown", (event) => this.key(event));
    stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.closer(Math.exp(-event.deltaY * WHEEL), event);
    });
  }

  /** @param {PointerEvent} event */
  press(event) {
    this.stage.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.watch.point(null, 0, 0);
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { pointerId, clientX: x, clientY: y } = event;
    const before = this.pointers.get(pointerId);
    if (!before) {
      const { left, top } = this.stage.getBoundingClientRect();
      this.watch.point([x - left, y - top], x, y);
      return;
    }
    const other = [...this.pointers].find(([id]) => id !== pointerId)?.[1];
    this.pointers.set(pointerId, [x, y]);
    if (other) {
      const apart = (/** @type {[number, number]} */ at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
      this.closer(apart([x, y]) / apart(before), { clientX: (x + other[0]) / 2, clientY: (y + other[1]) / 2 });
      return;
    }
    this.turn((before[0] - x) * DRAG, (y - before[1]) * DRAG);
  }

  /**
   * Nearer by a factor, about a point of the page or the middle.
   * @param {number} factor
   * @param {{ clientX: number, clientY: number }} [at]
   */
  closer(factor, at) {
    const { left, top, width, height } = this.stage.getBoundingClientRect();
    const place = at ? [at.clientX - left - width / 2, at.clientY - top - height / 2] : [0, 0];
    this.camera = nearer(this.camera, factor, /** @type {[number, number]} */ (place));
    this.watch.changed();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    /** @type {Record<string, () => void>} */
    const acts = {
      ArrowLeft: () => this.turn(PRESS, 0),
      ArrowRight: () => this.turn(-PRESS, 0),
      ArrowUp: () => this.turn(0, -PRESS),
      ArrowDown: () => this.turn(0, PRESS),
      PageUp: () => this.closer(CLOSER),
      PageDown: () => this.closer(1 / CLOSER),
      Home: () => this.reset(),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  /**
   * @param {number} turn
   * @param {number} tilt
   */
  turn(turn, tilt) {
    this.camera = turned(this.camera, turn, tilt, this.lowest);
    this.watch.changed();
  }
}
