// The panels in two dimensions.

import { onPanels, plotPanel } from "./aim.js";
import { fit, make, say } from "./dom.js";
import { palette } from "./colours.js";
import { force } from "./units.js";
import { Raster } from "./raster.js";
import { trace } from "./contours.js";
import { maxima } from "./peaks.js";
import * as marks from "./marks.js";
import { opacity } from "./afterglow.js";
import { folding } from "./folds.js";

const GAP = 8;
const CAPTION = 20;

/**
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./types.d.ts").Garment} Garment
 */

/** The view; `hover` gets the taxel under the pointer. */
export class Panels {
  /**
   * @param {HTMLElement} root
   * @param {import("./hover.js").Hover} hover
   */
  constructor(root, hover) {
    this.root = root;
    this.hover = hover;
    this.key = "";
    /** @type {{ panel: Panel, canvas: HTMLCanvasElement, note: HTMLElement }[]} */
    this.parts = [];
    this.raster = new Raster();
    this.glow = new Raster();
  }

  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Settings} settings
   */
  draw(store, settings) {
    const { garment } = store;
    if (!garment) return;
    this.build(garment, Boolean(store.states.hand));
    const shown = store.shown();
    if (!shown) return;
    const image = settings.held && store.held ? store.held : shown.image;
    const { contacts } = shown.head.frame;
    const glow = settings.glow && !settings.held ? store.glowing() : null;
    const folds = folding(shown, settings);
    for (const { panel, canvas, note } of this.parts) {
      const own = contacts.filter((touch) => touch.panel === panel.index);
      this.panel(canvas, panel, image, settings.held ? [] : own, garment, settings, glow, folds);
      const total = own.reduce((sum, touch) => sum + touch.total, 0);
      say(note, settings.held ? "highest since cleared" : own.length ? force(garment, total) : "");
    }
  }

  /**
   * Creates a figure for each panel, as large as all of them fit.
   * @param {Garment} garment
   * @param {boolean} isPressable
   */
  build(garment, isPressable) {
    const { clientWidth: width, clientHeight: height } = this.root;
    const key = `${garment.key} ${width} ${height} ${isPressable}`;
    if (key === this.key || !width || !height) return;
    this.key = key;
    const scale = bestScale(garment.panels, width, height);
    this.parts = garment.panels.map((panel) => {
      const canvas = make("canvas", {
        tabindex: 0,
        role: "application",
        "aria-label":
          `Pressure on the ${panel.name}, ${panel.rows} rows and ${panel.columns} columns. Arrow keys read taxels.` +
          (isPressable ? " Space presses." : ""),
        style: `width:${panel.columns * panel.mm[0] * scale}px;height:${panel.rows * panel.mm[1] * scale}px`,
      });
      this.hover.watch(canvas, panel);
      return { panel, canvas, note: make("span", { class: "quiet" }) };
    });
    const figure = (/** @type {typeof this.parts[0]} */ { panel, canvas, note }) =>
      make(
        "figure",
        { style: `width:${panel.columns * panel.mm[0] * scale}px` },
        make("figcaption", {}, make("b", {}, panel.name), note),
        canvas,
      );
    this.root.replaceChildren(...this.parts.map(figure));
  }

  /** @param {[number, number]} point of the page */
  aim(point) {
    return onPanels(this.parts, point);
  }

  /** @param {Panel} panel */
  plot(panel) {
    return plotPanel(this.parts, panel);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Panel} panel
   * @param {ArrayLike<number>} image
   * @param {import("./types.d.ts").Contact[]} contacts
   * @param {Garment} garment
   * @param {import("./types.d.ts").Settings} settings
   * @param {Float32Array | null} glow
   * @param {number[]} folds numbers of taxels of the garment
   */
  panel(canvas, panel, image, contacts, garment, settings, glow, folds) {
    const context = fit(canvas);
    if (!context) return;
    const { clientWidth: width, clientHeight: height } = canvas;
    const [sx, sy] = [width / panel.columns, height / panel.rows];
    const { top, smooth } = settings;
    context.clearRect(0, 0, width, height);
    context.imageSmoothingEnabled = smooth;
    context.drawImage(this.raster.paint(image, panel, { top, smooth, absent: garment.absent }), 0, 0, width, height);
    if (glow) context.drawImage(this.glow.shine(glow, image, panel, top, opacity), 0, 0, width, height);
    if (settings.contours) contours(context, image, panel, top, sx, sy);
    marks.folds(context, folds, panel, sx, sy);
    if (settings.peaks) for (const peak of maxima(image, panel, garment.low)) marks.peak(context, peak, sx, sy);
    if (settings.contacts) for (const touch of contacts) marks.contact(context, touch, sx, sy);
    const { place } = this.hover;
    if (place?.panel.index === panel.index) marks.frame(context, place.row, place.column, sx, sy);
  }
}

/**
 * The most pixels per millimetre at which all panels fit, in the best number of rows.
 * @param {Panel[]} panels
 * @param {number} width
 * @param {number} height
 */
function bestScale(panels, width, height) {
  let best = 0;
  for (let across = 1; across <= panels.length; across += 1) {
    const down = Math.ceil(panels.length / across);
    const widest = Math.max(...panels.map((panel) => panel.columns * panel.mm[0]));
    const tallest = Math.max(...panels.map((panel) => panel.rows * panel.mm[1]));
    const [wide, high] = [(width - (across - 1) * GAP) / across, (height - (down - 1) * GAP) / down - CAPTION];
    best = Math.max(best, Math.min((wide - 1) / widest, (high - 1) / tallest));
  }
  return best;
}

/**
 * Draws the contours between the bands of the scale.
 * @param {CanvasRenderingContext2D} context
 * @param {ArrayLike<number>} image
 * @param {Panel} panel
 * @param {number} top
 * @param {number} sx
 * @param {number} sy
 */
function contours(context, image, panel, top, sx, sy) {
  context.save();
  context.scale(sx, sy);
  context.beginPath();
  for (let band = 1; band < palette.bands; band += 1) trace(context, image, panel, (top * band) / palette.bands);
  context.restore();
  context.strokeStyle = "rgb(255 255 255 / 70%)";
  context.lineWidth = 1;
  context.stroke();
}
