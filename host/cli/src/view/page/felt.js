// The first thing that one reads: what is felt now, above the picture.

import { palette } from "./colours.js";
import { $, say } from "./dom.js";
import { sentence } from "./sentence.js";

/** Basis of newtons, in words. */
const BASES = {
  simulated: "simulated newtons",
  calibrated: "calibrated newtons",
  nominal: "nominal newtons",
  counts: "counts: not calibrated",
};

/** The sentence without a board. */
const NOBODY = { when: "", what: "waiting for a board", meaning: "" };

/**
 * Draws the sentence; the meaning has the colour that it has on the line of time.
 * @param {import("./store.js").Store} store
 */
export function felt(store) {
  const { garment } = store;
  const { when, what, meaning } = sentence(store) ?? NOBODY;
  say($("when"), when);
  say($("what"), what);
  const leading = $("leading");
  const colour = palette.intentions[meaning];
  say(leading, meaning);
  leading.classList.toggle("means", Boolean(colour));
  leading.style.background = colour ?? "";
  $("sentence").classList.toggle("quiet", ["nothing touches", NOBODY.what].includes(what));
  say($("basis"), BASES[/** @type {keyof typeof BASES} */ (garment?.force_basis ?? "counts")] ?? "");
  $("why").hidden = !garment?.map;
}
