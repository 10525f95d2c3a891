// Pause, and steps back through the live half minute, or through a recording.

import { $, say } from "./dom.js";
import { Recorder } from "./recorder.js";
import { KEPT_S } from "./store.js";
import { seconds } from "./units.js";

/** Images of one second. */
const SECOND = 60;

/** The buttons below the picture. */
export class Player {
  constructor(store, ask, changed) {
    Object.assign(this, { store, changed });
    this.recorder = new Recorder(store, ask);
    $("seek").min = -KEPT_S;
    const on = (id, key) => $(id).addEventListener("click", ({ shiftKey }) => this.key({ key, shiftKey }));
    on("pause", " ");
    on("back", "ArrowLeft");
    on("forth", "ArrowRight");
    $("seek").addEventListener("input", ({ target }) => this.do(() => store.seek(-Number(target.value))));
    $("strips").addEventListener("pointerdown", (event) => {
      if (store.recorded) return;
      const { left, width } = $("strips").getBoundingClientRect();
      this.do(() => store.seek(KEPT_S * (1 - (event.clientX - left) / width)));
    });
  }

  do(act) {
    act();
    this.changed();
  }

  /** True if the key was handled. */
  key(event) {
    const { key, shiftKey } = event;
    if (this.store.recorded) return this.recorder.key(event);
    const far = shiftKey ? SECOND : 1;
    const acts = {
      " ": () => this.store.pause(),
      ArrowLeft: () => this.store.step(-far),
      ArrowRight: () => this.store.step(far),
    };
    if (!acts[key]) return false;
    this.do(acts[key]);
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
    $("pause").setAttribute("aria-pressed", String(store.paused));
    if (!shown) return;
    const behind = store.behind();
    if (document.activeElement !== $("seek") || !store.paused) $("seek").value = -Math.min(KEPT_S, behind);
    const { frame, time_us: time } = shown.head.frame;
    say($("clock"), store.paused ? `${seconds(time)} s  (−${behind.toFixed(2)} s)` : `${seconds(time)} s  #${frame}`);
  }
}
