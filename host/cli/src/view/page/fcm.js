// The cognitive map with its live activations. As in `taxel fcm draw`: solid edges increase, dashed ones
// decrease, width is strength; the number is the activation.

import { colourOf } from "./concepts.js";
import { draw, make, say } from "./dom.js";
import { arrange, HEIGHT, MARGIN, WIDTH } from "./layers.js";

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
    const layers = map.concepts.map(({ layer }) => layer);
    const { isDown, places, extent } = arrange(layers, [width || 2, height || 1]);
    const svg = draw("svg", {
      viewBox: [-MARGIN, -MARGIN, ...extent.map((part) => part + 2 * MARGIN)].join(" "),
      role: "img",
      "aria-label": "Concepts and causes of the cognitive map, with their activations",
    });
    svg.append(draw("defs", {}, marker("more"), marker("less")));
    const name = (/** @type {number} */ at) => map.concepts[at]?.name ?? "";
    const place = (/** @type {number} */ at) => places[at] ?? [0, 0];
    this.edges = map.edges.map(({ from, to, weight }) => {
      const line = arrow(place(from), place(to), weight, isDown);
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
        "font-size": 13,
        fill: "var(--ink)",
      });
      const title = {
        x: x + WIDTH / 2,
        y: y + 16,
        "text-anchor": "middle",
        "font-size": 14,
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
 * @param {boolean} isDown the map is read downwards
 */
function arrow([x0, y0], [x1, y1], weight, isDown) {
  const kind = weight < 0 ? "less" : "more";
  // Along the direction of reading, and across it.
  const [a0, b0, a1, b1] = isDown ? [y0, x0, y1, x1] : [x0, y0, x1, y1];
  const [length, breadth] = isDown ? [HEIGHT, WIDTH] : [WIDTH, HEIGHT];
  const forward = a1 > a0;
  const [from, to] = forward ? [a0 + length, a1] : [a0 + length / 2, a1 + length / 2];
  const [start, end] = forward ? [b0 + breadth / 2, b1 + breadth / 2] : [b0, b1 + breadth];
  const bend = forward ? Math.max(length / 4, (to - from) / 2) : 0;
  const at = (/** @type {number} */ a, /** @type {number} */ b) => (isDown ? `${b} ${a}` : `${a} ${b}`);
  return draw("path", {
    d: `M${at(from, start)}C${at(from + bend, start)} ${at(to - bend, end)} ${at(to, end)}`,
    fill: "none",
    stroke: `var(--${kind})`,
    "stroke-width": 1 + 3 * Math.abs(weight),
    "stroke-dasharray": weight < 0 ? "7 4" : "none",
    "marker-end": `url(#to-${kind})`,
  });
}
