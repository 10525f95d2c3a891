// Pause, and steps back through the live half minute, or through a recording.

import { $, one, say } from "./dom.js";
import { Recorder } from "./recorder.js";
import { KEPT_S } from "./store.js";
import { seconds } from "./units.js";

/** Images of one second. */
const SECOND = 60;

/** The buttons below the picture. */
export class Player {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Ask} ask
   * @param {() => void} changed
   */
  constructor(store, ask, changed) {
    this.store = store;
    this.changed = changed;
    this.recorder = new Recorder(store, ask);
    this.slider = one(HTMLInputElement, "seek");
    this.slider.min = String(-KEPT_S);
    const on = (/** @type {string} */ id, /** @type {string} */ key) =>
      $(id).addEventListener("click", ({ shiftKey }) => this.key({ key, shiftKey }));
    on("pause", " ");
    on("back", "ArrowLeft");
    on("forth", "ArrowRight");
    this.slider.addEventListener("input", () => this.do(() => store.seek(-Number(this.slider.value))));
    $("strips").addEventListener("pointerdown", (event) => {
      if (store.recorded) return;
      const { left, width } = $("strips").getBoundingClientRect();
      this.do(() => store.seek(KEPT_S * (1 - (event.clientX - left) / width)));
    });
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
