// The taxel under the pointer, or under the cursor moved by the arrow keys.

import { make } from "./dom.js";
import { pressure } from "./units.js";

/** @typedef {import("./types.d.ts").Place} Place */

/**
 * Rows and columns that the arrow keys go.
 * @type {Record<string, [number, number]>}
 */
const WAYS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };

/** The selected taxel and the note beside it. `ask` sends requests to the program, which then sends its raw code. */
export class Hover {
  /**
   * @param {HTMLElement} element
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} changed
   */
  constructor(element, ask, changed) {
    this.element = element;
    this.ask = ask;
    this.changed = changed;
    /** @type {Place | null} */
    this.place = null;
  }

  /**
   * Watches the canvas of a panel.
   * @param {HTMLCanvasElement} canvas
   * @param {import("./types.d.ts").Panel} panel
   */
  watch(canvas, panel) {
    const at = (/** @type {PointerEvent} */ event) => {
      const { left, top, width, height } = canvas.getBoundingClientRect();
      const column = Math.floor(((event.clientX - left) / width) * panel.columns);
      const row = Math.floor(((event.clientY - top) / height) * panel.rows);
      this.set({ panel, row, column, x: event.clientX, y: event.clientY });
    };
    canvas.addEventListener("pointermove", at);
    canvas.addEventListener("pointerdown", at);
    canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && this.set(null));
    canvas.addEventListener("blur", () => this.set(null));
    canvas.addEventListener("keydown", (event) => this.key(event, canvas, panel));
  }

  /**
   * @param {KeyboardEvent} event
   * @param {HTMLCanvasElement} canvas
   * @param {import("./types.d.ts").Panel} panel
   */
  key(event, canvas, panel) {
    const way = WAYS[event.key];
    if (event.key === "Escape") this.set(null);
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    this.go(canvas, panel, way);
  }

  /**
   * Chooses the taxel so many rows and columns from the chosen one, or from the middle of the panel.
   * @param {HTMLCanvasElement} canvas
   * @param {import("./types.d.ts").Panel} panel
   * @param {[number, number]} way
   */
  go(canvas, panel, way) {
    const here = this.place?.panel.index === panel.index ? this.place : null;
    const { row, column } = here ?? { row: panel.rows >> 1, column: panel.columns >> 1 };
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const next = { panel, row: row + way[0], column: column + way[1] };
    const x = left + ((next.column + 0.5) / panel.columns) * width;
    const y = top + ((next.row + 0.5) / panel.rows) * height;
    this.set({ ...next, x, y, byKeys: true });
  }

  /** @param {Place | null} place */
  set(place) {
    const inside = (/** @type {Place} */ p) =>
      p.row >= 0 && p.column >= 0 && p.row < p.panel.rows && p.column < p.panel.columns;
    if (place && !inside(place)) return;
    const taxel = (/** @type {Place | null} */ p) => (p ? p.panel.base + p.row * p.panel.columns + p.column : null);
    const before = taxel(this.place);
    this.place = place;
    if (taxel(place) !== before) this.ask({ hover: taxel(place) });
    this.changed();
  }

  /**
   * The taxel that the keys have chosen, in words; null if there is none.
   * @param {import("./store.js").Store} store
   */
  text(store) {
    const { place } = this;
    const { garment } = store;
    const shown = store.shown();
    if (!place?.byKeys || !garment || !shown) return null;
    const { panel, row, column } = place;
    const counts = shown.image[panel.base + row * panel.columns + column] ?? 0;
    return `${panel.name}, row ${row}, column ${column}: ${pressure(garment, counts)}`;
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const { element, place } = this;
    element.hidden = !place;
    const shown = store.shown();
    const { garment, states } = store;
    if (!place || !shown || !garment) return;
    const taxel = place.panel.base + place.row * place.panel.columns + place.column;
    const drawn = states.taxel?.taxel === taxel ? states.taxel : null;
    const counts = shown.image[taxel] ?? 0;
    const waits = store.recorded ? "not recorded" : "waiting …";
    const rows = [
      ["pressure", pressure(garment, counts)],
      ["counts", String(counts)],
      ["raw code", !store.recorded && store.paused ? "live only" : (drawn?.code ?? waits)],
      ["health", store.faulty().get(taxel) ?? "good"],
      ["highest", pressure(garment, store.held?.[taxel] ?? 0)],
      ["wired", wiredText(drawn)],
    ];
    element.replaceChildren(
      make("b", {}, `${place.panel.name}, row ${place.row}, column ${place.column}`),
      make("dl", {}, ...rows.flatMap(([name, value]) => [make("dt", {}, String(name)), make("dd", {}, String(value))])),
    );
    const { offsetWidth: width, offsetHeight: height } = element;
    const left = place.x + 18 + width > innerWidth ? place.x - 18 - width : place.x + 18;
    const top = Math.min(innerHeight - height - 6, place.y + 14);
    element.style.transform = `translate(${Math.max(4, left)}px, ${Math.max(4, top)}px)`;
    element.style.left = element.style.top = "0";
  }
}

/**
 * Wiring of a taxel, if it is known.
 * @param {import("./types.d.ts").TaxelState | null} drawn
 */
function wiredText(drawn) {
  if (!drawn || drawn.block === null) return "–";
  return `block ${drawn.block}, row ${drawn.wired_row}, column ${drawn.wired_column}`;
}
