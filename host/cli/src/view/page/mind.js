// What the touches of all boards mean to the robot: in words, and on demand in numbers.

import { $, one, say } from "./dom.js";
import { Bars } from "./bars.js";

/** @typedef {import("./messages.d.ts").RobotIntentLine} Meaning */

/** Mover whose motion has caused a touch, in words. */
const MOVERS = { own: "the robot", other: "what touches it", unsure: "unsure" };

/**
 * The cells of a touch.
 * @param {Meaning["touches"][number]} touch
 * @param {import("./messages.d.ts").RobotLine | undefined} robot
 */
export function cells({ board, contact, region, link, load, mover, approach }, robot) {
  const of = robot?.boards[board];
  const name = of?.name ?? String(board);
  const force = of?.counts_per_newton ? `${(load / 1000).toFixed(1)} N` : `${load} counts`;
  const moved = MOVERS[/** @type {keyof typeof MOVERS} */ (mover)] ?? mover;
  const speed = approach ? (1000 * approach.normal_m_s).toFixed(0) : "?";
  return [`${name} ${contact}`, `${region} (${link})`, moved, force, speed];
}

/** Meaning of touches to the robot, above the picture of a board. */
export class Mind {
  constructor() {
    this.bars = new Bars($("mind-concepts"));
    this.details = one(HTMLDetailsElement, "mind-details");
  }

  /** @param {import("./store.js").Store} store */
  draw({ states: { robot, robot_intent: meaning } }) {
    $("mind").hidden = !meaning;
    if (!meaning) return;
    say($("mind-said"), meaning.text);
    // What is closed is not read.
    if (!this.details.open) return;
    const { concepts, leading, defaults, touches } = meaning;
    this.bars.draw(concepts, leading);
    say($("mind-defaults"), defaults.length ? defaults.join(", ") : "none");
    const table = one(HTMLTableElement, "mind-touches");
    const body = table.tBodies[0] ?? table.createTBody();
    while (body.rows.length > touches.length) body.deleteRow(-1);
    touches.forEach((touch, at) => {
      const row = body.rows[at] ?? body.insertRow();
      cells(touch, robot).forEach((text, column) => say(row.cells[column] ?? row.insertCell(), text));
    });
  }
}
