// The view of the robot's body: the garments of all its boards on its links or, where nobody said how the board's own
// lies, that by regions.

import { onCloth, onPanels, plotCloth, plotPanel, pointOf } from "./aim.js";
import { make } from "./dom.js";
import { placeOf } from "./garment.js";
import { OnRobot } from "./on-robot.js";
import { folding } from "./folds.js";
import { Regions } from "./regions.js";
import { force, isPascal, pascalsOf } from "./units.js";
import { Whole } from "./whole.js";

/**
 * @typedef {import("./types.d.ts").Garment} Garment
 * @typedef {import("./types.d.ts").Settings} Settings
 * @typedef {import("./types.d.ts").Shown} Shown
 * @typedef {import("./on-robot.js").BodyScene} BodyScene
 * @typedef {import("./store.js").Store} Store
 * @typedef {import("./whole.js").Part} Part
 */

/** Longest time for which an image stands for a moment of another board, ms. */
const STANDS_MS = 500;

/** The view. */
export class Body {
  /**
   * @param {HTMLElement} root
   * @param {import("./hover.js").Hover} hover
   * @param {import("./others.js").Others} others
   * @param {() => void} changed
   */
  constructor(root, hover, others, changed) {
    this.hover = hover;
    this.others = others;
    this.whole = new Whole();
    /** @type {Garment | null} */
    this.garment = null;
    this.robot = make("div", { class: "robot" });
    this.plain = make("div", { class: "plain", tabindex: "0", role: "group", "aria-label": "Panels by region" });
    root.append(this.robot, this.plain);
    // The taxels of the board's own garment come first; those of others are read on their own pages.
    const point = (/** @type {number | null} */ taxel, /** @type {number} */ x, /** @type {number} */ y) => {
      const { garment } = this;
      const isOwn = taxel !== null && garment && taxel < garment.taxels;
      hover.set(isOwn ? { ...placeOf(garment, taxel), x, y } : null);
    };
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
    const shown = store.shown();
    if (!garment || !shown) return;
    this.garment = garment;
    const parts = this.parts(store, garment, shown, settings);
    const isKnown = parts.some(({ body }) => body);
    this.robot.hidden = !isKnown;
    this.plain.hidden = isKnown;
    this.robot.classList.toggle("whole", parts.length > 1);
    this.last = isKnown
      ? () => this.onRobot.draw({ ...this.scene(garment, parts, settings), figure: store.states.figure ?? null })
      : () => this.regions.draw(store, settings);
    this.last();
  }

  /** @param {[number, number]} point of the page */
  aim(point) {
    const { garment, regions, onRobot } = this;
    if (!garment) return null;
    if (this.robot.hidden) return onPanels(regions.drawn(), point);
    for (const { seen } of onRobot.aspects) {
      const spot = onRobot.cloth && onCloth(garment, onRobot.stage, { ...onRobot.cloth, seen }, point);
      if (spot) return spot;
    }
    return null;
  }

  /** @param {import("./types.d.ts").Panel} panel */
  plot(panel) {
    if (this.robot.hidden) return plotPanel(this.regions.drawn(), panel);
    const { aspects, cloth, stage, standing } = this.onRobot;
    return plotCloth(panel, stage, (taxel) => {
      const corner = cloth?.taxels.indexOf(taxel) ?? -1;
      const normal = standing?.normals.subarray(3 * corner, 3 * corner + 3) ?? [];
      const facesIt = (/** @type {import("./on-robot.js").Aspect} */ { viewer }) =>
        viewer.reduce((sum, part, axis) => sum + part * (normal[axis] ?? 0), 0) > 0;
      const aspect = aspects.find(facesIt);
      return corner < 0 || !aspect ? null : pointOf(aspect.seen, corner);
    });
  }

  /**
   * The boards of the robot, the page's own first.
   * @param {Store} store
   * @param {Garment} garment
   * @param {Shown} shown
   * @param {Settings} settings
   * @returns {Part[]}
   */
  parts(store, garment, shown, settings) {
    const { robot } = store.states;
    const isLive = (/** @type {string} */ board) => robot?.boards.find(({ name }) => name === board)?.state === "live";
    const own = partOf(robot?.board ?? "", store, garment, shown, settings);
    const moment = store.paused ? shown.head.came : Infinity;
    const others = (robot?.boards ?? []).flatMap(({ name }) => {
      const other = this.others.of(name);
      const theirs = other?.garment;
      if (!other || !theirs) return [];
      const then = other.newestAt(moment);
      const stands = then && (store.paused ? moment - then.head.came < STANDS_MS : isLive(name));
      return [partOf(name, other, theirs, stands ? then : null, settings, garment)];
    });
    if (robot && others.length && !store.paused && !isLive(robot.board)) Object.assign(own, { image: null, pressing: null });
    return [own, ...others];
  }

  /**
   * @param {Garment} garment
   * @param {Part[]} parts
   * @param {Settings} settings
   * @returns {Omit<BodyScene, "figure">}
   */
  scene(garment, parts, settings) {
    const { place } = this.hover;
    const [own] = parts;
    const { body, image } = own ?? {};
    const alone = parts.length === 1 && own && body && image && { ...own, body, image, unknown: null };
    return {
      ...(alone || this.whole.scene(parts)),
      top: settings.top,
      force: (counts) => force(garment, counts),
      chosen: place && place.panel.base + place.row * place.panel.columns + place.column,
    };
  }
}

/**
 * A board of the robot.
 * @param {string} name
 * @param {Store} store
 * @param {Garment} garment
 * @param {Shown | null} shown null if it is not known what presses
 * @param {Settings} settings
 * @param {Garment} shows the garment whose counts are those of the picture
 * @returns {Part}
 */
function partOf(name, { held, states }, garment, shown, settings, shows = garment) {
  const { body } = states;
  const image = settings.held && held ? held : shown?.image;
  const isPressing = settings.contacts && !settings.held;
  return {
    name,
    panels: garment.panels,
    body: body && body.taxels.length === garment.taxels ? body : null,
    // An image from before the page was opened has none of its own.
    poses: (shown?.head.poses ?? states.poses)?.links ?? null,
    image: (shown && image) ?? null,
    pressing: isPressing ? (shown?.head.frame.pressing ?? null) : null,
    folding: shown ? folding(shown, settings) : [],
    scale: scaleOf(garment, shows),
  };
}

/**
 * Counts of one garment for a count of another: of equal pressure, and of equal force.
 * @param {Garment} of
 * @param {Garment} shows
 */
function scaleOf(of, shows) {
  const pressure = isPascal(of) && isPascal(shows) ? pascalsOf(of) / pascalsOf(shows) : 1;
  const [own, shown] = [of.counts_per_newton ?? 0, shows.counts_per_newton ?? 0];
  return { pressure, force: own > 0 && shown > 0 ? shown / own : 1 };
}
