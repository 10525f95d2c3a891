// The timeline of a recording: all of it below, the half minute around the moment above. Both can be clicked
// and dragged; the ends of the range are dragged on the lower one.

import { $, colour, contextOf, fit, make, one, say } from "./dom.js";
import * as strip from "./strip.js";
import { columns, moved, nearest, rulerStep, stretches, timeText, windowAbout } from "./timeline.js";
import { force } from "./units.js";

/** Distance from a mark within which the pointer is on it, pixels. */
const REACH = 5;

/**
 * @typedef {import("./types.d.ts").Said} Said
 * @typedef {import("./types.d.ts").Overview} Overview
 */

/** Both lines. `ask` sends requests to the program. */
export class Timeline {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Ask} ask
   */
  constructor(store, ask) {
    this.store = store;
    this.ask = ask;
    this.tip = $("tip");
    this.whole = one(HTMLCanvasElement, "whole");
    this.near = one(HTMLCanvasElement, "strips");
    /** @type {HTMLCanvasElement | null} */
    this.held = null;
    /** @type {[number, number]} */
    this.frozen = [0, 1];
    this.watch(this.whole, () => [0, this.duration]);
    this.watch(this.near, () => this.window);
    this.ends = ["range-from", "range-to"].map((id) => $(id));
    this.ends.forEach((end, which) => this.handle(end, which));
  }

  get duration() {
    return Math.max(this.store.recorded?.duration ?? 0, 0.001);
  }

  /** Seconds shown by the upper line; fixed while the pointer is down on them. */
  get window() {
    if (this.held === this.near) return this.frozen;
    this.frozen = windowAbout(this.store.moment(), this.duration);
    return this.frozen;
  }

  /**
   * Seconds at a place of a line.
   * @param {HTMLCanvasElement} canvas
   * @param {PointerEvent} event
   * @param {[number, number]} span
   */
  at(canvas, event, [from, to]) {
    const { left, width } = canvas.getBoundingClientRect();
    const share = Math.max(0, Math.min(1, (event.clientX - left) / width));
    return from + share * (to - from);
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {() => [number, number]} span
   */
  watch(canvas, span) {
    const seek = (/** @type {PointerEvent} */ event) => this.ask({ seek: this.at(canvas, event, span()) });
    canvas.addEventListener("pointerdown", (event) => {
      if (!this.store.recorded || event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      this.held = canvas;
      const on = this.under(canvas, event, span());
      if (on) this.ask({ seek: on[0] / 1e6 });
      else seek(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.store.recorded) return;
      if (this.held === canvas) seek(event);
      this.hint(canvas, event, span());
    });
    const release = () => (this.held = null);
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => (this.tip.hidden = true));
  }

  /**
   * The marked line under the pointer.
   * @param {HTMLCanvasElement} canvas
   * @param {PointerEvent} event
   * @param {[number, number]} span
   */
  under(canvas, event, [from, to]) {
    const { overview } = this.store.states;
    const reach = ((to - from) / canvas.clientWidth) * REACH * 1e6;
    return overview ? nearest(overview.said, this.at(canvas, event, [from, to]) * 1e6, reach) : null;
  }

  /**
   * Shows the time under the pointer, and the line marked there.
   * @param {HTMLCanvasElement} canvas
   * @param {PointerEvent} event
   * @param {[number, number]} span
   */
  hint(canvas, event, span) {
    const on = this.under(canvas, event, span);
    const at = on ? on[0] / 1e6 : this.at(canvas, event, span);
    this.tip.replaceChildren(make("b", {}, `${timeText(at)} s`), on ? ` ${on[2]}` : "");
    this.tip.hidden = false;
    const { left, top } = canvas.getBoundingClientRect();
    const room = innerWidth - this.tip.offsetWidth - 6;
    const x = Math.max(4, Math.min(room, event.clientX - this.tip.offsetWidth / 2));
    this.tip.style.transform = `translate(${x}px, ${top - this.tip.offsetHeight - 4}px)`;
    canvas.style.cursor = on ? "pointer" : "";
    return left;
  }

  /**
   * An end of the range: dragged, or moved by the arrow keys.
   * @param {HTMLElement} end
   * @param {number} which
   */
  handle(end, which) {
    const range = () => this.store.recorded?.range ?? [0, 0];
    const move = (/** @type {number} */ to) => this.ask({ range: moved(range(), which, to, this.duration) });
    end.addEventListener("pointerdown", (event) => {
      end.setPointerCapture(event.pointerId);
      event.preventDefault();
      end.focus();
    });
    end.addEventListener("pointermove", (event) => {
      if (end.hasPointerCapture(event.pointerId)) move(this.at(this.whole, event, [0, this.duration]));
    });
    end.addEventListener("keydown", (event) => {
      const at = range()[which] ?? 0;
      const step = event.shiftKey ? 1 : 0.1;
      /** @type {Record<string, number>} */
      const ends = {
        ArrowLeft: at - step,
        ArrowDown: at - step,
        ArrowRight: at + step,
        ArrowUp: at + step,
        PageDown: at - 1,
        PageUp: at + 1,
        Home: 0,
        End: this.duration,
      };
      const to = ends[event.key];
      if (to === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      move(to);
    });
  }

  draw() {
    const { recorded, states } = this.store;
    const { garment } = this.store;
    if (!recorded || !garment) return;
    const { overview } = states;
    const span = this.window;
    this.line(this.near, overview, span, this.duration > span[1] - span[0] ? "about this moment" : "");
    this.line(this.whole, overview, [0, this.duration], "");
    const { range } = recorded;
    this.ends.forEach((end, which) => {
      const at = range[which] ?? 0;
      end.style.left = `${(at / this.duration) * 100}%`;
      end.setAttribute("aria-valuemax", this.duration.toFixed(2));
      end.setAttribute("aria-valuenow", at.toFixed(2));
      end.setAttribute("aria-valuetext", `${timeText(at)} s`);
    });
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Overview | undefined} overview
   * @param {[number, number]} span
   * @param {string} about
   */
  line(canvas, overview, [from, to], about) {
    const context = fit(canvas);
    if (!context) return;
    const { clientWidth: width, clientHeight: height } = canvas;
    const whole = canvas === this.whole;
    const x = (/** @type {number} */ us) => ((us / 1e6 - from) / (to - from)) * width;
    const bottom = height - strip.TIMES;
    context.clearRect(0, 0, width, height);
    context.font = "11px system-ui, sans-serif";
    strip.ruler(context, ruler(from, to, width), height);
    if (overview) {
      const shown = columns(overview, [from, to], width);
      this.unknown(context, overview, x, shown, bottom);
      const highest = shown.reduce((most, total) => Math.max(most, total), 1000);
      const floor = bottom - strip.LANE - strip.RIBBON;
      strip.area(context, shown, highest, floor, whole ? 4 : 18);
      strip.ribbon(context, visible(overview, from, to), x, floor + 3);
      strip.marks(context, within(overview.said, from, to), x, bottom - strip.LANE / 2);
      if (!whole) this.caption(context, `total force, up to ${this.force(highest)}`, about, width);
    }
    this.shade(context, x, whole, width, bottom);
    strip.cursor(context, x(this.store.moment() * 1e6), bottom);
  }

  /** @param {number} counts */
  force(counts) {
    return this.store.garment ? force(this.store.garment, counts) : "";
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {string} left
   * @param {string} right
   * @param {number} width
   */
  caption(context, left, right, width) {
    context.fillStyle = colour("quiet");
    context.textBaseline = "top";
    context.textAlign = "left";
    context.fillText(left, 4, 2);
    context.textAlign = "right";
    context.fillText(right, width - 4, 2);
  }

  /**
   * Draws the unread part.
   * @param {CanvasRenderingContext2D} context
   * @param {Overview} overview
   * @param {(us: number) => number} x
   * @param {Float64Array} shown
   * @param {number} bottom
   */
  unknown(context, { known_us: known }, x, shown, bottom) {
    const edge = Math.max(0, x(known));
    if (edge >= shown.length - 1) return;
    for (let column = Math.ceil(edge); column < shown.length; column += 1) shown[column] = -1;
    context.fillStyle = colour("grid");
    context.fillRect(edge, 0, shown.length - edge, bottom);
    context.fillStyle = colour("quiet");
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.fillText("reading …", edge + 6, bottom / 2);
  }

  /**
   * Draws what is outside of the range; on the lower line also the part shown by the upper one.
   * @param {CanvasRenderingContext2D} context
   * @param {(us: number) => number} x
   * @param {boolean} whole
   * @param {number} width
   * @param {number} bottom
   */
  shade(context, x, whole, width, bottom) {
    const [from, to] = (this.store.recorded?.range ?? [0, 0]).map((end) => x(end * 1e6));
    context.fillStyle = colour("shade");
    if (from !== undefined && from > 0) context.fillRect(0, 0, Math.min(width, from), bottom);
    if (to !== undefined && to < width) context.fillRect(Math.max(0, to), 0, width, bottom);
    if (!whole) return;
    const [left, right] = this.window;
    const near = /** @type {const} */ ([x(left * 1e6), x(right * 1e6)]);
    context.strokeStyle = colour("quiet");
    context.lineWidth = 1;
    if (near[1] - near[0] < width - 1)
      context.strokeRect(near[0] + 0.5, 0.5, Math.max(2, near[1] - near[0] - 1), bottom - 1);
  }
}

/**
 * Lines at round times.
 * @param {number} from
 * @param {number} to
 * @param {number} width
 */
function ruler(from, to, width) {
  const step = rulerStep(to - from, width);
  /** @type {[number, string, CanvasTextAlign][]} */
  const lines = [];
  for (let at = Math.ceil(from / step) * step; at <= to + 1e-9; at += step) {
    const place = ((at - from) / (to - from)) * width;
    const align = place < 20 ? "left" : place > width - 20 ? "right" : "center";
    lines.push([place, `${timeText(at, step < 0.1 ? 2 : step < 1 ? 1 : 0)}${at < 60 ? " s" : ""}`, align]);
  }
  return lines;
}

/** @type {(said: Said[], from: number, to: number) => Said[]} */
const within = (said, from, to) => said.filter(([at]) => at >= from * 1e6 - 1e5 && at <= to * 1e6 + 1e5);

/** @type {(overview: Overview, from: number, to: number) => [number, number, string][]} */
const visible = (overview, from, to) =>
  stretches(overview.intentions, overview.known_us).filter(([start, end]) => end >= from * 1e6 && start <= to * 1e6);

/**
 * Draws the legend of the marks.
 * @param {HTMLElement} element
 * @param {Record<string, string>} names
 * @param {(context: CanvasRenderingContext2D, kind: string, x: number, y: number) => void} draw
 */
export function legend(element, names, draw) {
  element.replaceChildren(
    ...Object.entries(names).map(([kind, name]) => {
      const canvas = make("canvas", { width: 14, height: 14, "aria-hidden": "true" });
      draw(contextOf(canvas), kind, 7, 7);
      const item = make("span", {}, canvas);
      const text = make("span");
      say(text, name);
      item.append(text);
      return item;
    }),
  );
}
