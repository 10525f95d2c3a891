// The current garment: panels and their taxel numbers.

/**
 * Built from a `hello`: panels with `base`, `mm` (size of a taxel), and look-ups of places.
 * @param {import("./types.d.ts").Hello} hello
 * @returns {import("./types.d.ts").Garment}
 */
export function garmentOf(hello) {
  let base = 0;
  const panels = hello.panels.map((panel, index) => {
    const mm = /** @type {[number, number]} */ (panel.pitch_um.map((um) => (um || 10000) / 1000));
    const placed = { ...panel, index, base, mm, known: !panel.pitch_um.includes(0) };
    base += panel.rows * panel.columns;
    return placed;
  });
  const absent = new Uint8Array(base);
  for (const gap of hello.absent || []) {
    const panel = panels[gap.panel];
    if (!panel) continue;
    for (let row = gap.row; row < gap.row + gap.rows; row += 1) {
      const start = panel.base + row * panel.columns + gap.column;
      absent.fill(1, start, start + gap.columns);
    }
  }
  return { ...hello, panels, taxels: base, absent, key: JSON.stringify(hello.panels) };
}

/**
 * Panel, row and column of a taxel.
 * @param {import("./types.d.ts").Garment} garment
 * @param {number} taxel
 */
export function placeOf(garment, taxel) {
  const panel = garment.panels.find((p) => taxel < p.base + p.rows * p.columns);
  if (!panel) throw new Error(`no taxel ${taxel}`);
  const local = taxel - panel.base;
  return { panel, row: Math.floor(local / panel.columns), column: local % panel.columns };
}
