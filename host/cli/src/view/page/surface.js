// Pressure as a surface in three dimensions, drawn by plotly.js, which is loaded on first use.

import { make, colour } from "./dom.js";
import { RAMP } from "./colours.js";
import { maxima } from "./peaks.js";
import { isPascal, pascalsOf } from "./units.js";

/** Free columns between two panels. */
const GAP = 2;

const COLOURS = RAMP.filter((_, step) => step % 15 === 0).map((rgb, at, all) => [at / (all.length - 1), `rgb(${rgb})`]);

/** Readable on the colours of the scale and in both themes. */
const MARK = "#dd5f00";

/**
 * No peaks. plotly.js shrinks the text of points present when a plot is created, so it is created with these.
 */
const NOTHING = { x: [], y: [], z: [], text: [] };

/** Multiple of the scale's end that fits the highest pressure so far: the height changes seldom. */
function heightOf(held, top) {
  const greatest = held.reduce((most, value) => Math.max(most, value), 1);
  return top * Math.ceil(greatest / top);
}

/** Most milliseconds after a redraw that are left to everything else. */
const LONGEST_REST = 200;

/**
 * All panels side by side: the place of each taxel, and triangles between neighbours. It is a mesh, because
 * plotly.js refines a "surface" three times before drawing, which takes longer and looks the same.
 */
function meshOf({ panels, absent }) {
  const mesh = { x: [], y: [], i: [], j: [], k: [] };
  let start = 0;
  for (const { base, rows, columns } of panels) {
    for (let at = 0; at < rows * columns; at += 1) {
      const [row, column] = [Math.floor(at / columns), at % columns];
      mesh.x.push(start + column);
      mesh.y.push(row);
      const corners = [0, 1, columns, columns + 1].map((step) => base + at + step);
      if (row + 1 === rows || column + 1 === columns || corners.some((taxel) => absent[taxel])) continue;
      const [here, right, below, across] = corners;
      mesh.i.push(here, across);
      mesh.j.push(right, below);
      mesh.k.push(below, right);
    }
    start += columns + GAP;
  }
  return mesh;
}

/** The view. */
export class Surface {
  constructor(root, changed) {
    Object.assign(this, { root, changed, key: "", state: "absent" });
  }

  load() {
    this.state = "loading";
    const say = (text) => this.root.replaceChildren(make("p", { class: "empty", role: "status" }, text));
    say("Loading …");
    const failed = () => {
      this.state = "failed";
      say('This program was built without its feature "surface", or this browser cannot draw in three dimensions.');
    };
    const loaded = () => {
      this.state = "ready";
      this.changed();
    };
    document.head.append(make("script", { src: "plotly.js", load: loaded, error: failed }));
  }

  draw(store, settings) {
    if (this.state === "absent") this.load();
    const shown = store.shown();
    if (this.state !== "ready" || !shown) return;
    const { garment } = store;
    const image = settings.held ? store.held : shown.image;
    const unit = isPascal(garment) ? pascalsOf(garment) : 1;
    const peaks = settings.peaks ? this.peaks(garment, image, shown, settings, unit) : NOTHING;
    const { clientWidth: width, clientHeight: height } = this.root;
    const highest = heightOf(store.held, settings.top);
    const { theme } = document.documentElement.dataset;
    const key = [garment.key, unit, settings.top, highest, width, height, theme].join(" ");
    if (key !== this.key) {
      this.key = key;
      const scale = { top: settings.top * unit, highest: highest * unit, unit: isPascal(garment) ? "kPa" : "counts" };
      this.build(garment, scale);
      // The peaks follow with the next redraw.
      this.changed();
      return;
    }
    this.show(Array.from(image, (value) => value * unit), peaks);
  }

  /** Skips updates so that half of the page's time stays free; the last one is always drawn. */
  show(heights, { z, x, y, text }) {
    this.behind = this.busy;
    if (this.busy) return;
    this.busy = true;
    const start = performance.now();
    const ready = () => {
      this.busy = false;
      if (this.behind) this.changed();
    };
    const places = { x: [this.mesh.x, x], y: [this.mesh.y, y], z: [heights, z] };
    const data = { ...places, intensity: [heights, null], text: [null, text] };
    const rest = () => setTimeout(ready, Math.min(performance.now() - start, LONGEST_REST));
    window.Plotly.restyle(this.plot, data, [0, 1]).finally(rest);
  }

  /** Every local maximum; those of contacts have the id. */
  peaks({ panels, low }, image, shown, { held }, unit) {
    const all = { x: [], y: [], z: [], text: [] };
    let start = 0;
    for (const panel of panels) {
      for (const { row, column, value } of maxima(image, panel, low)) {
        const of = (touch) => touch.panel === panel.index && touch.peak_row === row && touch.peak_column === column;
        const touch = held ? null : shown.head.frame.contacts.find(of);
        all.x.push(start + column);
        all.y.push(row);
        all.z.push(value * unit);
        all.text.push(touch ? String(touch.id) : "");
      }
      start += panel.columns + GAP;
    }
    return all;
  }

  build(garment, { top, highest, unit }) {
    const { panels } = garment;
    this.mesh = meshOf(garment);
    this.plot ??= make("div");
    if (this.plot.parentNode !== this.root) this.root.replaceChildren(this.plot);
    let start = -GAP;
    const middles = panels.map((panel) => {
      start += GAP;
      const middle = start + (panel.columns - 1) / 2;
      start += panel.columns;
      return middle;
    });
    const [ink, line] = [colour("ink"), colour("line")];
    const axis = { color: ink, gridcolor: line, zerolinecolor: line, showspikes: false };
    const rows = Math.max(...panels.map((panel) => panel.rows));
    const flat = new Array(garment.taxels).fill(0);
    const surface = {
      type: "mesh3d",
      ...this.mesh,
      z: flat,
      intensity: flat,
      cmin: 0,
      cmax: top,
      colorscale: COLOURS,
      showscale: false,
      hoverinfo: "skip",
      lighting: { ambient: 0.75, diffuse: 0.5, specular: 0.08, roughness: 0.8 },
    };
    const marks = {
      type: "scatter3d",
      mode: "markers+text",
      ...NOTHING,
      hoverinfo: "skip",
      textfont: { color: MARK, size: 15 },
      marker: { symbol: "diamond", size: 4, color: MARK, line: { color: colour("card"), width: 1 } },
    };
    const layout = {
      margin: { l: 0, r: 0, t: 0, b: 0 },
      paper_bgcolor: "rgba(0,0,0,0)",
      showlegend: false,
      uirevision: "keep",
      font: { family: "system-ui, sans-serif", size: 12 },
      scene: {
        uirevision: "keep",
        xaxis: { ...axis, title: { text: "" }, tickvals: middles, ticktext: panels.map((panel) => panel.name) },
        yaxis: { ...axis, title: { text: "row" }, range: [rows - 0.5, -0.5] },
        zaxis: { ...axis, title: { text: unit }, range: [0, highest] },
        aspectmode: "manual",
        aspectratio: { x: 1.7, y: 0.95, z: 0.6 },
        camera: { eye: { x: 0.25, y: -1.55, z: 1.05 }, center: { x: 0, y: 0, z: -0.12 } },
      },
    };
    // Screen resolution, not twice that: it is four times the work without a graphics card.
    const plotGlPixelRatio = window.devicePixelRatio;
    const config = { plotGlPixelRatio, displayModeBar: false, responsive: false, doubleClick: "reset" };
    window.Plotly.react(this.plot, [surface, marks], layout, config);
  }
}
