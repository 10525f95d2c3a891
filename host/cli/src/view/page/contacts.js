// The contacts in words and numbers.

import { say } from "./dom.js";
import { touchForce } from "./units.js";

/**
 * The table of contacts.
 * @param {HTMLTableElement} table
 * @param {HTMLElement} count
 * @param {import("./store.js").Store} store
 */
export function contacts(table, count, store) {
  const shown = store.shown();
  const list = shown ? shown.head.frame.contacts : [];
  say(count, list.length ? String(list.length) : "none");
  const body = table.tBodies[0] ?? table.createTBody();
  const { garment } = store;
  if (!garment) return;
  while (body.rows.length > list.length) body.deleteRow(-1);
  list.forEach((touch, at) => {
    const row = body.rows[at] ?? body.insertRow();
    const mm = garment.panels[touch.panel]?.mm ?? [10, 10];
    const speed = Math.hypot(touch.columns_per_s * mm[0], touch.rows_per_s * mm[1]);
    const cells = [
      touch.region,
      touchForce(garment, touch),
      shown?.head.frame.shapes[at] ?? "",
      String(touch.area),
      `${touch.slip ? "slips " : ""}${speed.toFixed(0)}`,
      String(touch.id),
    ];
    cells.forEach((text, column) => say(row.cells[column] ?? row.insertCell(), text));
  });
}
