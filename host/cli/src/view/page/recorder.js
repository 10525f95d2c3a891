// Buttons and keys of the player of a recording. The player is in the program, and all pages follow it.

import { $, make, one, say } from "./dom.js";
import { KINDS, mark } from "./events.js";
import { legend, Timeline } from "./timeline-view.js";
import { neighbour, nextSpeed, SPEEDS, speedText, timeText } from "./timeline.js";

/** Keys of a recording, for the list of keys. */
export const KEYS = [
  ["space", "play, pause"],
  ["← →", "one image back, forward; with shift one second"],
  ["n b", "next mark, mark before"],
  ["Home End", "beginning, end of the range"],
  ["[ ]", "begin, end the range here"],
  ["r", "range: all of it"],
  ["l", "loop"],
  [", .", "slower, faster"],
];

/** The transport. */
export class Recorder {
  /**
   * @param {import("./store.js").Store} store
   * @param {import("./types.d.ts").Ask} ask
   */
  constructor(store, ask) {
    this.store = store;
    this.ask = ask;
    this.timeline = new Timeline(store, ask);
    this.speed = one(HTMLSelectElement, "speed");
    this.speed.append(...SPEEDS.map((speed) => make("option", { value: speed }, speedText(speed))));
    this.speed.addEventListener("change", () => ask({ speed: Number(this.speed.value) }));
    $("loop").addEventListener("click", () => this.key({ key: "l", shiftKey: false }));
    $("all").addEventListener("click", () => this.key({ key: "r", shiftKey: false }));
    /** @type {string | undefined} */
    this.theme = undefined;
  }

  /**
   * True if the key was handled.
   * @param {{ key: string, shiftKey: boolean }} event
   */
  key({ key, shiftKey }) {
    const { recorded, states } = this.store;
    if (!recorded) return false;
    const said = states.overview?.said ?? [];
    const at = this.store.moment();
    const [from, to] = recorded.range;
    const go = (/** @type {import("./types.d.ts").Said | null} */ line) => line && this.ask({ seek: line[0] / 1e6 });
    /** @type {Record<string, () => void>} */
    const acts = {
      " ": () => this.ask({ play: !recorded.playing }),
      ArrowLeft: () => (shiftKey ? this.ask({ seek: at - 1 }) : this.ask({ step: -1 })),
      ArrowRight: () => (shiftKey ? this.ask({ seek: at + 1 }) : this.ask({ step: 1 })),
      Home: () => this.ask({ seek: from }),
      End: () => this.ask({ seek: to }),
      n: () => go(neighbour(said, at * 1e6, 1)),
      b: () => go(neighbour(said, at * 1e6, -1)),
      "[": () => this.ask({ range: [at, Math.max(to, at)] }),
      "]": () => this.ask({ range: [Math.min(from, at), at] }),
      r: () => this.ask({ range: null }),
      l: () => this.ask({ loop: !recorded.loop }),
      ",": () => this.ask({ speed: nextSpeed(recorded.speed, -1) }),
      ".": () => this.ask({ speed: nextSpeed(recorded.speed, 1) }),
    };
    acts[key]?.();
    return key in acts;
  }

  draw() {
    const { store } = this;
    if (!store.recorded) return;
    const { states } = store;
    const { playing, speed, loop, range, duration } = store.recorded;
    const at = store.moment();
    say($("pause"), playing ? "Pause" : "Play");
    $("loop").setAttribute("aria-pressed", String(loop));
    const whole = range[0] <= 0 && range[1] >= duration;
    one(HTMLButtonElement, "all").disabled = whole;
    say($("save-recording"), whole ? "Recording (MCAP)" : `Range ${timeText(range[0], 1)} – ${timeText(range[1], 1)} s (MCAP)`);
    this.speeds(speed);
    const pages = states.link?.pages ?? 1;
    say($("viewers"), pages > 1 ? `${pages} viewers: all see this moment` : "");
    const frame = store.latest ? `  #${store.latest.head.frame.frame}` : "";
    say($("clock"), `${timeText(at, 3)} / ${timeText(duration)} s${frame}`);
    if (this.theme !== document.documentElement.dataset.theme) {
      this.theme = document.documentElement.dataset.theme;
      legend($("legend"), KINDS, mark);
    }
    this.timeline.draw();
  }

  /**
   * Offers the present speed if it is not one of the usual ones.
   * @param {number} speed
   */
  speeds(speed) {
    const list = this.speed;
    if (Number(list.value) === speed || document.activeElement === list) return;
    let option = [...list.options].find((option) => Number(option.value) === speed);
    option ??= list.appendChild(make("option", { value: speed }, speedText(speed)));
    list.value = option.value;
  }
}
