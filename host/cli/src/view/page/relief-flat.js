// A relief drawn by the canvas alone, for browsers without WebGL: first the floor, then what rises above it, from
// the back to the front.

import { GREY, palette, ROBOT, stepOf } from "./colours.js";
import { STRIDE } from "./mesh.js";

/**
 * @typedef {import("./mesh.js").Mesh} Mesh
 * @typedef {import("./mesh.js").Relief} Relief
 */

/** Steps of light that are distinguished. */
const LIGHTS = 16;

/** Draws into a canvas of its own. */
export class FlatPainter {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    // Without WebGL there is no graphics card either: the processor draws.
    this.context = canvas.getContext("2d", { willReadFrequently: true });
    /** @type {string[]} */
    this.colours = [];
    /** @type {Uint32Array} */
    this.faces = new Uint32Array(0);
    /** @type {number[][]} */
    this.floor = [];
    this.near = new Float32Array(0);
    this.raised = new Uint32Array(0);
  }

  /**
   * Takes another mesh.
   * @param {Pick<Mesh, "faces">} mesh
   */
  build({ faces }) {
    this.faces = faces;
    this.floor = strips(faces);
    this.near = new Float32Array(faces.length / 4);
    this.raised = new Uint32Array(faces.length / 4);
  }

  /**
   * @param {Float32Array} seen x, y and nearness of each taxel
   * @param {Relief} relief
   * @param {[number, number]} size of the picture in pixels of the screen
   * @param {number} ratio of these pixels to those of `seen`
   */
  draw(seen, { data }, size, ratio) {
    const { faces, near } = this;
    const context = this.begin(size, ratio);
    if (!context) return;
    // Seen from above, a height conceals the floor that it rises from.
    for (const strip of this.floor) fill(context, seen, strip, this.colour(0, 1));
    let count = 0;
    for (let face = 0; face < near.length; face += 1) {
      let [height, nearness] = [0, 0];
      for (let at = 4 * face; at < 4 * face + 4; at += 1) {
        height += data[STRIDE * (faces[at] ?? 0)] ?? 0;
        nearness += seen[3 * (faces[at] ?? 0) + 2] ?? 0;
      }
      if (height === 0) continue;
      near[face] = nearness;
      this.raised[count] = face;
      count += 1;
    }
    const raised = this.raised.subarray(0, count).sort((a, b) => (near[a] ?? 0) - (near[b] ?? 0));
    this.fill(raised, seen, data);
  }

  /**
   * An empty picture; null without a canvas.
   * @param {[number, number]} size of the picture in pixels of the screen
   * @param {number} ratio of these pixels to those of what is drawn
   */
  begin([width, height], ratio) {
    const { canvas, context } = this;
    if (!context) return null;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.lineJoin = "round";
    context.lineWidth = 0.8;
    return context;
  }

  /**
   * Fills faces, one over the other.
   * @param {Iterable<number>} order their numbers
   * @param {Float32Array} seen x, y and nearness of each taxel
   * @param {Float32Array} data of a relief
   */
  fill(order, seen, data) {
    const { context, faces } = this;
    if (!context) return;
    for (const face of order) {
      const corners = faces.subarray(4 * face, 4 * face + 4);
      const mean = (/** @type {number} */ which) =>
        corners.reduce((sum, taxel) => sum + (data[STRIDE * taxel + which] ?? 0), 0) / 4;
      fill(context, seen, corners, this.colour(mean(1), mean(2)));
    }
  }

  /**
   * @param {number} share of the ramp; -1 if it is not known, -2 for the robot
   * @param {number} light
   */
  colour(share, light) {
    const grey = share < -1.5 ? ROBOT : GREY;
    const step = share < 0 ? palette.ramp.length - Math.round(share) : stepOf(share, 1);
    const shade = Math.round(light * LIGHTS);
    const at = step * (LIGHTS + 1) + shade;
    const rgb = palette.ramp[step] ?? [grey, grey, grey].map((part) => 255 * part);
    return (this.colours[at] ??= `rgb(${rgb.map((part) => Math.round((part * shade) / LIGHTS)).join(" ")})`);
  }
}

/**
 * The floor in as few pieces as there are rows: the corners of faces side by side.
 * @param {Uint32Array} faces
 */
function strips(faces) {
  /** @type {number[][]} */
  const found = [];
  for (let face = 0; face < faces.length; face += 4) {
    const [a = 0, b = 0, c = 0, d = 0] = faces.subarray(face, face + 4);
    const last = found.at(-1);
    if (last && last[1] === a && last[2] === d) [last[1], last[2]] = [b, c];
    else found.push([a, b, c, d]);
  }
  return found;
}

/**
 * Fills a face, and the hair between it and its neighbours.
 * @param {CanvasRenderingContext2D} context
 * @param {Float32Array} seen
 * @param {Uint32Array | number[]} corners
 * @param {string} colour
 */
function fill(context, seen, corners, colour) {
  context.fillStyle = context.strokeStyle = colour;
  context.beginPath();
  corners.forEach((taxel, at) => {
    const [x, y] = [seen[3 * taxel] ?? 0, seen[3 * taxel + 1] ?? 0];
    if (at === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
  context.closePath();
  context.fill();
  context.stroke();
}
