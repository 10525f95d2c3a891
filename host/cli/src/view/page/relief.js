// Pressure as a surface in three dimensions: a canvas for what is behind, one for the relief, and the marks upon
// it. `taxel report` shows the same.

import { sight } from "./camera.js";
import { fit, make, say } from "./dom.js";
import { flat, meshOf, raise, STRIDE, under } from "./mesh.js";
import { axes } from "./axes.js";
import { Drawing } from "./drawing.js";
import { Orbit } from "./orbit.js";
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

/** The surface in an element. */
export class Relief {
  /**
   * @param {HTMLElement} root
   * @param {Watch} watch
   */
  constructor(root, watch) {
    this.watch = watch;
    this.back = make("canvas", { "aria-hidden": "true" });
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
    this.stage.append(this.back);
    this.drawing = new Drawing(this.stage, () => {
      this.key = "";
      watch.changed();
    });
    this.stage.append(this.front);
    root.replaceChildren(this.stage);
    this.key = "";
    this.behind = "";
    this.relief = flat(0);
    this.seen = new Float32Array(0);
    this.mesh = meshOf([], [], false);
    /** Pictures drawn so far. */
    this.pictures = 0;
    this.orbit = new Orbit(this.stage, {
      changed: watch.changed,
      point: (at, x, y) => watch.point(at && under(this.seen, this.mesh.faces, ...at), x, y),
    });
  }

  /** Painter of the surface. */
  get painter() {
    return this.drawing.painter;
  }

  /** The camera. */
  get camera() {
    return this.orbit.camera;
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
    const { ratio, size } = this.drawing.sharpness();
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
   * Finds where each taxel is in the picture.
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
}
