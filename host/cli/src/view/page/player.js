// Pause, and steps back through the live half minute, or through a recording.

import { $, one, say } from "./dom.js";
import { Recorder } from "./recorder.js";
import { KEPT_S } from "./store.js";
import { nearest } from "./timeline.js";
import { seconds } from "./units.js";

/** Images of one second. */
const SECOND = 60;
/** Distance from a mark within which a click is on it, pixels. */
const REACH = 5;

/** The buttons below the picture. */
export class Player {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} changed
   */
  constructor(store, ask, changed) {
    this.store = store;
    this.ask = ask;
    this.changed = changed;
    this.recorder = new Recorder(store, ask);
    this.slider = one(HTMLInputElement, "seek");
    this.slider.min = String(-KEPT_S);
    const on = (/** @type {string} */ id, /** @type {string} */ key) =>
      $(id).addEventListener("click", ({ shiftKey }) => this.key({ key, shiftKey }));
    on("pause", " ");
    on("back", "ArrowLeft");
    on("forth", "ArrowRight");
    this.slider.addEventListener("input", () => this.go(store.end() + Number(this.slider.value) * 1e6));
    $("strips").addEventListener("pointerdown", (event) => {
      if (store.recorded) return;
      const { left, width } = $("strips").getBoundingClientRect();
      const pixel = (KEPT_S * 1e6) / width;
      const at = store.end() - KEPT_S * 1e6 + (event.clientX - left) * pixel;
      this.go(nearest(store.marks, at, REACH * pixel)?.[0] ?? at);
    });
    window.addEventListener("hashchange", () => this.do(() => (this.hash = location.hash)));
    this.hash = location.hash;
  }

  /**
   * Goes to a moment: us of the board, or since the beginning of a recording.
   * @param {number} at
   */
  go(at) {
    if (!this.store.recorded) return this.do(() => this.store.seek(at));
    this.ask({ play: false });
    this.ask({ seek: at / 1e6 });
    history.replaceState(null, "", `#t=${(at / 1e6).toFixed(3)}`);
  }

  /** The address may name a moment of a recording: `#t=12.5`, in seconds. */
  follow() {
    const at = /^#t=(\d+(?:\.\d+)?)$/.exec(this.hash)?.[1];
    this.hash = "";
    if (at !== undefined) this.go(Number(at) * 1e6);
  }

  /** @param {() => void} act */
  do(act) {
    act();
    this.changed();
  }

  /**
   * True if the key was handled.
   * @param {{ key: string, shiftKey: boolean }} event
   */
  key(event) {
    const { key, shiftKey } = event;
    if (this.store.recorded) return this.recorder.key(event);
    const far = shiftKey ? SECOND : 1;
    /** @type {Record<string, () => void>} */
    const acts = {
      " ": () => this.store.pause(),
      ArrowLeft: () => this.store.step(-far),
      ArrowRight: () => this.store.step(far),
    };
    const act = acts[key];
    if (!act) return false;
    this.do(act);
    return true;
  }

  draw() {
    const { store } = this;
    const recorded = Boolean(store.recorded);
    document.body.classList.toggle("recorded", recorded);
    if (recorded && this.hash) this.follow();
    if (recorded) this.recorder.draw();
    else this.live();
  }

  live() {
    const { store } = this;
    const shown = store.shown();
    say($("pause"), store.paused ? "Resume" : "Pause");
    if (!shown) return;
    const behind = store.behind();
    if (document.activeElement !== this.slider || !store.paused) this.slider.value = String(-Math.min(KEPT_S, behind));
    const { frame, time_us: time } = shown.head.frame;
    say($("clock"), store.paused ? `${seconds(time)} s  (−${behind.toFixed(2)} s)` : `${seconds(time)} s  #${frame}`);
  }
}
