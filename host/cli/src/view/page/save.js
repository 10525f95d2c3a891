// Saves a picture, this moment's numbers, or a recording of the live half minute or of the range.

import { address, worker } from "./channel.js";
import { $, colour, contextOf, make } from "./dom.js";
import { diamond, label } from "./marks.js";

/** Margin of a saved picture, pixels. */
const MARGIN = 12;
/** Elements of a view that a picture has. */
const DRAWN = "canvas, svg, figcaption b, .marks b, .regions :is(h2, p, figcaption), .note";

/** The menu. `context` has the store and the name of the view. */
export class Save {
  /** @param {{ store: import("./store.js").Store, view: () => HTMLElement }} context */
  constructor(context) {
    const menu = $("savings");
    const items = [...menu.querySelectorAll("button")];
    // A program serves the file at the link's address.
    if (worker) {
      $("save-touches").addEventListener("click", (event) => {
        event.preventDefault();
        saveFile("touches.toml");
      });
    }
    const show = (/** @type {boolean} */ open) => {
      menu.hidden = !open;
      $("save").setAttribute("aria-expanded", String(open));
      (open ? items[0] : $("save"))?.focus();
    };
    this.toggle = () => show(menu.hidden);
    $("save").addEventListener("click", this.toggle);
    for (const item of items) item.tabIndex = -1;
    menu.addEventListener("focusout", ({ relatedTarget }) => {
      if (relatedTarget instanceof Node && menu.contains(relatedTarget)) return;
      menu.hidden = true;
      $("save").setAttribute("aria-expanded", "false");
    });
    menu.addEventListener("keydown", (event) => {
      const at = items.findIndex((item) => item === document.activeElement);
      /** @type {Record<string, number>} */
      const ways = { ArrowUp: at - 1, ArrowDown: at + 1, Home: 0, End: items.length - 1 };
      const to = ways[event.key];
      if (event.key === "Escape") show(false);
      else if (to !== undefined) items[(to + items.length) % items.length]?.focus();
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    menu.addEventListener("click", ({ target }) => {
      show(false);
      const kind = target instanceof HTMLElement && target.dataset.save;
      if (kind === "png") picture(context.view()).then((url) => download(url, "taxel.png"));
      if (kind === "json" && context.store.shown()) download(moment(context.store), "taxel.json");
      if (kind === "mcap") saveFile("recording.mcap");
    });
  }
}

/**
 * @param {string} href
 * @param {string} name
 */
function download(href, name) {
  make("a", { href, download: name }).click();
  if (href.startsWith("blob:")) setTimeout(() => URL.revokeObjectURL(href), 10_000);
}

/**
 * Saves a file that whoever sends the messages makes.
 * @param {string} name
 */
async function saveFile(name) {
  const href = await address(name);
  if (href !== null) download(href, name);
}

/**
 * The frame, with the pressure of every taxel by panel and row, counts.
 * @param {import("./store.js").Store} store
 */
export function momentOf(store) {
  const { garment } = store;
  const shown = store.shown();
  if (!garment || !shown) throw new Error("nothing is shown");
  const { head, image } = shown;
  const rows = (/** @type {import("./types.d.ts").Panel} */ { base, rows, columns }) =>
    Array.from({ length: rows }, (_, row) => [...image.subarray(base + row * columns, base + (row + 1) * columns)]);
  const panels = garment.panels.map((panel) => ({ name: panel.name, rows: rows(panel) }));
  return { ...head.frame, garment: garment.garment, calibration: garment.calibration, unit: "counts", panels };
}

/** @param {import("./store.js").Store} store */
function moment(store) {
  return URL.createObjectURL(new Blob([JSON.stringify(momentOf(store))], { type: "application/json" }));
}

/**
 * A view as a PNG in a URL.
 * @param {HTMLElement} root
 */
export async function picture(root) {
  for (const view of [root, ...root.children]) view.dispatchEvent(new Event("picture"));
  const { left, top, width, height } = root.getBoundingClientRect();
  const ratio = window.devicePixelRatio || 1;
  const canvas = make("canvas", { width: (width + 2 * MARGIN) * ratio, height: (height + 2 * MARGIN) * ratio });
  const context = contextOf(canvas);
  context.scale(ratio, ratio);
  context.fillStyle = colour("card");
  context.fillRect(0, 0, width + 2 * MARGIN, height + 2 * MARGIN);
  context.translate(MARGIN, MARGIN);
  for (const part of root.querySelectorAll(DRAWN)) {
    if (!part.checkVisibility()) continue;
    const box = part.getBoundingClientRect();
    const place = /** @type {[number, number]} */ ([box.left - left, box.top - top]);
    if (part instanceof HTMLCanvasElement) context.drawImage(part, ...place, box.width, box.height);
    else if (part.closest(".marks")) mark(context, part.textContent ?? "", box, place);
    else if (part instanceof HTMLElement) caption(context, part.textContent ?? "", place);
    else context.drawImage(await drawing(part), ...place, box.width, box.height);
  }
  return canvas.toDataURL("image/png");
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {[number, number]} place
 */
function caption(context, text, [x, y]) {
  context.font = "600 12px system-ui, sans-serif";
  context.textBaseline = "top";
  context.fillStyle = colour("ink");
  context.fillText(text, x, y + 2);
}

/**
 * A mark of the surface: see layout.css.
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {DOMRect} box
 * @param {[number, number]} place
 */
function mark(context, text, { width, height }, [left, top]) {
  const [x, y] = [left + width / 2, top + height / 2];
  diamond(context, x, y + 16);
  if (text) label(context, text, x, y);
}

/**
 * An SVG as an image, with its colours written out, because the style sheet is not part of it.
 * @param {Element} svg
 */
async function drawing(svg) {
  const text = new XMLSerializer().serializeToString(svg).replace(/var\(--(\w+)\)/g, (_, name) => colour(name));
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(text)}`;
  await image.decode();
  return image;
}
