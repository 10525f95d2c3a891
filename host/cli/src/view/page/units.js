// Formats counts for people. Newtons and pascals are used only if the counts per newton are known.

const unit = { kpa: true };

/** Pressures in kPa (if possible) or in counts. */
export const toggleUnit = () => (unit.kpa = !unit.kpa);

/**
 * True if pressures are in kPa: then the scale must be the same on all panels.
 * @param {import("./types.d.ts").Garment} garment
 * @returns {boolean}
 */
export function isPascal(garment) {
  const areas = new Set(garment.panels.map((panel) => panel.mm[0] * panel.mm[1]));
  const known = garment.panels.every((panel) => panel.known);
  return unit.kpa && known && areas.size === 1 && (garment.counts_per_newton ?? 0) > 0;
}

/**
 * kPa per count, if isPascal.
 * @param {import("./types.d.ts").Garment} garment
 */
export function pascalsOf(garment) {
  const [x, y] = garment.panels[0]?.mm ?? [10, 10];
  return 1000 / (garment.counts_per_newton ?? 1) / (x * y);
}

const digits = (/** @type {number} */ value) => (value >= 100 ? value.toFixed(0) : value.toFixed(1));

/**
 * The pressure of a taxel.
 * @param {import("./types.d.ts").Garment} garment
 * @param {number} counts
 */
export function pressure(garment, counts) {
  return isPascal(garment) ? `${digits(counts * pascalsOf(garment))} kPa` : `${Math.round(counts)} counts`;
}

/**
 * The force of a contact.
 * @param {import("./types.d.ts").Garment} garment
 * @param {number} counts
 */
export function force(garment, counts) {
  const newton = garment.counts_per_newton ?? 0;
  return newton > 0 ? `${digits(counts / newton)} N` : `${Math.round(counts)} counts`;
}

/**
 * The force of a contact: by the calibration's curves where the board's message has it.
 * @param {import("./types.d.ts").Garment} garment
 * @param {import("./types.d.ts").Contact} touch
 */
export function touchForce(garment, { force_n: newtons, total }) {
  return typeof newtons === "number" ? `${digits(newtons)} N` : force(garment, total);
}

/**
 * The unit, and how reliable it is.
 * @param {import("./types.d.ts").Garment} garment
 */
export function provenance({ force_basis: basis, calibration }) {
  if (basis === "calibrated") return `calibrated: ${calibration}`;
  return basis === null ? "counts: not calibrated" : `${basis} newtons, not calibrated`;
}

/** Seconds of board time. */
export const seconds = (/** @type {number} */ us) => (us / 1e6).toFixed(2);
