// The garment on the robot as cloth: which taxels make a face, where the links' poses put each, and how light and how
// red it is. Scenes are in millimetres as the camera sees them: x to the right of whoever looks at the robot's front,
// y towards them, z up. A robot's own axes are those of a URDF: x forward, y to the left, z up, in metres.

import { NONE } from "./figure.js";

/**
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {import("./types.d.ts").BodyState} BodyState
 * @typedef {import("./types.d.ts").PoseOfLink} PoseOfLink
 * @typedef {[number, Triple, Triple]} Place link, place and normal of a taxel
 * @typedef {object} Cloth
 * @property {Uint32Array} taxels number of the taxel of each corner
 * @property {Uint16Array} links number of its link
 * @property {Float32Array} own its place in the frame of the link, m
 * @property {Float32Array} normals its direction away from the robot there
 * @property {Uint32Array} faces four corners each, around the face
 * @property {string[]} bare panels without a place
 * @typedef {object} Standing a cloth in a posture
 * @property {Float32Array} places of each corner, mm of the scene
 * @property {Float32Array} normals of each corner
 * @property {(Triple | null)[]} origins of the links; null for a link without a pose
 * @property {Triple} box extent of the scene, mm
 * @typedef {{ least: Triple, most: Triple }} Bounds mm
 */

/** Sides of a face that are longer than so many pitches join taxels that are no neighbours on the robot. */
const FARTHEST = 2.5;
/** Half of the side of a taxel without a face, pitches. */
const ALONE = 0.45;
/** Free space between two links that stand side by side, m. */
const GAP = 0.08;
/** Free space around the robot, in which forces are drawn, mm. */
const AROUND = 30;
/** Longest arrow, m. */
const LONGEST = 0.2;
/** Light on cloth that is seen from the inside, and at the rim. */
const [INSIDE, RIM] = [0.35, 0.55];

/**
 * @param {BodyState} body
 * @param {Panel[]} panels
 * @returns {Cloth}
 */
export function clothOf(body, panels) {
  const parts = /** @type {Record<"taxels" | "links" | "own" | "normals" | "faces", number[]>} */ ({});
  for (const name of /** @type {const} */ (["taxels", "links", "own", "normals", "faces"])) parts[name] = [];
  /** @type {(taxel: number, place: Place, at: Triple) => number} */
  const corner = (taxel, [link, , normal], at) => {
    parts.links.push(link);
    parts.own.push(...at);
    parts.normals.push(...normal);
    return parts.taxels.push(taxel) - 1;
  };
  for (const panel of panels) {
    /** @type {Map<number, number>} */
    const corners = new Map();
    for (const [taxel, place] of placesOf(body, panel)) corners.set(taxel, corner(taxel, place, place[1]));
    const faces = facesOf(body, panel);
    parts.faces.push(...faces.map((taxel) => corners.get(taxel) ?? 0));
    const joined = new Set(faces);
    const half = (ALONE * Math.min(...panel.mm)) / 1000;
    for (const [taxel, place] of placesOf(body, panel)) {
      if (joined.has(taxel)) continue;
      parts.faces.push(...square(place[1], place[2], half).map((at) => corner(taxel, place, at)));
    }
  }
  return {
    taxels: Uint32Array.from(parts.taxels),
    links: Uint16Array.from(parts.links),
    own: Float32Array.from(parts.own),
    normals: Float32Array.from(parts.normals),
    faces: Uint32Array.from(parts.faces),
    bare: panels.filter((panel) => placesOf(body, panel).length === 0).map(({ name }) => name),
  };
}

/**
 * The taxels of a panel that have a place.
 * @param {BodyState} body
 * @param {Panel} panel
 * @returns {[number, Place][]}
 */
function placesOf({ taxels }, { base, rows, columns }) {
  return taxels.slice(base, base + rows * columns).flatMap((place, at) => (place ? [[base + at, place]] : []));
}

/**
 * Every four neighbours of a panel that are neighbours on the robot, too: their numbers, around the face.
 * @param {BodyState} body
 * @param {Panel} panel
 */
function facesOf({ taxels }, { base, rows, columns, mm, known }) {
  const most = known ? (FARTHEST * Math.max(...mm)) / 1000 : Infinity;
  /** @type {number[]} */
  const faces = [];
  for (let at = 0; at < (rows - 1) * columns; at += 1) {
    if (at % columns === columns - 1) continue;
    const around = [0, 1, columns + 1, columns].map((step) => base + at + step);
    const near = around.every((taxel, side) => {
      const [one, next] = [taxels[taxel], taxels[around[(side + 1) % 4] ?? 0]];
      return one && next && one[0] === next[0] && distance(one[1], next[1]) <= most;
    });
    if (near) faces.push(...around);
  }
  return faces;
}

/**
 * @param {Triple} a
 * @param {Triple} b
 */
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/**
 * The corners of a square around a place, across its normal.
 * @param {Triple} at
 * @param {Triple} normal
 * @param {number} half of its side
 * @returns {Triple[]}
 */
function square(at, normal, half) {
  const [x, y, z] = normal;
  const along = unit(Math.abs(z) < 0.9 ? [-y, x, 0] : [0, -z, y]);
  const across = cross(normal, along);
  return [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([u = 0, v = 0]) => {
    const part = (/** @type {0 | 1 | 2} */ axis) => at[axis] + half * (u * along[axis] + v * across[axis]);
    return [part(0), part(1), part(2)];
  });
}

/**
 * @param {Triple} vector
 * @returns {Triple}
 */
function unit([x, y, z]) {
  const length = Math.hypot(x, y, z) || 1;
  return [x / length, y / length, z / length];
}

/**
 * @param {Triple} a
 * @param {Triple} b
 * @returns {Triple}
 */
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/**
 * A vector turned by a quaternion x, y, z, w of length 1.
 * @param {[number, number, number, number]} quaternion
 * @param {Triple} vector
 * @returns {Triple}
 */
export function rotated([x, y, z, w], vector) {
  const twice = /** @type {Triple} */ (cross([x, y, z], vector).map((part) => 2 * part));
  const more = cross([x, y, z], twice);
  const part = (/** @type {0 | 1 | 2} */ axis) => vector[axis] + w * twice[axis] + more[axis];
  return [part(0), part(1), part(2)];
}

/**
 * Poses for links whose robot is not known: side by side, from the right of the robot to its left.
 * @param {BodyState} body
 * @returns {Record<string, PoseOfLink>}
 */
export function sideBySide(body) {
  /** @type {Record<string, PoseOfLink>} */
  const poses = {};
  let left = 0;
  body.links.forEach(({ name }, link) => {
    const sides = body.taxels.filter((place) => place?.[0] === link).map((place) => place?.[1][1] ?? 0);
    const [least, most] = [Math.min(...sides, 0), Math.max(...sides, 0)];
    poses[name] = { at_m: [0, left - least, 0], turn: [0, 0, 0, 1] };
    left += most - least + GAP;
  });
  return poses;
}

/**
 * Bounds of a scene without anything.
 * @returns {Bounds}
 */
export const nothing = () => ({ least: [Infinity, Infinity, Infinity], most: [-Infinity, -Infinity, -Infinity] });

/**
 * Puts a cloth where the links' poses are. `bounds` grows to hold it, so that a picture of a robot that moves keeps
 * its size.
 * @param {Cloth} cloth
 * @param {BodyState} body
 * @param {Record<string, PoseOfLink>} poses by the links' names; corners of a link without one are at the root
 * @param {Bounds} bounds
 * @returns {Standing}
 */
export function stand({ own, normals, links, taxels }, body, poses, bounds) {
  const ofLink = body.links.map(({ name }) => poses[name] ?? null);
  const places = new Float32Array(own.length);
  const turned = new Float32Array(own.length);
  const origins = ofLink.map((pose) => pose && seen(pose.at_m));
  for (let at = 0; at < taxels.length; at += 1) {
    const pose = ofLink[links[at] ?? 0] ?? { at_m: [0, 0, 0], turn: [0, 0, 0, 1] };
    places.set(placed(pose, triple(own, at)), 3 * at);
    const [x, y, z] = rotated(pose.turn, triple(normals, at));
    turned.set([y, x, z], 3 * at);
    grow(bounds, triple(places, at));
  }
  for (const origin of origins) if (origin) grow(bounds, origin);
  const { least, most } = bounds;
  const base = /** @type {Triple} */ (least.map((part) => (Number.isFinite(part) ? part - AROUND : 0)));
  const shifted = (/** @type {Triple} */ [x, y, z]) => /** @type {Triple} */ ([x - base[0], y - base[1], z - base[2]]);
  for (let at = 0; at < taxels.length; at += 1) places.set(shifted(triple(places, at)), 3 * at);
  const box = /** @type {Triple} */ (most.map((part, axis) => Math.max(1, part + AROUND - (base[axis] ?? 0)) || 1));
  return { places, normals: turned, origins: origins.map((origin) => origin && shifted(origin)), box };
}

/**
 * A place of the robot as the scene has it.
 * @param {Triple} at m
 * @returns {Triple}
 */
const seen = ([x, y, z]) => [1000 * y, 1000 * x, 1000 * z];

/**
 * @param {PoseOfLink} pose
 * @param {Triple} at in the frame of the link, m
 */
function placed({ at_m: origin, turn }, at) {
  const [x, y, z] = rotated(turn, at);
  return seen([origin[0] + x, origin[1] + y, origin[2] + z]);
}

/**
 * @param {Float32Array} list
 * @param {number} at
 * @returns {Triple}
 */
const triple = (list, at) => [list[3 * at] ?? 0, list[3 * at + 1] ?? 0, list[3 * at + 2] ?? 0];

/**
 * @param {Bounds} bounds
 * @param {Triple} point
 */
function grow({ least, most }, point) {
  for (const axis of /** @type {const} */ ([0, 1, 2])) {
    least[axis] = Math.min(least[axis], point[axis]);
    most[axis] = Math.max(most[axis], point[axis]);
  }
}

/** Shares of the ramp that stand for a pressure that is not known, and for the robot itself: they are grey. */
const [UNKNOWN, ROBOT] = [-1, -2];

/** Numbers of a corner in what `shade` and `light` fill, as in a relief: nothing, share of the ramp, and light. */
export const STRIDE = 3;

/**
 * Colours of an image: the share of the ramp at each corner.
 * @param {Float32Array} data
 * @param {Cloth} cloth
 * @param {ArrayLike<number>} image counts
 * @param {number} top end of the colours, counts
 * @param {ArrayLike<number> | null} unknown 1 on taxels of which it is not known what presses
 */
export function shade(data, { taxels }, image, top, unknown = null) {
  for (let at = 0; at < taxels.length; at += 1) {
    const taxel = taxels[at] ?? NONE;
    const share = taxel === NONE ? ROBOT : Math.min(1, (image[taxel] ?? 0) / top);
    data[STRIDE * at + 1] = unknown?.[taxel] ? UNKNOWN : share;
  }
}

/**
 * Light from the viewer: 1 on cloth that faces them, so that its colours are those of the scale.
 * @param {Float32Array} data
 * @param {Float32Array} normals
 * @param {Triple} viewer direction
 */
export function light(data, normals, [x, y, z]) {
  for (let at = 0; STRIDE * at < data.length; at += 1) {
    const facing = (normals[3 * at] ?? 0) * x + (normals[3 * at + 1] ?? 0) * y + (normals[3 * at + 2] ?? 0) * z;
    data[STRIDE * at + 2] = facing < 0 ? INSIDE : Math.min(1, RIM + 0.7 * facing);
  }
}

/**
 * Faces whose outside faces the viewer, the farthest first.
 * @param {Float32Array} seen x, y and nearness of each corner
 * @param {Uint32Array} faces
 * @param {Float32Array} normals
 * @param {Triple} viewer direction
 * @returns {Uint32Array} their numbers
 */
export function facing(seen, faces, normals, [x, y, z]) {
  /** @type {number[]} */
  const found = [];
  const near = new Float32Array(faces.length / 4);
  for (let face = 0; face < near.length; face += 1) {
    let [toward, nearness] = [0, 0];
    for (let corner = 4 * face; corner < 4 * face + 4; corner += 1) {
      const at = 3 * (faces[corner] ?? 0);
      toward += (normals[at] ?? 0) * x + (normals[at + 1] ?? 0) * y + (normals[at + 2] ?? 0) * z;
      nearness += seen[at + 2] ?? 0;
    }
    near[face] = nearness;
    if (toward > 0) found.push(face);
  }
  return Uint32Array.from(found.sort((a, b) => (near[a] ?? 0) - (near[b] ?? 0)));
}

/**
 * A force as an arrow: from where it comes to where it presses, mm of the scene.
 * @param {PoseOfLink} pose of the link
 * @param {{ at_m: Triple, normal: Triple, force_counts: Triple }} push in the frame of the link; the force in counts
 * @param {number} perMetre counts
 * @param {Bounds} bounds of the standing cloth
 * @returns {{ tip: Triple, tail: Triple, normal: Triple }}
 */
export function arrowOf(pose, { at_m: at, normal, force_counts: force }, perMetre, { least }) {
  /** @type {(point: Triple) => Triple} */
  const shifted = ([x, y, z]) => [x - least[0] + AROUND, y - least[1] + AROUND, z - least[2] + AROUND];
  const long = Math.hypot(...force);
  const share = long > 0 ? Math.min(long / perMetre, LONGEST) / long : 0;
  const from = /** @type {Triple} */ (at.map((part, axis) => part - share * (force[axis] ?? 0)));
  const [x, y, z] = rotated(pose.turn, normal);
  return { tip: shifted(placed(pose, at)), tail: shifted(placed(pose, from)), normal: [y, x, z] };
}
