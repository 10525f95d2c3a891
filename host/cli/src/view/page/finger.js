// One touch by hand from its press to its release, and what the program hears of it.

import { forceOf, lashes, REST_MM_S } from "./force-law.js";

/**
 * @typedef {import("./force-law.js").Tool} Tool
 * @typedef {import("./types.d.ts").Spot} Spot
 * @typedef {import("./types.d.ts").PageRequest} PageRequest
 */

/** Least duration of a touch, so that the shortest tap is felt as a pat; that of a lash, ms. */
const [TAP_MS, LASH_MS] = [120, 60];
/** Time over which the speed is measured, and its least, ms. */
const [SPAN_MS, LEAST_MS] = [50, 16];
/** Time in which the program reaches what it is sent: it is sent the force of that moment, ms. */
const AHEAD_MS = 16;

/** @param {number} value */
const rounded = (value) => Math.round(100 * value) / 100;

/** A finger that presses. It keeps its panel and its tool. */
export class Finger {
  /**
   * @param {object} press
   * @param {number} press.number 0 to 9
   * @param {Tool} press.tool
   * @param {Spot} press.spot
   * @param {number} press.factor of the force
   * @param {number} press.angle of the tool, degrees
   * @param {number} press.now ms of the page
   */
  constructor({ number, tool, spot, factor, angle, now }) {
    this.number = number;
    this.tool = tool;
    this.factor = factor;
    this.angle = angle;
    this.panel = spot.panel;
    this.at = spot.at;
    this.pressed = now;
    this.seen = now;
    this.rested = 0;
    this.force = 0;
    this.lashed = false;
    /** True if it has moved since the program was sent. */
    this.moved = false;
    /** @type {number | null} pressure of a pen, 0 to 1 */
    this.pressure = null;
    /** @type {number | null} when the pointer lifted */
    this.lifted = null;
    /** @type {{ from: number, time: number, mm: number }[]} the last steps */
    this.steps = [];
    this.sent = "";
  }

  /**
   * The pointer has moved on the panel.
   * @param {[number, number]} at
   * @param {number} now ms
   */
  move(at, now) {
    const mm = Math.hypot((at[0] - this.at[0]) * this.panel.mm[0], (at[1] - this.at[1]) * this.panel.mm[1]);
    this.at = at;
    this.moved = true;
    // Since the frame or the step before: a page that stood still has seen no lash.
    const from = Math.max(this.seen, this.steps.at(-1)?.time ?? this.pressed);
    this.steps.push({ from, time: Math.max(now, from), mm });
  }

  /** @param {number} now ms */
  lift(now) {
    this.lifted ??= now;
  }

  /**
   * Speed over the last moments, or since the last frame if that is longer ago, mm/s.
   * @param {number} now ms
   */
  speed(now) {
    const began = Math.min(now - SPAN_MS, this.seen);
    this.steps = this.steps.filter(({ time }) => time >= began);
    const part = (/** @type {number} */ from, /** @type {number} */ time) =>
      from < began ? (time - began) / (time - from) : 1;
    const way = this.steps.reduce((sum, { from, time, mm }) => sum + mm * part(from, time), 0);
    return (1000 * way) / Math.max(LEAST_MS, now - Math.max(began, this.pressed));
  }

  /**
   * True once it is to be released: a short tap lasts longer than its pointer is down, and the program is sent each
   * move.
   * @param {number} now ms
   */
  isOver(now) {
    return this.lifted !== null && !this.moved && now - this.pressed >= (this.lashed ? LASH_MS : TAP_MS);
  }

  /**
   * Returns what the program is to be sent now; null if nothing has changed.
   * @param {number} now ms
   * @returns {PageRequest | null}
   */
  next(now) {
    const speed = this.speed(now);
    if (speed < REST_MM_S) this.rested += now - this.seen;
    this.seen = now;
    this.moved = false;
    this.lashed ||= lashes(this.tool, speed);
    const { rested, pressure, tool, factor, panel, at, number, angle } = this;
    this.force = forceOf(tool, factor, { age: now - this.pressed + AHEAD_MS, rested, speed, pressure });
    const press = {
      finger: number,
      tool: tool.name,
      panel: panel.index,
      at: /** @type {[number, number]} */ (at.map(rounded)),
      force_n: rounded(this.force),
      angle_deg: angle,
    };
    const sent = JSON.stringify(press);
    if (sent === this.sent) return null;
    this.sent = sent;
    return { press };
  }
}
