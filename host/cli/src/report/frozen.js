// The surface and the robot of a report: those of the page, with the moment that the report holds.

import { $, forgetColours } from "../view/page/dom.js";
import { take } from "../view/page/colours.js";
import { garmentOf, placeOf } from "../view/page/garment.js";
import { heightOf } from "../view/page/mesh.js";
import { Relief } from "../view/page/relief.js";
import { OnRobot } from "../view/page/on-robot.js";

const data = JSON.parse($("data").textContent ?? "");
take(data.palette);
const garment = garmentOf(data);
const highest = heightOf(data.image, data.top);

/** @type {import("../view/page/relief.js").Scene} */
const scene = {
  key: "report",
  panels: garment.panels,
  absent: garment.absent,
  image: data.image,
  top: data.top,
  highest,
  height: { highest: highest * data.per_count, unit: data.unit },
  peaks: data.peaks,
  chosen: null,
};

/** @type {import("../view/page/on-robot.js").BodyScene | null} */
const onRobot = data.body && {
  body: data.body,
  figure: data.figure,
  poses: data.poses?.links ?? null,
  panels: garment.panels,
  image: data.image,
  unknown: null,
  top: data.top,
  pressing: data.pressing,
  folding: data.folding?.taxels ?? [],
  force: words,
  chosen: null,
};

const changed = () =>
  requestAnimationFrame(() => {
    relief.draw(scene);
    if (onRobot) robot?.draw(onRobot);
  });

/**
 * Pressure or force in the unit of the report.
 * @param {number} value
 */
function words(value) {
  return `${Number((value * data.per_count).toPrecision(3))} ${data.unit}`;
}

/**
 * Says what the taxel under the pointer measured.
 * @param {{ chosen: number | null }} picture
 * @param {string} below element that says it
 * @returns {(taxel: number | null) => void}
 */
const point = (picture, below) => (taxel) => {
  if (taxel === picture.chosen) return;
  picture.chosen = taxel;
  changed();
  if (taxel === null) return;
  const { panel, row, column } = placeOf(garment, taxel);
  $(below).textContent = `${panel.name}, row ${row}, column ${column}: ${words(data.image[taxel])}`;
};

const relief = new Relief($("surface"), { changed, point: point(scene, "pointed") });
const robot = onRobot && new OnRobot($("robot"), { changed, point: point(onRobot, "pointed-robot") });
const dark = matchMedia("(prefers-color-scheme: dark)");
const themed = () => {
  document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
  forgetColours();
  changed();
};
dark.addEventListener("change", themed);
addEventListener("resize", changed);
themed();
