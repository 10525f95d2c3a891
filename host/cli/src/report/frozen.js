// The surface of a report: that of the page, with the moment that the report holds.

import { $, forgetColours } from "../view/page/dom.js";
import { take } from "../view/page/colours.js";
import { garmentOf, placeOf } from "../view/page/garment.js";
import { heightOf } from "../view/page/mesh.js";
import { Relief } from "../view/page/relief.js";

const told = JSON.parse($("data").textContent ?? "");
take(told.palette);
const garment = garmentOf(told);
const highest = heightOf(told.image, told.top);

/** @type {import("../view/page/relief.js").Scene} */
const scene = {
  key: "report",
  panels: garment.panels,
  absent: garment.absent,
  image: told.image,
  top: told.top,
  highest,
  height: { highest: highest * told.per_count, unit: told.unit },
  peaks: told.peaks,
  chosen: null,
};

const changed = () => requestAnimationFrame(() => relief.draw(scene));

/**
 * Says what the taxel under the pointer measured.
 * @param {number | null} taxel
 */
function point(taxel) {
  if (taxel === scene.chosen) return;
  scene.chosen = taxel;
  changed();
  if (taxel === null) return;
  const { panel, row, column } = placeOf(garment, taxel);
  const value = Number((told.image[taxel] * told.per_count).toPrecision(3));
  $("told").textContent = `${panel.name}, row ${row}, column ${column}: ${value} ${told.unit}`;
}

const relief = new Relief($("surface"), { changed, point });
const dark = matchMedia("(prefers-color-scheme: dark)");
const themed = () => {
  document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
  forgetColours();
  changed();
};
dark.addEventListener("change", themed);
addEventListener("resize", changed);
themed();
