// Buttons and keys of the player of a recording. The player is in the program, and all pages follow it.

import { $, make, say } from "./dom.js";
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
  constructor(store, ask) {
    Object.assign(this, { store, ask });
    this.timeline = new Timeline(store, ask);
    $("speed").append(...SPEEDS.map((speed) => make("option", { value: speed }, speedText(speed))));
    $("speed").addEventListener("change", ({ target }) => ask({ speed: Number(target.value) }));
    $("loop").addEventListener("click", () => this.key({ key: "l" }));
    $("all").addEventListener("click", () => this.key({ key: "r" }));
    this.theme = null;
  }

  /** True if the key was handled. */
  key({ key, shiftKey }) {
    const { recorded, states } = this.store;
    const said = states.overview?.said ?? [];
    const at = this.store.moment();
    const [from, to] = recorded.range;
    const go = (line) => line && this.ask({ seek: line[0] / 1e6 });
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
    const { playing, speed, loop, range, duration } = store.recorded;
    const at = store.moment();
    say($("pause"), playing ? "Pause" : "Play");
    $("pause").setAttribute("aria-pressed", String(!playing));
    $("loop").setAttribute("aria-pressed", String(loop));
    const whole = range[0] <= 0 && range[1] >= duration;
    $("all").disabled = whole;
    say($("save-recording"), whole ? "Recording (MCAP)" : `Range ${timeText(range[0], 1)} – ${timeText(range[1], 1)} s (MCAP)`);
    this.speeds(speed);
    const frame = store.latest ? `  #${store.latest.head.frame.frame}` : "";
    say($("clock"), `${timeText(at, 3)} / ${timeText(duration)} s${frame}`);
    if (this.theme !== document.documentElement.dataset.theme) {
      this.theme = document.documentElement.dataset.theme;
      legend($("legend"), KINDS, mark);
    }
    this.timeline.draw();
  }

  /** Offers the present speed if it is not one of the usual ones. */
  speeds(speed) {
    const list = $("speed");
    if (Number(list.value) === speed || document.activeElement === list) return;
    if (![...list.options].some((option) => Number(option.value) === speed))
      list.append(make("option", { value: speed }, speedText(speed)));
    list.value = [...list.options].find((option) => Number(option.value) === speed).value;
  }
}
