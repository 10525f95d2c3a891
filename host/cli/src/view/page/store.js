// State of the page: the garment, the latest messages, and the images of the last half minute in preallocated
// slots.

import { afterglow, FADE_S } from "./afterglow.js";
import { take } from "./colours.js";
import { garmentOf } from "./garment.js";
import { logAt } from "./timeline.js";

/** Seconds that can be stepped back: 30, or by the address (`/?keep=5`). */
export const KEPT_S = Math.max(1, Math.min(120, Number(new URLSearchParams(location.search).get("keep")) || 30));
/** Highest image rate, per second. */
const RATE = 62;
/** Images whose maxima since the previous image are kept: all that may still glow. */
const GLOWING = 64;
/** Lines of the log that are kept whatever their age, at most, and shown. */
const [LOGGED, MOST, LINES] = [512, 4096, 60];
/** Age relative to the newest up to which an image may be a repeat, us. */
const TWICE = 500_000;

/**
 * @typedef {import("./types.d.ts").Garment} Garment
 * @typedef {import("./types.d.ts").Head} Head
 * @typedef {import("./types.d.ts").Said} Said
 * @typedef {import("./messages.d.ts").SayLine} SayLine
 * @typedef {import("./types.d.ts").Shown} Shown
 * @typedef {import("./types.d.ts").Still} Still
 */

/** Everything shown. `shown()` is the image at the cursor, or the newest. */
export class Store {
  /** @param {number} kept seconds that can be stepped back */
  constructor(kept = KEPT_S) {
    this.kept = kept;
    /** @type {Garment | null} */
    this.garment = null;
    /** @type {import("./types.d.ts").States} */
    this.states = {};
    /**
     * Lines of the live log, the oldest first.
     * @type {SayLine[]}
     */
    this.log = [];
    /** @type {number | null} */
    this.seeks = null;
    this.size = Math.ceil(kept * RATE);
    /** @type {number | null} */
    this.cursor = null;
    /** @type {Still | null} */
    this.still = null;
    /** @type {Shown | null} */
    this.latest = null;
    /** @type {(Head | null)[]} */
    this.heads = [];
    this.count = 0;
    this.images = new Uint16Array(0);
    this.highest = new Uint16Array(0);
    this.glow = new Float32Array(0);
    /** @type {Uint16Array | null} */
    this.held = null;
    this.forget();
  }

  forget() {
    this.cursor = null;
    this.still = null;
    this.held = null;
    this.forgetImages();
  }

  /** A new connection: the program sends everything again. */
  connected() {
    this.log = [];
  }

  /**
   * Handles a text message.
   * @param {import("./types.d.ts").Line} line
   */
  line(line) {
    if (line.type === "none") {
      delete this.states[line.of];
      return;
    }
    if (line.type === "say") {
      this.keep(line);
      return;
    }
    if (line.type === "log") {
      for (const said of line.said) this.keep(said);
      return;
    }
    Object.assign(this.states, { [line.type]: line });
    if (line.type !== "hello") return;
    delete this.states.end;
    take(line.palette);
    const garment = garmentOf(line);
    if (this.garment?.key !== garment.key) {
      this.forget();
      this.images = new Uint16Array(this.size * garment.taxels);
      this.held = new Uint16Array(garment.taxels);
      this.highest = new Uint16Array(GLOWING * garment.taxels);
      this.glow = new Float32Array(garment.taxels);
    }
    this.garment = garment;
  }

  /**
   * Keeps a line of the live log. After a restart of the board's clock, no moment can be sought by earlier lines.
   * @param {SayLine} line
   */
  keep(line) {
    const newest = this.log.findLast(({ time_us: time }) => time !== null)?.time_us ?? 0;
    if (line.time_us !== null && line.time_us < newest) this.log = this.log.map((old) => ({ ...old, time_us: null }));
    this.log.push(line);
    const { log } = this;
    const isOld = (/** @type {number | null | undefined} */ then) =>
      line.time_us !== null && (typeof then !== "number" || line.time_us - then > this.kept * 1e6);
    while (log.length > MOST || (log.length > LOGGED && isOld(log[0]?.time_us))) log.shift();
  }

  /**
   * Lines of the live log that have a time.
   * @returns {Said[]}
   */
  get marks() {
    return this.log.flatMap(({ time_us: time, kind, said }) => (time === null ? [] : [[time, kind, said]]));
  }

  /**
   * Handles an image, also while paused, so that it can be stepped to.
   * @param {import("./types.d.ts").ImageMessage} message
   */
  image({ image, highest, samples, ...head }) {
    const { garment, latest, held } = this;
    if (!garment || !held || image.length !== garment.taxels) return;
    if (!this.follows(head.frame, latest?.head.frame.time_us)) return;
    for (let taxel = 0; taxel < highest.length; taxel += 1) {
      held[taxel] = Math.max(held[taxel] ?? 0, highest[taxel] ?? 0);
    }
    if (this.cursor !== null && this.count - this.cursor >= this.size) this.cursor += 1;
    const slot = this.count % this.size;
    this.images.set(image, slot * garment.taxels);
    this.highest.set(highest, (this.count % GLOWING) * garment.taxels);
    this.heads[slot] = {
      ...head,
      poses: this.states.poses ?? null,
      folding: this.states.folding ?? null,
      came: performance.now(),
      samples: Float64Array.from(samples.flat()),
    };
    this.count += 1;
    this.latest = this.at(this.count - 1);
  }

  /**
   * True if an image is kept; discards images that do not lead to it.
   * @param {import("./types.d.ts").Frame} frame
   * @param {number | undefined} newest
   */
  follows({ time_us: time, seeks: sent, past }, newest) {
    const seeks = sent ?? null;
    const sought = seeks !== this.seeks;
    if (sought) {
      // Another moment of a recording: held pressures are discarded.
      this.seeks = seeks;
      this.clearHeld();
    } else if (newest !== undefined && time <= newest && (past || newest - time < TWICE)) return false;
    if (sought || (newest !== undefined && time < newest)) this.forgetImages();
    return true;
  }

  /** Discards the images, except for the one shown while paused. */
  forgetImages() {
    this.count = 0;
    this.heads = new Array(this.size).fill(null);
    this.latest = null;
    if (this.cursor !== null) this.cursor = 0;
  }

  /**
   * Numbers of the kept images: first, and one past the last.
   * @returns {[number, number]}
   */
  span() {
    const { heads, latest } = this;
    let first = Math.max(0, this.count - this.size);
    const oldest = latest ? latest.head.frame.time_us - this.kept * 1e6 : 0;
    while (first < this.count && (heads[first % this.size]?.frame.time_us ?? 0) < oldest) first += 1;
    return [first, this.count];
  }

  /**
   * The image with this number.
   * @param {number} number
   * @returns {Shown}
   */
  at(number) {
    const slot = number % this.size;
    const taxels = this.garment?.taxels ?? 0;
    const head = this.heads[slot];
    if (!head) throw new Error(`image ${number} is not kept`);
    return { number, head, image: this.images.subarray(slot * taxels, (slot + 1) * taxels) };
  }

  /** The player of a recording; null for a board. */
  get recorded() {
    return this.states.player ?? null;
  }

  /**
   * The image shown while paused, or the newest; null before the first.
   * @returns {Shown | null}
   */
  shown() {
    return this.still ?? this.latest;
  }

  /**
   * The image that was the newest at a moment of the page, ms; null if that is not kept.
   * @param {number} moment
   */
  newestAt(moment) {
    let number = this.count - 1;
    const first = Math.max(0, this.count - this.size);
    while (number >= first && this.at(number).head.came > moment) number -= 1;
    return number >= first ? this.at(number) : null;
  }

  /** Time of the right end of the live half minute, us; it is fixed while paused. */
  end() {
    return this.still?.end ?? this.newest();
  }

  /** Time of the newest image, us. */
  newest() {
    return this.latest?.head.frame.time_us ?? 0;
  }

  /** True if the picture stands still. */
  get paused() {
    return this.recorded ? !this.recorded.playing : this.still !== null;
  }

  /**
   * Pauses at an image, which is kept although its slot is reused.
   * @param {number} number
   */
  stand(number) {
    const { head, image } = this.at(number);
    const time = head.frame.time_us;
    const end = Math.max(time, this.still?.end ?? this.newest());
    this.cursor = number;
    const glow = time === this.newest() ? this.glowing() : this.glowAt(number);
    this.still = { number, head, image: image.slice(), end, glow: glow.slice() };
  }

  /** Pauses at the newest image, or resumes. */
  pause(still = !this.paused) {
    if (still && this.count) this.stand(this.count - 1);
    else if (!still) this.cursor = this.still = null;
  }

  /**
   * Steps this many images forward or back.
   * @param {number} images
   */
  step(images) {
    if (!this.count) return;
    const [first, end] = this.span();
    const from = this.cursor ?? end - 1;
    this.stand(Math.max(first, Math.min(end - 1, from + images)));
  }

  /**
   * Pauses at the last image up to a time of the board, us, or at the oldest.
   * @param {number} wanted
   */
  seek(wanted) {
    if (!this.count) return;
    const [first, end] = this.span();
    let number = end - 1;
    while (number > first && this.at(number).head.frame.time_us > wanted) number -= 1;
    this.stand(number);
  }

  /** Seconds between the image shown and the end of the half minute. */
  behind() {
    const shown = this.shown();
    return shown ? (this.end() - shown.head.frame.time_us) / 1e6 : 0;
  }

  /** The afterglow at the image shown. */
  glowing() {
    if (this.still) return this.still.glow;
    if (this.states.lost) return afterglow([], this.glow);
    return this.count ? this.glowAt(this.count - 1) : this.glow;
  }

  /**
   * The afterglow at an image, from the second before it; its duration does not depend on the playing speed.
   * @param {number} number
   */
  glowAt(number) {
    const taxels = this.garment?.taxels ?? 0;
    const { time_us: now } = this.at(number).head.frame;
    const slow = 1e6 * Math.max(1, this.recorded?.speed ?? 1);
    /** @type {[ArrayLike<number>, number][]} */
    const images = [];
    for (let at = number; at >= Math.max(0, this.count - this.size); at -= 1) {
      const age = (now - this.at(at).head.frame.time_us) / slow;
      if (age > FADE_S) break;
      const slot = at % GLOWING;
      const recent = this.count - at <= GLOWING;
      images.push([recent ? this.highest.subarray(slot * taxels, (slot + 1) * taxels) : this.at(at).image, age]);
    }
    const before = this.states.glow;
    if (before && before.seeks === this.seeks) {
      // Pressure before the moment of a jump, whose images are not sent.
      before.values ??= spread(before.taxels, taxels);
      images.push([before.values, (now - before.time_us) / slow]);
    }
    return afterglow(images, this.glow);
  }

  /**
   * Lines of the log up to the moment shown, newest first.
   * @returns {import("./types.d.ts").LogEntry[]}
   */
  lines() {
    const { overview } = this.states;
    if (this.recorded && overview) {
      const said = logAt(overview.said, this.moment() * 1e6);
      return said.map(([at, kind, said]) => ({ at, kind, said, leads: true }));
    }
    const until = this.still ? this.still.head.frame.time_us : Infinity;
    const [first, past] = this.span();
    const oldest = first < past ? this.at(first).head.frame.time_us : Infinity;
    const said = this.log.filter(({ time_us: time }) => time === null || time <= until);
    return said.slice(-LINES).reverse().map(({ time_us: at, kind, said }) => ({ at, kind, said, leads: at !== null && at >= oldest }));
  }

  /** Seconds from the beginning of a recording to the moment shown. */
  moment() {
    if (!this.recorded) return 0;
    const { playing, at, seeks } = this.recorded;
    const shown = this.latest?.head.frame.at_us;
    if (shown === undefined) return at;
    if (seeks !== this.seeks) return shown / 1e6;
    // While playing, images are more frequent than messages of the player; without images, only the player
    // advances.
    return playing ? Math.max(shown / 1e6, at) : at;
  }

  /** Nothing has been pressed yet. */
  clearHeld() {
    this.held?.fill(0);
  }

  /** Faults of taxels, by number. */
  faulty() {
    return new Map((this.states.health_map?.faulty || []).map(({ taxel, health }) => [taxel, health]));
  }
}

/**
 * An image of this many taxels, from the values that are not 0.
 * @param {[number, number][]} sent
 * @param {number} taxels
 */
function spread(sent, taxels) {
  const values = new Uint16Array(taxels);
  for (const [taxel, counts] of sent) values[taxel] = counts;
  return values;
}
