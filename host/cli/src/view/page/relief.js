// Pressure as a surface in three dimensions: a canvas for what is behind, one for the relief, and the marks upon
// it; the camera; and the pointer and keys that move it. `taxel report` shows the same.

import { home, nearer, sight, turned } from "./camera.js";
import { fit, make, say } from "./dom.js";
import { flat, meshOf, raise, STRIDE, under } from "./mesh.js";
import { axes } from "./axes.js";
import { FlatPainter } from "./relief-flat.js";
import { GlPainter } from "./relief-gl.js";

/**
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./camera.js").Sight} Sight
 * @typedef {object} Scene
 * @property {string} key changes with the panels
 * @property {Panel[]} panels
 * @property {ArrayLike<number>} absent 1 where there is no taxel
 * @property {ArrayLike<number>} image counts
 * @property {number} top end of the colours, counts
 * @property {number} highest end of the heights, counts
 * @property {import("./axes.js").Height} height
 * @property {{ taxel: number, text: string }[]} peaks
 * @property {number | null} chosen a taxel that is marked
 * @typedef {object} Watch
 * @property {() => void} changed the picture is to be drawn again
 * @property {(taxel: number | null, x: number, y: number) => void} point the taxel under the pointer
 */

/** Margins for the texts, pixels. */
const MARGINS = /** @type {[number, number]} */ ([54, 34]);
/** Radians per pixel of a drag, and per press of a key. */
const [DRAG, PRESS] = [0.008, 0.12];
const [WHEEL, CLOSER] = [0.0015, 1.25];
/** Greatest number of pixels drawn for one of the page, in each direction. */
const SHARPEST = 2;

/** The surface in an element. */
export class Relief {
  /**
   * @param {HTMLElement} root
   * @param {Watch} watch
   */
  constructor(root, watch) {
    this.watch = watch;
    this.camera = home();
    this.back = make("canvas", { "aria-hidden": "true" });
    this.body = make("canvas", { "aria-hidden": "true" });
    // Elements, because a canvas of this size that changes takes longer than all the rest.
    this.front = make("div", { class: "marks", "aria-hidden": "true" });
    /** @type {HTMLElement[]} */
    this.marks = [];
    this.stage = make("div", {
      class: "relief",
      tabindex: "0",
      role: "application",
      "aria-label":
        "Pressure as a surface. Arrow keys turn and tilt it, Page Up and Page Down move nearer and farther, Home resets.",
    });
    this.stage.append(this.back, this.body, this.front);
    root.replaceChildren(this.stage);
    this.painter = this.painterOf();
    this.key = "";
    this.behind = "";
    this.relief = flat(0);
    this.seen = new Float32Array(0);
    this.mesh = meshOf([], [], false);
    /** Pictures drawn so far. */
    this.pictures = 0;
    /** @type {Map<number, [number, number]>} */
    this.pointers = new Map();
    this.listen();
  }

  /** @returns {GlPainter | FlatPainter} */
  painterOf() {
    const painter = GlPainter.of(this.body);
    if (!painter) return new FlatPainter(this.renewed());
    // A lost graphics card must not leave a blank picture.
    this.body.addEventListener("webglcontextlost", () => {
      this.painter = new FlatPainter(this.renewed());
      this.key = "";
      this.watch.changed();
    });
    return painter;
  }

  /** Another canvas in the place of the relief's: one that has been asked for WebGL may give nothing else. */
  renewed() {
    const canvas = make("canvas", { "aria-hidden": "true" });
    this.body.replaceWith(canvas);
    this.body = canvas;
    return canvas;
  }

  /**
   * Draws a scene; false if there is no room.
   * @param {Scene} scene
   */
  draw(scene) {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (!width || !height) return false;
    this.build(scene, height > width);
    const { mesh, relief, painter } = this;
    raise(relief, mesh, scene.image, scene);
    const view = sight(this.camera, mesh.box, [width, height], MARGINS);
    const ratio = Math.min(SHARPEST, window.devicePixelRatio || 1);
    const size = /** @type {[number, number]} */ ([Math.round(width * ratio), Math.round(height * ratio)]);
    this.see(view);
    if (painter instanceof GlPainter) painter.draw(view, relief, size);
    else painter.draw(this.seen, relief, size, ratio);
    this.surround(view, scene, [width, height]);
    this.mark(scene);
    this.pictures += 1;
    return true;
  }

  /**
   * Draws what is behind. It is most of the picture, and seldom changes.
   * @param {Sight} view
   * @param {Scene} scene
   * @param {[number, number]} size
   */
  surround(view, { height }, [width, high]) {
    const { theme } = document.documentElement.dataset;
    const key = [this.key, width, high, theme, height.highest, height.unit, JSON.stringify(this.camera)].join(" ");
    const context = key !== this.behind && fit(this.back);
    if (!context) return;
    this.behind = key;
    context.clearRect(0, 0, width, high);
    axes(context, view, this.mesh, height);
  }

  /**
   * @param {Scene} scene
   * @param {boolean} tall
   */
  build({ key, panels, absent }, tall) {
    const own = `${key} ${tall}`;
    if (own === this.key) return;
    this.key = own;
    this.mesh = meshOf(panels, absent, tall);
    this.relief = flat(this.mesh.places.length / 2);
    this.seen = new Float32Array(3 * this.relief.taxels);
    this.painter.build(this.mesh);
  }

  /**
   * Where each taxel is in the picture.
   * @param {Sight} view
   */
  see(view) {
    const { seen, relief, mesh } = this;
    for (let taxel = 0; taxel < relief.taxels; taxel += 1) {
      const [x = 0, y = 0] = [mesh.places[2 * taxel], mesh.places[2 * taxel + 1]];
      seen.set(view.place(x, y, relief.data[STRIDE * taxel] ?? 0), 3 * taxel);
    }
  }

  /**
   * Puts a diamond on each peak, with its text, and a ring on the chosen taxel.
   * @param {Scene} scene
   */
  mark({ peaks, chosen }) {
    const wanted = chosen === null ? peaks : [...peaks, { taxel: chosen, text: "" }];
    while (this.marks.length < wanted.length) this.marks.push(this.front.appendChild(make("b")));
    this.marks.forEach((mark, at) => {
      const one = wanted[at];
      mark.hidden = !one;
      if (!one) return;
      mark.className = at < peaks.length ? "" : "ring";
      say(mark, one.text);
      const [x = 0, y = 0] = this.seen.subarray(3 * one.taxel);
      mark.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }

  /** The pictures' camera at the beginning. */
  reset() {
    this.camera = home();
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
    stage.addEventListener("keydown", (event) => this.key_down(event));
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
      this.watch.point(under(this.seen, this.mesh.faces, x - left, y - top), x, y);
      return;
    }
    const other = [...this.pointers].find(([id]) => id !== pointerId)?.[1];
    this.pointers.set(pointerId, [x, y]);
    if (other) {
      const apart = (/** @type {[number, number]} */ at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
      this.closer(apart([x, y]) / apart(before), { clientX: (x + other[0]) / 2, clientY: (y + other[1]) / 2 });
      return;
    }
    this.camera = turned(this.camera, (before[0] - x) * DRAG, (y - before[1]) * DRAG);
    this.watch.changed();
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
  key_down(event) {
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
    this.camera = turned(this.camera, turn, tilt);
    this.watch.changed();
  }
}
