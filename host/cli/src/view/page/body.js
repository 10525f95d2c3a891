// Panels laid out on the outline of a body, front and back.

import { colour, fit, make } from "./dom.js";
import { opacity } from "./afterglow.js";
import { Raster } from "./raster.js";
import { label } from "./marks.js";

/** @typedef {[number, number, number, number, number]} Slot */

// Places of regions by words in their names: figure (0 front, 1 back), left edge, top, width, height. A
// figure is 100 high and its middle is 0; the robot's left is on the viewer's right.
/** @type {[RegExp, Slot][]} */
const SLOTS = [
  [/left.*(leg|thigh|shin|foot)/, [0, 3, 55, 10, 40]],
  [/right.*(leg|thigh|shin|foot)/, [0, -13, 55, 10, 40]],
  [/left.*(hand|palm)/, [0, 18, 53, 9, 9]],
  [/right.*(hand|palm)/, [0, -27, 53, 9, 9]],
  [/left.*(arm|sleeve|shoulder|elbow)/, [0, 17.5, 20, 10, 32]],
  [/right.*(arm|sleeve|shoulder|elbow)/, [0, -27.5, 20, 10, 32]],
  [/back|spine/, [1, -14, 20, 28, 33]],
  [/chest|front|torso|belly|breast/, [0, -14, 20, 28, 33]],
  [/head|face/, [0, -5, 3, 10, 11]],
];

/** Regions with unknown names are placed beside the figures, this many per column. */
const BESIDE = 3;

/** The view. */
export class Body {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.canvas = make("canvas", { role: "img", "aria-label": "Panels on the body, front and back" });
    root.append(this.canvas);
    this.raster = new Raster();
    this.glow = new Raster();
  }

  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Settings} settings
   */
  draw(store, settings) {
    const shown = store.shown();
    const { garment } = store;
    const context = shown && garment && fit(this.canvas);
    if (!context) return;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const unit = Math.min((height - 24) / 100, width / 130);
    const middles = [width / 2 - 32 * unit, width / 2 + 32 * unit];
    const top = 22 + (height - 24 - 100 * unit) / 2;
    context.clearRect(0, 0, width, height);
    ["front", "back"].forEach((name, figure) => {
      context.save();
      context.translate(middles[figure] ?? 0, top);
      context.scale(unit, unit);
      outline(context, unit);
      context.restore();
      context.fillStyle = colour("quiet");
      context.font = "12px system-ui, sans-serif";
      context.textAlign = "center";
      context.textBaseline = "bottom";
      context.fillText(name, middles[figure] ?? 0, top - 2);
    });
    const image = settings.held && store.held ? store.held : shown.image;
    const glow = settings.glow && !settings.held ? store.glowing() : null;
    const places = placesOf(garment);
    garment.panels.forEach((panel, index) => {
      const [figure, x, y, w, h] = places[index] ?? [0, 0, 0, 0, 0];
      const [left, upper] = [(middles[figure] ?? 0) + x * unit, top + y * unit];
      const box = /** @type {const} */ ([left, upper, w * unit, h * unit]);
      context.imageSmoothingEnabled = settings.smooth;
      context.drawImage(this.raster.paint(image, panel, { ...settings, absent: garment.absent }), ...box);
      if (glow) context.drawImage(this.glow.shine(glow, image, panel, settings.top, opacity), ...box);
      context.strokeStyle = colour("quiet");
      context.lineWidth = 1;
      context.strokeRect(...box);
      const touches = settings.contacts && !settings.held ? shown.head.frame.contacts : [];
      for (const touch of touches.filter((c) => c.panel === index)) {
        const at = /** @type {const} */ ([
          left + ((touch.x + 0.5) / panel.columns) * box[2],
          upper + ((touch.y + 0.5) / panel.rows) * box[3],
        ]);
        context.beginPath();
        context.arc(at[0], at[1], 11, 0, 2 * Math.PI);
        context.strokeStyle = colour("mark");
        context.lineWidth = 2;
        context.stroke();
        label(context, String(touch.id), ...at);
      }
      context.fillStyle = colour("ink");
      context.font = "12px system-ui, sans-serif";
      context.textAlign = "center";
      context.textBaseline = "top";
      context.fillText(panel.name, left + box[2] / 2, upper + box[3] + 3);
    });
  }
}

/**
 * The place of each panel; panels that share one are stacked in it.
 * @param {import("./types.d.ts").Garment} garment
 * @returns {Slot[]}
 */
function placesOf(garment) {
  const slotOf = (/** @type {import("./types.d.ts").Panel} */ { name, region, link }) => {
    const words = `${region} ${name} ${link}`.toLowerCase().replaceAll("_", " ");
    const own = [region, name, words].map((text) => SLOTS.find(([known]) => known.test(text.toLowerCase())));
    return own.find(Boolean)?.[1] ?? null;
  };
  const slots = garment.panels.map(slotOf);
  let beside = 0;
  return slots.map((slot, index) => {
    if (!slot) {
      const at = beside;
      beside += 1;
      return [1, 32 + Math.floor(at / BESIDE) * 18, 8 + (at % BESIDE) * 30, 15, 24];
    }
    const sharing = slots.filter((other) => other === slot).length;
    const above = slots.slice(0, index).filter((other) => other === slot).length;
    const [figure, x, y, w, h] = slot;
    return [figure, x, y + (h / sharing) * above, w, h / sharing - (sharing > 1 ? 1 : 0)];
  });
}

/**
 * Head, trunk, arms and legs, in units of a figure.
 * @param {CanvasRenderingContext2D} context
 * @param {number} unit
 */
function outline(context, unit) {
  context.beginPath();
  context.ellipse(0, 8, 6, 8, 0, 0, 2 * Math.PI);
  context.roundRect(-16, 18, 32, 37, 6);
  for (const side of [-1, 1]) {
    context.roundRect(side < 0 ? -28.5 : 16.5, 18, 12, 36, 5);
    context.roundRect(side < 0 ? -27 : 18, 55, 9, 9, 4);
    context.roundRect(side < 0 ? -14 : 2, 54, 12, 45, 4);
  }
  context.fillStyle = colour("grid");
  context.fill();
  context.strokeStyle = colour("line");
  context.lineWidth = 1.2 / unit;
  context.stroke();
}
