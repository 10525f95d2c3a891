// The boards of a robot: which there are, how they are, and what touches all of them.

import { $, make, one, say } from "./dom.js";
import { agoText } from "./presence.js";

/** @typedef {import("./messages.d.ts").RobotLine["boards"][number]} Board */

/**
 * How a board is, in words.
 * @param {Board} board
 * @param {number} now ms since 1970
 */
export function condition({ state, since_us: since, why, contacts }, now) {
  if (state === "live") return contacts === 1 ? "1 contact" : `${contacts} contacts`;
  const ago = since === null ? "" : ` for ${agoText(now - since / 1000)}`;
  return `${state}${ago}${why ? `: ${why}` : ""}`;
}

/**
 * The cells of a contact of the robot.
 * @param {import("./messages.d.ts").RobotContactsLine["contacts"][number]} contact
 */
export function cells({ id, board, panel_name: panel, parts, total, force_n: newtons, area, duration }) {
  const force = typeof newtons === "number" ? `${newtons.toFixed(1)} N` : String(total);
  const on = parts.map((part) => part.board).join(", ");
  return [String(id), `${board}: ${panel}`, on, force, String(area), duration.toFixed(1)];
}

/** Links to the pages of the boards, and the table of the robot's contacts. */
export class Robot {
  constructor() {
    this.key = "";
    /** @type {HTMLAnchorElement[]} */
    this.links = [];
  }

  /** @param {import("./store.js").Store} store */
  draw({ states: { robot, robot_contacts: touches } }) {
    $("boards").hidden = !robot;
    $("robot").hidden = !touches;
    if (robot) this.boards(robot);
    if (touches) this.contacts(touches);
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
      const told = condition(board, Date.now());
      link.classList.toggle("lost", board.state !== "live");
      if (link.title !== told) link.title = told;
      say(link.lastElementChild ?? link, board.state === "live" ? String(board.contacts) : board.state);
      const shown = board.name === robot.board;
      if (shown) link.setAttribute("aria-current", "page");
      if (shown) document.body.classList.toggle("lost", board.state !== "live");
    });
  }

  /** @param {import("./messages.d.ts").RobotContactsLine} told */
  contacts({ contacts }) {
    say($("robot-count"), contacts.length ? String(contacts.length) : "none");
    const table = one(HTMLTableElement, "robot-contacts");
    const body = table.tBodies[0] ?? table.createTBody();
    while (body.rows.length > contacts.length) body.deleteRow(-1);
    contacts.forEach((contact, at) => {
      const row = body.rows[at] ?? body.insertRow();
      cells(contact).forEach((text, column) => say(row.cells[column] ?? row.insertCell(), text));
    });
  }
}
