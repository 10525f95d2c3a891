// The panels by region of the garment, where it is not known how they lie on the robot: each to scale, and what is felt
// there in words.

import { fit, make, say } from "./dom.js";
import { Raster } from "./raster.js";
import { force, pressure } from "./units.js";

/**
 * @typedef {import("./types.d.ts").Garment} Garment
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./types.d.ts").Contact} Contact
 */

/** Longest side of a panel, pixels. */
const LONGEST = 150;

/** The view. */
export class Regions {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.list = make("ul", { class: "regions" });
    this.note = make(
      "p",
      { class: "quiet" },
      "How the panels lie on a robot is not known: start with --body, and --robot for its posture.",
    );
    root.append(this.note, this.list);
    this.key = "";
    /** @type {{ name: string, panels: { panel: Panel, canvas: HTMLCanvasElement }[], state: HTMLElement }[]} */
    this.parts = [];
    this.raster = new Raster();
  }

  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Settings} settings
   */
  draw(store, settings) {
    const shown = store.shown();
    const { garment } = store;
    if (!shown || !garment) return;
    this.build(garment);
    const image = settings.held && store.held ? store.held : shown.image;
    const { contacts } = shown.head.frame;
    for (const { name, panels, state } of this.parts) {
      for (const { panel, canvas } of panels) {
        const context = fit(canvas);
        if (!context) continue;
        const { clientWidth: width, clientHeight: height } = canvas;
        context.clearRect(0, 0, width, height);
        context.imageSmoothingEnabled = settings.smooth;
        context.drawImage(this.raster.paint(image, panel, { ...settings, absent: garment.absent }), 0, 0, width, height);
      }
      say(state, stateOf(garment, contacts.filter((touch) => touch.region === name)));
    }
  }

  /** The panels and their pictures. */
  drawn() {
    return this.parts.flatMap(({ panels }) => panels);
  }

  /** @param {Garment} garment */
  build(garment) {
    if (garment.key === this.key) return;
    this.key = garment.key;
    const longest = Math.max(...garment.panels.flatMap(({ rows, columns, mm }) => [rows * mm[1], columns * mm[0]]));
    const scale = LONGEST / longest;
    const names = [...new Set(garment.panels.map(({ region }) => region))];
    this.parts = names.map((name) => {
      const panels = garment.panels.filter(({ region }) => region === name);
      return { name, panels: panels.map((panel) => ({ panel, canvas: canvasOf(panel, scale) })), state: make("p") };
    });
    this.list.replaceChildren(
      ...this.parts.map(({ name, panels, state }) => {
        const figures = panels.map(({ panel, canvas }) =>
          make("figure", {}, ...(panel.name === name ? [] : [make("figcaption", {}, panel.name)]), canvas),
        );
        return make("li", {}, make("h2", {}, name), state, make("div", {}, ...figures));
      }),
    );
  }
}

/**
 * @param {Panel} panel
 * @param {number} scale pixels per mm
 */
function canvasOf({ name, rows, columns, mm }, scale) {
  return make("canvas", {
    role: "img",
    "aria-label": `Pressure on the ${name}`,
    style: `width:${columns * mm[0] * scale}px;height:${rows * mm[1] * scale}px`,
  });
}

/**
 * Touch that is felt in a region, in words.
 * @param {Garment} garment
 * @param {Contact[]} contacts
 */
export function stateOf(garment, contacts) {
  if (!contacts.length) return "no contact";
  const count = contacts.length === 1 ? "1 contact" : `${contacts.length} contacts`;
  const total = contacts.reduce((sum, touch) => sum + touch.total, 0);
  const peak = Math.max(...contacts.map((touch) => touch.peak));
  return `${count}, ${force(garment, total)}, at most ${pressure(garment, peak)}`;
}
