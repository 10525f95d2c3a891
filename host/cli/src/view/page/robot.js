// The boards of a robot: which there are, and how they are.

import { $, make, say } from "./dom.js";
import { agoText } from "./presence.js";

/** @typedef {import("./messages.d.ts").RobotLine["boards"][number]} Board */

/**
 * State of a board, in words.
 * @param {Board} board
 * @param {number} now ms since 1970
 */
export function condition({ state, since_us: since, why, contacts }, now) {
  if (state === "live") return contacts === 1 ? "1 contact" : `${contacts} contacts`;
  const ago = since === null ? "" : ` for ${agoText(now - since / 1000)}`;
  return `${state}${ago}${why ? `: ${why}` : ""}`;
}

/** Links to the pages of the boards. */
export class Robot {
  constructor() {
    this.key = "";
    /** @type {HTMLAnchorElement[]} */
    this.links = [];
  }

  /** @param {import("./store.js").Store} store */
  draw({ states: { robot } }) {
    $("boards").hidden = !robot;
    if (robot) this.boards(robot);
  }

  /** @param {import("./messages.d.ts").RobotLine} robot */
  boards(robot) {
    const key = robot.boards.map(({ name }) => name).join();
    if (key !== this.key) {
      this.key = key;
      this.links = robot.boards.map(({ name }) => make("a", { href: `/boards/${name}/` }, make("b", {}, name), make("span")));
      $("boards").replaceChildren(...this.links);
    }
    robot.boards.forEach((board, at) => {
      const link = this.links[at];
      if (!link) return;
      const drawn = condition(board, Date.now());
      link.classList.toggle("lost", board.state !== "live");
      if (link.title !== drawn) link.title = drawn;
      say(link.lastElementChild ?? link, board.state === "live" ? String(board.contacts) : board.state);
      const shown = board.name === robot.board;
      if (shown) link.setAttribute("aria-current", "page");
      if (shown) document.body.classList.toggle("lost", board.state !== "live");
    });
  }
}
