// The view in three dimensions: what the page knows, as a relief.

import { onCloth, plotCloth, pointOf } from "./aim.js";
import { heightOf } from "./mesh.js";
import { maxima } from "./peaks.js";
import { Relief } from "./relief.js";
import { isPascal, pascalsOf } from "./units.js";
import { placeOf } from "./garment.js";

/**
 * @typedef {import("./types.d.ts").Garment} Garment
 * @typedef {import("./types.d.ts").Settings} Settings
 * @typedef {import("./types.d.ts").Shown} Shown
 * @typedef {import("./store.js").Store} Store
 */

/** The view. */
export class Surface {
  /**
   * @param {HTMLElement} root
   * @param {import("./hover.js").Hover} hover
   * @param {() => void} changed
   */
  constructor(root, hover, changed) {
    this.hover = hover;
    /** @type {Garment | null} */
    this.garment = null;
    const point = (/** @type {number | null} */ taxel, /** @type {number} */ x, /** @type {number} */ y) =>
      hover.set(taxel === null || !this.garment ? null : { ...placeOf(this.garment, taxel), x, y });
    this.relief = new Relief(root, { changed, point });
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
    this.last = () => this.relief.draw(this.scene(store, garment, shown, settings));
    this.last();
  }

  /** @param {[number, number]} point of the page */
  aim(point) {
    const { garment, relief } = this;
    return garment && onCloth(garment, relief.stage, { seen: relief.seen, faces: relief.mesh.faces }, point);
  }

  /** @param {import("./types.d.ts").Panel} panel */
  plot(panel) {
    return plotCloth(panel, this.relief.stage, (taxel) => pointOf(this.relief.seen, taxel));
  }

  /**
   * @param {Store} store
   * @param {Garment} garment
   * @param {Shown} shown
   * @param {Settings} settings
   * @returns {import("./relief.js").Scene}
   */
  scene({ held }, garment, shown, settings) {
    const pascal = isPascal(garment);
    const image = settings.held && held ? held : shown.image;
    const highest = heightOf(held ?? image, settings.top);
    const { place } = this.hover;
    return {
      key: garment.key,
      panels: garment.panels,
      absent: garment.absent,
      image,
      top: settings.top,
      highest,
      height: { highest: pascal ? highest * pascalsOf(garment) : highest, unit: pascal ? "kPa" : "counts" },
      peaks: settings.peaks ? peaks(garment, image, shown, settings) : [],
      chosen: place && place.panel.base + place.row * place.panel.columns + place.column,
    };
  }
}

/**
 * Every local maximum; those of contacts have the id.
 * @param {Garment} garment
 * @param {Uint16Array} image
 * @param {Shown} shown
 * @param {Settings} settings
 */
function peaks({ panels, low }, image, shown, { held }) {
  const touches = held ? [] : shown.head.frame.contacts;
  return panels.flatMap((panel) =>
    maxima(image, panel, low).map(({ row, column }) => {
      const touch = touches.find((c) => c.panel === panel.index && c.peak_row === row && c.peak_column === column);
      return { taxel: panel.base + row * panel.columns + column, text: touch ? String(touch.id) : "" };
    }),
  );
}
