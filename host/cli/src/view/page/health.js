// Faulty taxels and their faults, by letter and colour.

import { colour, fit, make } from "./dom.js";
import { placeOf } from "./garment.js";

/** Letter and colour of each class; no colour means anything else on the page. */
/** @type {Record<string, [string, string]>} */
export const CLASSES = {
  dead: ["D", "#000000"],
  stuck: ["S", "#d9c300"],
  open: ["O", "#8fb7cf"],
  shorted: ["X", "#7b2d26"],
  noisy: ["N", "#cc79a7"],
};
/** Faulty taxels listed at most; the map shows all. */
const LISTED = 200;
const [GAP, CAPTION, LEGEND] = [14, 18, 30];

/** The view. */
export class Health {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.canvas = make("canvas", { role: "img", "aria-label": "Map of faulty taxels" });
    this.list = make("div", { class: "list", tabindex: 0 });
    root.append(this.canvas, this.list);
    /** @type {unknown[] | null} */
    this.drawn = null;
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const { garment } = store;
    const context = garment && fit(this.canvas);
    if (!context) return;
    this.map(context, garment, store.faulty());
    const drawn = [store.states.health_map, store.states.health, store.states.pins];
    if (this.drawn?.every((line, at) => line === drawn[at])) return;
    this.drawn = drawn;
    this.list.replaceChildren(...lists(garment, store.states));
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {import("./types.d.ts").Garment} garment
   * @param {Map<number, string>} faulty
   */
  map(context, garment, faulty) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { panels } = garment;
    const wide = panels.reduce((sum, panel) => sum + panel.columns * panel.mm[0], 0);
    const tall = Math.max(...panels.map((panel) => panel.rows * panel.mm[1]));
    const scale = Math.min((width - GAP * (panels.length - 1)) / wide, (height - CAPTION - LEGEND) / tall);
    context.clearRect(0, 0, width, height);
    let left = 0;
    for (const panel of panels) {
      const [sx, sy] = [panel.mm[0] * scale, panel.mm[1] * scale];
      context.font = "600 12px system-ui, sans-serif";
      context.textAlign = "left";
      context.textBaseline = "top";
      context.fillStyle = colour("ink");
      context.fillText(panel.name, left, 0);
      for (let at = 0; at < panel.rows * panel.columns; at += 1) {
        const taxel = panel.base + at;
        if (garment.absent[taxel]) continue;
        const [x, y] = [left + (at % panel.columns) * sx, CAPTION + Math.floor(at / panel.columns) * sy];
        cell(context, faulty.get(taxel), x, y, sx, sy);
      }
      left += panel.columns * sx + GAP;
    }
    legend(context, CAPTION + tall * scale + 12);
  }
}

/**
 * Letter and name of each class.
 * @param {CanvasRenderingContext2D} context
 * @param {number} y
 */
function legend(context, y) {
  let x = 0;
  for (const health of Object.keys(CLASSES)) {
    cell(context, health, x, y, 15, 15);
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    context.fillStyle = colour("ink");
    context.fillText(health, x + 20, y + 8);
    x += 88;
  }
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {string | undefined} health
 * @param {number} x
 * @param {number} y
 * @param {number} sx
 * @param {number} sy
 */
function cell(context, health, x, y, sx, sy) {
  const [letter, fill] = CLASSES[health ?? ""] ?? ["", colour("grid")];
  context.fillStyle = fill;
  context.fillRect(x, y, sx - 1, sy - 1);
  if (!letter) return;
  context.fillStyle = health === "dead" || health === "shorted" ? "#ffffff" : "#000000";
  context.font = `700 ${Math.min(sx, sy) * 0.85}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(letter, x + (sx - 1) / 2, y + (sy - 1) / 2 + 0.5);
}

/**
 * The faulty taxels, the results of the board's last self-test, and its counters.
 * @param {import("./types.d.ts").Garment} garment
 * @param {import("./types.d.ts").States} states
 */
function lists(garment, states) {
  const board = states.health;
  const faulty = states.health_map?.faulty || [];
  const line = (/** @type {{ taxel: number, health: string }} */ { taxel, health }) => {
    const { panel, row, column } = placeOf(garment, taxel);
    return make("li", {}, `${health}: ${panel.name}, row ${row}, column ${column}`);
  };
  const counts = board
    ? [
        ["scans", board.scans],
        ["failed", board.failed],
        ["overruns", board.overruns],
        ["lost on the board", board.lost],
        ["requests refused", board.refused],
        ["scan", `${board.scan_us} us`],
        ["perception", `${board.process_us} us`],
      ]
    : [];
  const cells = counts.map(([name, value]) =>
    make("tr", {}, make("th", { scope: "row" }, String(name)), make("td", {}, String(value))),
  );
  const title = faulty.length
    ? `${faulty.length} of ${garment.taxels} taxels are faulty`
    : "No faulty taxels.";
  const items = (/** @type {HTMLElement[]} */ lines) =>
    make("ul", { style: "padding-left:16px;margin:0 0 12px" }, ...lines);
  const pins = states.pins?.table ?? ["The board has not tested its lines and inputs yet."];
  return [
    make("h2", {}, title),
    items(faulty.slice(0, LISTED).map(line)),
    make("h2", {}, "Lines and inputs"),
    items(pins.map((text) => make("li", {}, text))),
    make("h2", {}, "The board"),
    make("table", {}, make("tbody", {}, ...cells)),
  ];
}
