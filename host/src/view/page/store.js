// What the page knows: the garment, the newest messages, and the last half minute of images in places that are made once.

import { garmentOf } from "./garment.js";

/** Seconds that can be stepped back: 30, or as the address says (`/?keep=5`). */
export const KEPT_S = Math.max(1, Math.min(120, Number(new URLSearchParams(location.search).get("keep")) || 30));
/** Images a second that come at most. */
const RATE = 62;

/** All that is shown. `shown()` is the image at the cursor, or the newest. */
export class Store {
  constructor() {
    this.garment = null;
    this.states = {};
    this.log = [];
    this.size = KEPT_S * RATE;
    this.forget();
  }

  forget() {
    this.count = 0;
    this.cursor = null;
    this.heads = new Array(this.size).fill(null);
    this.images = null;
    this.held = null;
    this.latest = null;
  }

  /** Takes a text message. */
  line(line) {
    if (line.type === "say") {
      this.log.unshift(line.text);
      this.log.length = Math.min(this.log.length, 60);
      return;
    }
    this.states[line.type] = line;
    if (line.type !== "hello") return;
    delete this.states.end;
    const garment = garmentOf(line);
    if (this.garment?.key !== garment.key) {
      this.forget();
      this.images = new Uint16Array(this.size * garment.taxels);
      this.held = new Uint16Array(garment.taxels);
    }
    this.garment = garment;
  }

  /** Takes an image. Going on while the page stands still, so that it can be stepped through. */
  image({ image, highest, ...head }) {
    const { garment } = this;
    if (!garment || image.length !== garment.taxels) return;
    const newest = this.latest?.head.frame.time_us;
    if (head.frame.time_us < newest) this.forgetImages();
    for (let taxel = 0; taxel < highest.length; taxel += 1) {
      if (highest[taxel] > this.held[taxel]) this.held[taxel] = highest[taxel];
    }
    head.samples = Float64Array.from(head.samples.flat());
    if (this.cursor !== null && this.count - this.cursor >= this.size) this.cursor += 1;
    const slot = this.count % this.size;
    this.images.set(image, slot * garment.taxels);
    this.heads[slot] = head;
    this.count += 1;
    this.latest = this.at(this.count - 1);
  }

  forgetImages() {
    this.count = 0;
    this.cursor = null;
    this.heads.fill(null);
  }

  /** Numbers of the images that are kept: first, and one past the last. */
  span() {
    const { heads, latest } = this;
    let first = Math.max(0, this.count - this.size);
    const oldest = latest ? latest.head.frame.time_us - KEPT_S * 1e6 : 0;
    while (first < this.count && heads[first % this.size].frame.time_us < oldest) first += 1;
    return [first, this.count];
  }

  /** Image of that number. */
  at(number) {
    const slot = number % this.size;
    const { taxels } = this.garment;
    return { number, head: this.heads[slot], image: this.images.subarray(slot * taxels, (slot + 1) * taxels) };
  }

  /** The image at which the page stands, or the newest; null before there is one. */
  shown() {
    return this.cursor === null || !this.count ? this.latest : this.at(this.cursor);
  }

  get paused() {
    return this.cursor !== null;
  }

  /** Stands still at the newest image, or goes on. */
  pause(still = !this.paused) {
    this.cursor = still && this.count ? this.count - 1 : null;
  }

  /** Goes so many images forward or back. */
  step(images) {
    if (!this.count) return;
    const [first, end] = this.span();
    const from = this.cursor ?? end - 1;
    this.cursor = Math.max(first, Math.min(end - 1, from + images));
  }

  /** Stands at the image nearest to `seconds` before the newest. */
  seek(seconds) {
    if (!this.count) return;
    const [first, end] = this.span();
    const wanted = this.latest.head.frame.time_us - seconds * 1e6;
    let number = end - 1;
    while (number > first && this.at(number).head.frame.time_us > wanted) number -= 1;
    this.cursor = number;
  }

  /** Seconds between the image that is shown and the newest. */
  behind() {
    const shown = this.shown();
    return shown ? (this.latest.head.frame.time_us - shown.head.frame.time_us) / 1e6 : 0;
  }

  /** Nothing has been pressed yet. */
  clearHeld() {
    this.held?.fill(0);
  }

  /** What is wrong with taxels, by number. */
  ill() {
    return new Map((this.states.health_map?.ill || []).map(({ taxel, health }) => [taxel, health]));
  }
}
