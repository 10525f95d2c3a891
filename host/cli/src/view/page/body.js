// The view of the robot's body: the garment on its links or, where nobody said how it lies, by regions.

import { make } from "./dom.js";
import { placeOf } from "./garment.js";
import { OnRobot } from "./on-robot.js";
import { folding } from "./folds.js";
import { Regions } from "./regions.js";
import { force } from "./units.js";

/**
 * @typedef {import("./types.d.ts").Garment} Garment
 * @typedef {import("./types.d.ts").Settings} Settings
 * @typedef {import("./types.d.ts").Shown} Shown
 * @typedef {import("./store.js").Store} Store
 */

/** The view. */
export class Body {
  /**
   * @param {HTMLElement} root
   * @param {import("./hover.js").Hover} hover
   * @param {() => void} changed
   */
  constructor(root, hover, changed) {
    this.hover = hover;
    /** @type {Garment | null} */
    this.garment = null;
    this.robot = make("div", { class: "robot" });
    this.plain = make("div", { class: "plain", tabindex: "0", role: "group", "aria-label": "Panels by region" });
    root.append(this.robot, this.plain);
    const point = (/** @type {number | null} */ taxel, /** @type {number} */ x, /** @type {number} */ y) =>
      hover.set(taxel === null || !this.garment ? null : { ...placeOf(this.garment, taxel), x, y });
    this.onRobot = new OnRobot(this.robot, { changed, point });
    this.regions = new Regions(this.plain);
    // A picture of WebGL lasts until the browser has shown it: whoever saves it has it drawn again.
    root.addEventListener("picture", () => this.last?.());
  }

  /**
   * @param {Store} store
   * @param {Settings} settings
   */
  draw(store, settings) {
    const { garment } = store;
    const { body } = store.states;
    const shown = store.shown();
    if (!garment || !shown) return;
    this.garment = garment;
    const known = body && body.taxels.length === garment.taxels ? body : null;
    this.robot.hidden = !known;
    this.plain.hidden = Boolean(known);
    this.last = known
      ? () => this.onRobot.draw(this.scene(store, garment, shown, settings, known))
      : () => this.regions.draw(store, settings);
    this.last();
  }

  /**
   * @param {Store} store
   * @param {Garment} garment
   * @param {Shown} shown
   * @param {Settings} settings
   * @param {import("./types.d.ts").BodyState} body
   * @returns {import("./on-robot.js").BodyScene}
   */
  scene({ held, states }, garment, shown, settings, body) {
    const { place } = this.hover;
    const { frame, poses } = shown.head;
    return {
      body,
      // An image from before the page was opened has none of its own.
      poses: (poses ?? states.poses)?.links ?? null,
      panels: garment.panels,
      image: settings.held && held ? held : shown.image,
      top: settings.top,
      pressing: settings.contacts && !settings.held ? (frame.pressing ?? null) : null,
      folding: folding(shown, settings),
      force: (counts) => force(garment, counts),
      chosen: place && place.panel.base + place.row * place.panel.columns + place.column,
    };
  }
}
