// The other boards of a robot, followed while the picture of the whole robot is looked at.

import { connect } from "./socket.js";
import { KEPT_S, Store } from "./store.js";

/** Boards whose images are kept as long as those of the page's own board: those of more boards for a shorter time. */
const FULL = 8;

/** State of each other board, by name. */
export class Others {
  /** @param {() => void} changed */
  constructor(changed) {
    this.changed = changed;
    /** @type {Map<string, { store: Store, close: () => void }>} */
    this.boards = new Map();
  }

  /**
   * Follows all boards of a robot but the page's own, and no others; none without a robot.
   * @param {import("./messages.d.ts").RobotLine | undefined} robot
   */
  follow(robot) {
    const names = (robot?.boards ?? []).map(({ name }) => name).filter((name) => name !== robot?.board);
    for (const [name, { close }] of this.boards) {
      if (names.includes(name)) continue;
      close();
      this.boards.delete(name);
    }
    const kept = Math.max(1, KEPT_S * Math.min(1, FULL / names.length));
    for (const name of names) if (!this.boards.has(name)) this.boards.set(name, this.open(name, kept));
  }

  /**
   * @param {string} name
   * @param {number} kept seconds
   */
  open(name, kept) {
    const store = new Store(kept);
    /** @type {<What>(act: (what: What) => void) => (what: What) => void} */
    const change = (act) => (what) => {
      act(what);
      this.changed();
    };
    const { close } = connect(
      {
        image: change((message) => store.image(message)),
        line: change((line) => store.line(line)),
        connected: (connected) => connected && store.connected(),
        heard: () => {},
      },
      `/boards/${name}/socket`,
    );
    return { store, close };
  }

  /**
   * State of a board; null if it is not followed.
   * @param {string} name
   */
  of(name) {
    return this.boards.get(name)?.store ?? null;
  }
}
