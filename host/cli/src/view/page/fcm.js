// The cognitive map with its live activations. As in `taxel fcm draw`: solid edges increase, dashed ones
// decrease, width is strength; the number is the activation.

import { colourOf } from "./concepts.js";
import { draw, make, say } from "./dom.js";

const [WIDTH, HEIGHT, ACROSS, DOWN] = [98, 38, 126, 50];
/** Height by which neighbouring columns are skewed, rows. */
const SKEW = 0.4;

/** The view. */
export class CognitiveMap {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    this.key = "";
    /** @type {{ name: string, own: string | null, box: SVGElement, text: SVGElement }[]} */
    this.nodes = [];
    /** @type {{ from: string, weight: number, line: SVGElement }[]} */
    this.edges = [];
  }

  /** @param {import("./store.js").Store} store */
  draw(store) {
    const { garment } = store;
    if (!garment) return;
    this.build(garment.map);
    const shown = store.shown();
    if (!shown || !garment.map) return;
    const { concepts, leading } = shown.head.frame.intent;
    const value = (/** @type {string} */ name) => concepts[name] ?? 0;
    for (const { name, own, box, text } of this.nodes) {
      const activation = value(name);
      box.style.fillOpacity = String(Math.min(1, Math.abs(activation)) * 0.6);
      box.style.fill = activation < 0 ? "var(--less)" : (own || "var(--more)");
      box.style.strokeWidth = name === leading ? "3" : "1";
      say(text, activation.toFixed(2));
    }
    for (const { from, weight, line } of this.edges) {
      line.style.opacity = String(0.22 + 0.78 * Math.min(1, Math.abs(value(from) * weight)));
    }
  }

  /** @param {import("./types.d.ts").CognitiveMapOf | null} map */
  build(map) {
    const { clientWidth: width, clientHeight: height } = this.root;
    const key = JSON.stringify([map, width, height]);
    if (key === this.key) return;
    this.key = key;
    if (!map) {
      this.root.replaceChildren(make("p", { class: "empty" }, "This scene has no cognitive map."));
      return;
    }
    const places = placesOf(map.concepts, width / height || 2);
    const extent = (/** @type {0 | 1} */ at) => Math.max(...places.map((place) => place[at]));
    const svg = draw("svg", {
      viewBox: `-12 -12 ${extent(0) + WIDTH + 24} ${extent(1) + HEIGHT + 24}`,
      role: "img",
      "aria-label": "Concepts and causes of the cognitive map, with their activations",
    });
    svg.append(draw("defs", {}, marker("more"), marker("less")));
    const name = (/** @type {number} */ at) => map.concepts[at]?.name ?? "";
    const place = (/** @type {number} */ at) => places[at] ?? [0, 0];
    this.edges = map.edges.map(({ from, to, weight }) => {
      const line = arrow(place(from), place(to), weight);
      line.append(draw("title", {}, `${name(from)} → ${name(to)}: ${weight}`));
      svg.append(line);
      return { from: name(from), weight, line };
    });
    this.nodes = map.concepts.map((concept, at) => {
      const { name } = concept;
      const [x, y] = place(at);
      const box = draw("rect", { x, y, width: WIDTH, height: HEIGHT, rx: 7, stroke: "var(--quiet)" });
      const text = draw("text", {
        x: x + WIDTH / 2,
        y: y + 31,
        "text-anchor": "middle",
        "font-size": 12,
        fill: "var(--ink)",
      });
      const title = {
        x: x + WIDTH / 2,
        y: y + 16,
        "text-anchor": "middle",
        "font-size": 13,
        "font-weight": 600,
        fill: "var(--ink)",
      };
      const back = draw("rect", { x, y, width: WIDTH, height: HEIGHT, rx: 7, fill: "var(--card)" });
      svg.append(back, box, draw("text", title, name), text);
      return { name, own: colourOf(concept), box, text };
    });
    this.root.replaceChildren(svg);
  }
}

/**
 * Places causes left of effects. The inputs, which are many, stand in as many columns as make the picture large;
 * neighbouring columns are slightly skewed, so that few edges cross a concept.
 * @param {import("./types.d.ts").Concept[]} concepts
 * @param {number} aspect width of the room, heights
 * @returns {[number, number][]}
 */
export function placesOf(concepts, aspect) {
  const counts = Array.from({ length: 1 + Math.max(...concepts.map(({ layer }) => layer)) }, () => 0);
  for (const { layer } of concepts) counts[layer] = (counts[layer] ?? 0) + 1;
  const [inputs = 0, ...others] = counts;
  const rows = (/** @type {number} */ columns) => Math.max(Math.ceil(inputs / columns), ...others);
  const size = (/** @type {number} */ columns) =>
    Math.max(((columns + others.length) * ACROSS) / aspect, rows(columns) * DOWN);
  const choices = Array.from({ length: Math.max(1, inputs) }, (_, at) => at + 1);
  const first = choices.reduce((best, columns) => (size(columns) < size(best) ? columns : best), 1);
  const deep = Math.ceil(inputs / first);
  const seen = new Map();
  return concepts.map(({ layer }) => {
    const above = seen.get(layer) ?? 0;
    seen.set(layer, above + 1);
    const column = layer === 0 ? Math.floor(above / deep) : layer - 1 + first;
    const row = layer === 0 ? above % deep : above;
    const top = (rows(first) - (layer === 0 ? deep : (counts[layer] ?? 0))) / 2;
    const skew = (column % 2) * (layer === 0 ? SKEW : 2 * SKEW);
    return [column * ACROSS, (row + top) * DOWN + skew * DOWN];
  });
}

/** @param {string} kind */
function marker(kind) {
  const shape = draw("path", { d: "M0 0 8 4 0 8z", fill: `var(--${kind})` });
  return draw(
    "marker",
    {
      id: `to-${kind}`,
      viewBox: "0 0 8 8",
      refX: 7,
      refY: 4,
      markerWidth: 9,
      markerHeight: 9,
      markerUnits: "userSpaceOnUse",
      orient: "auto",
    },
    shape,
  );
}

/**
 * Edge from the side of the cause to the side of the effect; it runs back if the effect is placed before it.
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @param {number} weight
 */
function arrow([x0, y0], [x1, y1], weight) {
  const kind = weight < 0 ? "less" : "more";
  const forward = x1 > x0;
  const [from, to] = forward ? [x0 + WIDTH, x1] : [x0 + WIDTH / 2, x1 + WIDTH / 2];
  const [up, down] = forward ? [y0 + HEIGHT / 2, y1 + HEIGHT / 2] : [y0, y1 + HEIGHT];
  const bend = forward ? Math.max(24, (to - from) / 2) : 0;
  const d = `M${from} ${up}C${from + bend} ${up} ${to - bend} ${down} ${to} ${down}`;
  return draw("path", {
    d,
    fill: "none",
    stroke: `var(--${kind})`,
    "stroke-width": 1 + 3 * Math.abs(weight),
    "stroke-dasharray": weight < 0 ? "7 4" : "none",
    "marker-end": `url(#to-${kind})`,
  });
}
