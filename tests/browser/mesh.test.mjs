// Modules of the page that need no browser: the mesh of the surface, its camera, local maxima, units and places.

import { test } from "node:test";
import assert from "node:assert/strict";
import { load } from "./module.fixture.mjs";

const [camera, mesh, peaks, units, garment] = await Promise.all(
  ["camera", "mesh", "peaks", "units", "garment"].map(load),
);

const HELLO = {
  panels: [
    { name: "back", region: "back", link: "torso", rows: 4, columns: 3, pitch_um: [12_000, 10_000] },
    { name: "arm", region: "arm", link: "elbow", rows: 2, columns: 2, pitch_um: [12_000, 10_000] },
  ],
  absent: [{ panel: 0, row: 3, column: 2, rows: 1, columns: 1 }],
  counts_per_newton: 1000,
};
const dressed = garment.garmentOf(HELLO);
const built = mesh.meshOf(dressed.panels, dressed.absent, false);
const BOX = built.box;

test("every four neighbours make a face, except where a taxel is missing", () => {
  // 3 x 2 faces less the one with the missing taxel, and 1.
  assert.equal(built.faces.length / 4, 3 * 2 - 1 + 1);
  assert.ok(!built.faces.includes(11));
  assert.deepEqual([...built.places.slice(0, 2)], [6, 5]);
  // The arm stands beside the back, or before it if the picture is tall.
  assert.ok(built.places[2 * 12] > 36 && built.places[2 * 12 + 1] === 5);
  const tall = mesh.meshOf(dressed.panels, dressed.absent, true);
  assert.ok(tall.places[2 * 12] === 6 && tall.places[2 * 12 + 1] > 40);
});

test("heights are pressure, up to their end, and what is flat has the colour of the scale", () => {
  const relief = mesh.flat(dressed.taxels);
  const image = new Uint16Array(dressed.taxels);
  image[4] = 100;
  image[12] = 900;
  mesh.raise(relief, built, image, { top: 200, highest: 400 });
  const of = (taxel) => [...relief.data.slice(3 * taxel, 3 * taxel + 3)];
  assert.deepEqual(of(0).slice(0, 2), [0, 0]);
  assert.ok(Math.abs(of(4)[0] - BOX[2] / 4) < 1e-3 && of(4)[1] === 0.5);
  // The middle of a peak is flat.
  assert.equal(of(4)[2], 1);
  assert.ok(Math.abs(of(12)[0] - BOX[2]) < 1e-3 && of(12)[1] === 1);
  for (let slope = -9; slope <= 9; slope += 0.5) {
    const light = mesh.light(slope, slope / 2);
    assert.ok(light <= 1 && light > 0.5, `${light} at ${slope}`);
  }
  assert.equal(mesh.heightOf(Uint16Array.of(3, 401), 200), 600);
});

test("scales have round marks", () => {
  assert.deepEqual(mesh.ticks(15), [0, 5, 10, 15]);
  assert.deepEqual(mesh.ticks(1), [0, 0.25, 0.5, 0.75, 1]);
  for (const end of [0.07, 1.7, 13.3, 400, 51_200]) {
    const marks = mesh.ticks(end);
    assert.ok(marks.length >= 4 && marks.length <= 11 && marks.at(-1) <= end * 1.000001, `${end}: ${marks}`);
  }
});

const PICTURES = [
  [866, 430],
  [350, 540],
  [300, 300],
];

test("all of the surface is in the picture, whichever way it is turned", () => {
  for (const [width, height] of PICTURES) {
    for (let turn = 0; turn < 6.3; turn += 0.35) {
      for (let tilt = -1; tilt < 1.5; tilt += 0.25) {
        const { place } = camera.sight(camera.turned(camera.home(), turn, tilt), BOX, [width, height], [50, 30]);
        for (let corner = 0; corner < 8; corner += 1) {
          const [x, y] = place(corner & 1 && BOX[0], corner & 2 && BOX[1], corner & 4 && BOX[2]);
          const inside = x > 49.9 && y > 29.9 && x < width - 49.9 && y < height - 29.9;
          assert.ok(inside, `${x}, ${y} of ${width} x ${height}, turned by ${turn}, tilted by ${tilt}`);
        }
      }
    }
  }
});

test("WebGL and the canvas see a point at the same place", () => {
  const [width, height] = PICTURES[0];
  const { matrix, place } = camera.sight(camera.turned(camera.home(), 1, 0.3), BOX, [width, height], [50, 30]);
  const depth = [];
  for (const point of [[0, 0, 0], [...BOX], [20, 30, 5]]) {
    const clip = [0, 1, 2, 3].map((row) => [...point, 1].reduce((sum, part, at) => sum + part * matrix[at * 4 + row], 0));
    const [x, y, near] = place(...point);
    assert.ok(Math.abs(((clip[0] / clip[3] + 1) / 2) * width - x) < 0.01);
    assert.ok(Math.abs(((1 - clip[1] / clip[3]) / 2) * height - y) < 0.01);
    assert.ok(Math.abs(clip[2] / clip[3]) <= 1);
    depth.push([near, clip[2] / clip[3]]);
  }
  // What is nearer for one is nearer for the other.
  depth.sort((a, b) => a[0] - b[0]);
  assert.ok(depth[0][1] > depth[1][1] && depth[1][1] > depth[2][1], depth.join(" "));
});

test("what the pointer is on stays under it, and the camera never goes below the floor", () => {
  const at = [120, -40];
  const of = (seen) => {
    const [x, y] = camera.sight(seen, BOX, [866, 430], [50, 30]).place(20, 30, 0);
    return [x - 433 - at[0], y - 215 - at[1]];
  };
  const first = camera.home();
  const next = camera.nearer(first, 2, at);
  of(first).forEach((part, axis) => assert.ok(Math.abs(of(next)[axis] - 2 * part) < 1e-6));
  assert.equal(camera.nearer(first, 1e9).zoom, 12);
  assert.ok(camera.turned(first, 0, -9).tilt > 0);
});

test("the foremost face under a point gives its nearest taxel", () => {
  // Two faces one behind the other: taxels 0 to 3, and nearer 4 to 7.
  const square = (near, x) => [x, 0, near, x + 10, 0, near, x + 10, 10, near, x, 10, near];
  const seen = Float32Array.from([...square(1, 0), ...square(2, 5)]);
  const faces = Uint32Array.of(0, 1, 2, 3, 4, 5, 6, 7);
  assert.equal(mesh.under(seen, faces, 2, 2), 0);
  assert.equal(mesh.under(seen, faces, 6, 9), 7);
  assert.equal(mesh.under(seen, faces, 40, 2), null);
});

test("maxima are found once, the greatest first", () => {
  const [back] = dressed.panels;
  const image = Uint16Array.of(0, 0, 9, 0, 0, 0, 7, 7, 0, 0, 0, 0, 50, 0, 0, 0);
  assert.deepEqual(peaks.maxima(image, back, 5), [
    { row: 0, column: 2, value: 9 },
    { row: 2, column: 0, value: 7 },
  ]);
});

test("taxels have places, and counts have units", () => {
  assert.equal(dressed.taxels, 16);
  const { panel, row, column } = garment.placeOf(dressed, 15);
  assert.deepEqual([panel.name, row, column], ["arm", 1, 1]);
  assert.equal(units.pressure(dressed, 120), "1.0 kPa");
  assert.equal(units.force(dressed, 2500), "2.5 N");
  const raw = garment.garmentOf({ ...HELLO, counts_per_newton: null });
  assert.equal(units.pressure(raw, 120), "120 counts");
});

test("ticks have the decimals that distinguish them", () => {
  const labels = (end) => {
    const marks = mesh.ticks(end);
    return marks.map((mark) => mark.toFixed(mesh.decimals(marks)));
  };
  assert.deepEqual(labels(0.2), ["0.00", "0.05", "0.10", "0.15", "0.20"]);
  assert.deepEqual(labels(8), ["0.0", "2.5", "5.0", "7.5"]);
  for (const end of [0.07, 0.2, 0.9, 1.7, 3, 42, 800]) assert.equal(new Set(labels(end)).size, mesh.ticks(end).length, end);
});
