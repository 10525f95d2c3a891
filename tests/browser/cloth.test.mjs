// A module of the page that needs no browser: the garment on the robot as cloth.

import { test } from "node:test";
import assert from "node:assert/strict";
import { load } from "./module.fixture.mjs";

const [cloth, figure] = await Promise.all(["cloth", "figure"].map(load));
const marks = await load("robot-marks");

const PANELS = [
  { name: "chest", base: 0, rows: 3, columns: 4, mm: [12, 10], known: true },
  { name: "arm", base: 12, rows: 2, columns: 2, mm: [12, 10], known: true },
  { name: "hand", base: 16, rows: 1, columns: 2, mm: [12, 10], known: true },
];
/** A panel in the plane x = 0.1 m of a link: columns to the robot's left, rows down, facing forward. */
const flat = (link, rows, columns) =>
  Array.from({ length: rows * columns }, (_, at) => {
    const [row, column] = [Math.floor(at / columns), at % columns];
    return [link, [0.1, 0.012 * column, 0.5 - 0.01 * row], [1, 0, 0]];
  });
const BODY = {
  name: "test",
  links: [
    { name: "base", parent: null },
    { name: "torso", parent: 0 },
    { name: "arm", parent: 1 },
  ],
  taxels: [...flat(1, 3, 4), ...flat(2, 2, 2), null, null],
};
const STILL = { at_m: [0, 0, 0], turn: [0, 0, 0, 1] };
const near = (got, want, within = 1e-3) =>
  assert.ok(
    got.length === want.length && got.every((part, axis) => Math.abs(part - want[axis]) <= within),
    `${[...got]} instead of ${want}`,
  );

test("every four neighbours make a face, and panels without a place are named", () => {
  const { faces, taxels, bare } = cloth.clothOf(BODY, PANELS);
  assert.equal(faces.length / 4, 3 * 2 + 1);
  assert.deepEqual(bare, ["hand"]);
  assert.deepEqual([...faces.slice(0, 4)].map((corner) => taxels[corner]), [0, 1, 5, 4]);
});

test("a taxel without a face is a square of its own, and neighbours that are far apart are not joined", () => {
  const taxels = BODY.taxels.map((place) => place && [...place]);
  // Holes below taxels 0 and 1 take their faces. The second row of the arm lies elsewhere.
  taxels[4] = taxels[5] = null;
  for (const taxel of [14, 15]) taxels[taxel] = [2, [0.1, 0.012 * (taxel - 14), 0.1], [1, 0, 0]];
  const built = cloth.clothOf({ ...BODY, taxels }, PANELS);
  const of = (taxel) => [...built.faces].filter((corner) => built.taxels[corner] === taxel).length;
  assert.deepEqual([of(0), of(12), of(15)], [4, 4, 4]);
  const square = [...built.faces].filter((corner) => built.taxels[corner] === 12);
  const places = square.map((corner) => [...built.own.slice(3 * corner, 3 * corner + 3)]);
  // In the plane of its normal, nine tenths of a pitch wide, around its place.
  for (const [x, y, z] of places) near([x, Math.abs(y), Math.abs(z - 0.5)], [0.1, 0.0045, 0.0045], 1e-6);
});

test("the links' poses put each taxel where forward kinematics does", () => {
  const built = cloth.clothOf(BODY, PANELS);
  const half = Math.SQRT1_2;
  const poses = {
    base: STILL,
    torso: { at_m: [0, 0, 1], turn: [0, 0, 0, 1] },
    // A quarter turn about the vertical, to the left: forward becomes left.
    arm: { at_m: [0.2, 0.3, 1], turn: [0, 0, half, half] },
  };
  const bounds = cloth.nothing();
  const { places, normals, origins, box } = cloth.stand(built, BODY, poses, bounds);
  const at = (taxel) => [...places.slice(3 * taxel, 3 * taxel + 3)];
  const apart = (a, b) => a.map((part, axis) => part - b[axis]);
  // The scene: the robot's left is to the right, its front is near, and up is up, in mm.
  near(apart(at(1), at(0)), [12, 0, 0]);
  near(apart(at(4), at(0)), [0, 0, -10]);
  near(apart(origins[2], origins[0]), [300, 200, 1000]);
  // In the arm a step along the columns goes to the left: now it goes back.
  near(apart(at(13), at(12)), [0, -12, 0]);
  near(apart(at(12), origins[2]), [100, 0, 500]);
  near([...normals.slice(3 * 12, 3 * 12 + 3)], [1, 0, 0]);
  for (let axis = 0; axis < 3; axis += 1) {
    const values = [...places].filter((_, index) => index % 3 === axis);
    assert.ok(Math.min(...values) > 0 && Math.max(...values) < box[axis], `axis ${axis}`);
  }
});

test("a robot that moves keeps its size in the picture", () => {
  const built = cloth.clothOf(BODY, PANELS);
  const bounds = cloth.nothing();
  const posed = (left) => ({ base: STILL, torso: STILL, arm: { at_m: [0, left, 0], turn: [0, 0, 0, 1] } });
  const wide = cloth.stand(built, BODY, posed(0.8), bounds).box;
  assert.deepEqual(cloth.stand(built, BODY, posed(0.1), bounds).box, wide);
  assert.ok(cloth.stand(built, BODY, posed(0.9), bounds).box[0] > wide[0]);
});

test("links of no known robot stand side by side", () => {
  const built = cloth.clothOf(BODY, PANELS);
  const { places } = cloth.stand(built, BODY, cloth.sideBySide(BODY), cloth.nothing());
  const right = (link) => [...built.links.keys()].filter((at) => built.links[at] === link).map((at) => places[3 * at]);
  assert.ok(Math.min(...right(2)) - Math.max(...right(1)) > 50);
});

test("cloth that faces the viewer has the colours of the scale, and its inside is dark", () => {
  const built = cloth.clothOf(BODY, PANELS);
  const data = new Float32Array(cloth.STRIDE * built.taxels.length);
  const image = new Uint16Array(18);
  image[4] = 50;
  image[5] = 900;
  cloth.shade(data, built, image, 200);
  assert.deepEqual([0, 4, 5].map((taxel) => data[3 * taxel + 1]), [0, 0.25, 1]);
  const { normals } = cloth.stand(built, BODY, { base: STILL, torso: STILL, arm: STILL }, cloth.nothing());
  const lit = (viewer) => (cloth.light(data, normals, viewer), data[2]);
  assert.equal(lit([0, 1, 0]), 1);
  assert.equal(lit([0.6, 0.8, 0]), 1);
  assert.ok(lit([0.95, 0.31, 0]) < 1 && lit([0.95, 0.31, 0]) > 0.5);
  assert.ok(lit([0, -1, 0]) < 0.4);
});

test("the canvas draws what faces the viewer, the farthest first", () => {
  // Two squares, the nearer one first; one that faces away.
  const seen = Float32Array.from([2, 2, 2, 2, 1, 1, 1, 1, 3, 3, 3, 3].flatMap((nearness) => [0, 0, nearness]));
  const faces = Uint32Array.from({ length: 12 }, (_, at) => at);
  const normals = Float32Array.from({ length: 12 }, (_, at) => (at < 8 ? 1 : -1)).reduce((list, toward) => [...list, 0, toward, 0], []);
  assert.deepEqual([...cloth.facing(seen, faces, Float32Array.from(normals), [0, 1, 0])], [1, 0]);
  assert.deepEqual([...cloth.facing(seen, faces, Float32Array.from(normals), [0, -1, 0])], [2]);
});

test("an arrow ends where the force presses, comes from outside, and is as long as the force", () => {
  const built = cloth.clothOf(BODY, PANELS);
  const bounds = cloth.nothing();
  const { places } = cloth.stand(built, BODY, { base: STILL, torso: STILL, arm: STILL }, bounds);
  const push = (force) => ({ at_m: BODY.taxels[5][1], normal: [1, 0, 0], force_counts: [-force, 0, 0] });
  const { tip, tail, normal } = cloth.arrowOf(STILL, push(300), 3_000, bounds);
  near(tip, [...places.slice(15, 18)]);
  // From the front: 300 of 3,000 counts for a metre.
  near(tail.map((part, axis) => part - tip[axis]), [0, 100, 0]);
  assert.deepEqual(normal, [0, 1, 0]);
  const long = cloth.arrowOf(STILL, push(90_000), 3_000, bounds);
  near([long.tail[1] - long.tip[1]], [200]);
  const none = cloth.arrowOf(STILL, push(0), 3_000, bounds);
  assert.deepEqual(none.tip, none.tail);
});

test("the robot is behind its cloth: its corners have no taxel, look outwards, and are of no colour of the ramp", () => {
  const own = cloth.clothOf(BODY, PANELS);
  // A tetrahedron whose corners are known to look away from its middle, and a link that the body lacks.
  const points = [
    [0, 0, 0],
    [0.1, 0, 0],
    [0, 0.1, 0],
    [0, 0, 0.1],
  ];
  const triangles = [
    [0, 2, 1],
    [0, 1, 3],
    [0, 3, 2],
    [1, 2, 3],
  ];
  const links = ["arm", "nose"].map((name) => ({ name, points, triangles }));
  const all = figure.withFigure(own, BODY, { type: "figure", links });
  const first = own.taxels.length;
  assert.deepEqual([...all.taxels.slice(0, first)], [...own.taxels]);
  assert.deepEqual([...all.taxels.slice(first)], new Array(4).fill(figure.NONE));
  assert.deepEqual([...all.links.slice(first)], [2, 2, 2, 2]);
  assert.deepEqual([...all.faces.slice(own.faces.length)], triangles.flatMap(([a, b, c]) => [a, b, c, c].map((at) => first + at)));
  points.forEach((point, at) => {
    const normal = [...all.normals.slice(3 * (first + at), 3 * (first + at) + 3)];
    const outwards = normal.reduce((sum, part, axis) => sum + part * (point[axis] - 0.025), 0);
    assert.ok(outwards > 0 && Math.abs(Math.hypot(...normal) - 1) < 1e-6, `${normal}`);
    const place = [...all.own.slice(3 * (first + at), 3 * (first + at) + 3)];
    const inside = Math.hypot(...place.map((part, axis) => part - point[axis]));
    assert.ok(Math.abs(inside - 0.003) < 1e-6, `${inside} m`);
  });
  const data = new Float32Array(cloth.STRIDE * all.taxels.length);
  cloth.shade(data, all, new Uint16Array(18).fill(50), 100);
  assert.deepEqual([...Array(4).keys()].map((at) => data[cloth.STRIDE * (first + at) + 1]), [-2, -2, -2, -2]);
  assert.equal(data[1], 0.5);
  assert.deepEqual(figure.withFigure(own, BODY, null).faces, own.faces);
});

test("names that would lie on each other stand below each other, wherever they are", () => {
  for (let y = 40; y < 600; y += 0.1 + 1 / 3) {
    const names = ["left_hand", "left_arm", "torso"].map((name) => ({ name, at: [100, y] }));
    marks.apart(names);
    const rows = names.map(({ at }) => at[1]);
    assert.ok(rows[0] === y && rows[1] - rows[0] > 13.9 && rows[2] - rows[1] > 13.9, `${rows}`);
  }
});
