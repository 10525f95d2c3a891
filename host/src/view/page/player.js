// Pause, and the way back through the last half minute.

import { $, say } from "./dom.js";
import { KEPT_S } from "./store.js";
import { seconds } from "./units.js";

/** Images of one second. */
const SECOND = 60;

/** The buttons below the picture. */
export class Player {
  constructor(store, changed) {
    Object.assign(this, { store, changed });
    $("seek").min = -KEPT_S;
    const on = (id, act) => $(id).addEventListener("click", (event) => this.do(() => act(event)));
    on("pause", () => store.pause());
    on("back", (event) => store.step(event.shiftKey ? -SECOND : -1));
    on("forth", (event) => store.step(event.shiftKey ? SECOND : 1));
    $("seek").addEventListener("input", ({ target }) => this.do(() => store.seek(-Number(target.value))));
  }

  do(act) {
    act();
    this.changed();
  }

  /** Whether a key was meant for this. */
  key({ key, shiftKey }) {
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
    const shown = store.shown();
    say($("pause"), store.paused ? "Go on" : "Pause");
    $("pause").setAttribute("aria-pressed", String(store.paused));
    if (!shown) return;
    const behind = store.behind();
    if (document.activeElement !== $("seek") || !store.paused) $("seek").value = -Math.min(KEPT_S, behind);
    const { frame, time_us: time } = shown.head.frame;
    say($("clock"), store.paused ? `${seconds(time)} s  (−${behind.toFixed(2)} s)` : `${seconds(time)} s  #${frame}`);
  }
}
