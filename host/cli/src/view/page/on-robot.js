// The garment on the robot in three dimensions: cloth in the colours of the pressure, contacts, the forces that press,
// and the links. Without WebGL the canvas shows it from the front and from behind. `taxel report` shows the same.

import { home, sight, toward } from "./camera.js";
import { arrowOf, clothOf, facing, light, nothing, shade, sideBySide, stand, STRIDE } from "./cloth.js";
import { draw, make, say } from "./dom.js";
import { Drawing } from "./drawing.js";
import { NONE, withFigure } from "./figure.js";
import { under } from "./mesh.js";
import { Orbit } from "./orbit.js";
import { GlPainter } from "./relief-gl.js";
import { apart, arrow, below, grown, marker, middle, pixel, set, text } from "./robot-marks.js";

/**
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {import("./types.d.ts").BodyState} BodyState
 * @typedef {import("./types.d.ts").PoseOfLink} PoseOfLink
 * @typedef {import("./types.d.ts").Pushed} Pushed
 * @typedef {import("./camera.js").Camera} Camera
 * @typedef {import("./camera.js").Sight} Sight
 * @typedef {object} BodyScene
 * @property {BodyState} body
 * @property {import("./messages.d.ts").FigureLine | null} figure what the robot looks like
 * @property {Record<string, PoseOfLink> | null} poses of the links; null without a robot
 * @property {import("./types.d.ts").Panel[]} panels
 * @property {ArrayLike<number>} image counts
 * @property {Uint8Array | null} unknown 1 on taxels of which it is not known what presses
 * @property {number} top end of the colours, counts
 * @property {Pushed | null} pressing
 * @property {number[]} folding taxels on which the garment folds
 * @property {(counts: number) => string} force in words
 * @property {number | null} chosen a taxel that is marked
 * @typedef {object} Aspect a side from which the robot is seen
 * @property {Camera} camera
 * @property {string} name
 * @property {number} left pixels
 * @property {number} width pixels
 * @property {Sight} sight
 * @property {Float32Array} seen x, y and nearness of each corner of the cloth
 * @property {Triple} viewer direction
 * @property {Uint32Array} order faces to be drawn by the canvas
 */

/** From the front, a little from the robot's left, and from afar: near and far links are to be compared. */
const FRONT = { turn: 0.45, tilt: 0.12, distance: 12 };
/** The robot is seen from below, too. */
const LOWEST = -1.4;
/** Margins for the texts, pixels. */
const MARGINS = /** @type {[number, number]} */ ([30, 22]);
/** Sum of the pressure that an arrow of 10 cm stands for, ends of the colours. */
const PER_ARROW = 40;
/** Half of the width of a stroke over a taxel that folds, pixels. */
const STROKE = 2.5;
/** Shortest time between two texts in a place, ms: nobody reads faster. */
const SAID_MS = 100;
const TURNS = "Arrow keys turn and tilt it, Page Up and Page Down move nearer and farther, Home resets.";

/** The robot in an element. */
export class OnRobot {
  /**
   * @param {HTMLElement} root
   * @param {import("./relief.js").Watch} watch
   */
  constructor(root, watch) {
    this.watch = watch;
    this.stage = make("div", { class: "relief" });
    this.back = draw("svg", { "aria-hidden": "true" });
    this.bones = draw("path", { fill: "none", stroke: "var(--quiet)", "stroke-width": 1.5, "stroke-linecap": "round" });
    this.back.append(this.bones);
    this.stage.append(this.back);
    this.drawing = new Drawing(this.stage, () => {
      this.body = null;
      this.become();
      watch.changed();
    });
    this.front = draw("svg", { "aria-hidden": "true" });
    this.folds = ["halo", "mark"].map((ink, at) =>
      draw("path", { fill: "none", stroke: `var(--${ink})`, "stroke-width": 3 - 2 * at, "stroke-linecap": "round" }),
    );
    const halo = { stroke: "var(--card, var(--paper))", "stroke-width": 3, "paint-order": "stroke" };
    this.names = draw("g", { "font-size": 12, "text-anchor": "middle", fill: "var(--ink)", ...halo });
    this.forces = draw("g", { "font-size": 13, "font-weight": 650, "text-anchor": "middle" });
    this.ring = draw("circle", { r: 7, fill: "none", stroke: "var(--mark)", "stroke-width": 1.5, display: "none" });
    this.front.append(...this.folds, this.names, this.forces, this.ring);
    this.note = make("p", { class: "note quiet" });
    this.stage.append(this.front, this.note);
    root.replaceChildren(this.stage);
    this.orbit = new Orbit(
      this.stage,
      { changed: () => this.turns && watch.changed(), point: (at, x, y) => watch.point(this.taxelAt(at), x, y) },
      FRONT,
      LOWEST,
    );
    /** @type {BodyState | null} */
    this.body = null;
    /** @type {BodyScene["figure"]} */
    this.figure = null;
    /** @type {Record<string, PoseOfLink> | null} */
    this.poses = null;
    this.data = new Float32Array(0);
    /** @type {Aspect[]} */
    this.aspects = [];
    this.looked = "";
    /** Time at which the texts were written. */
    this.said = 0;
    /** @type {ReturnType<typeof setTimeout> | undefined} they wait for that */
    this.late = undefined;
    /** @type {string[]} */
    this.named = [];
    /** Pictures drawn so far. */
    this.pictures = 0;
    this.become();
  }

  /** Painter of the cloth. */
  get painter() {
    return this.drawing.painter;
  }

  /** True if the robot can be turned. */
  get turns() {
    return this.painter instanceof GlPainter;
  }

  /** A picture that turns is a control, one that does not is a picture. */
  become() {
    const attributes = this.turns
      ? { role: "application", tabindex: "0", "aria-label": `The garment on the robot. ${TURNS}` }
      : { role: "img", "aria-label": "The garment on the robot, from the front and from behind" };
    for (const name of ["role", "tabindex", "aria-label"]) this.stage.removeAttribute(name);
    for (const [name, value] of Object.entries(attributes)) this.stage.setAttribute(name, value);
  }

  /**
   * Draws a scene; false if there is no room.
   * @param {BodyScene} scene
   */
  draw(scene) {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (!width || !height) return false;
    this.build(scene);
    this.look(width, height);
    const { cloth, data, painter } = this;
    if (!cloth) return false;
    shade(data, cloth, scene.image, scene.top, scene.unknown);
    const { ratio, size } = this.drawing.sharpness();
    const [first] = this.aspects;
    if (painter instanceof GlPainter) first && painter.draw(first.sight, { data }, size);
    else {
      painter.begin(size, ratio);
      for (const { seen, order, viewer } of this.aspects) {
        light(data, this.standing?.normals ?? data, viewer);
        painter.fill(order, seen, data);
      }
    }
    this.mark(scene);
    this.pictures += 1;
    return true;
  }

  /**
   * Takes another body or posture.
   * @param {BodyScene} scene
   */
  build({ body, figure, poses, panels }) {
    const { painter } = this;
    const isOther = body !== this.body || figure !== this.figure;
    if (!isOther && poses === this.poses) return;
    if (isOther) {
      const links = (/** @type {BodyState | null} */ of) => JSON.stringify(of?.links);
      // Cloth that has slid does not move the camera.
      if (!this.bounds || links(body) !== links(this.body)) this.bounds = nothing();
      this.cloth = withFigure(clothOf(body, panels), body, figure);
      this.data = new Float32Array(STRIDE * this.cloth.taxels.length);
    }
    const { cloth, bounds } = this;
    if (!cloth || !bounds) return;
    [this.body, this.figure, this.poses] = [body, figure, poses];
    this.posed = poses ?? sideBySide(body);
    this.standing = stand(cloth, body, this.posed, bounds);
    if (!(painter instanceof GlPainter)) painter.build(cloth);
    else if (isOther) painter.build({ places: this.standing.places, faces: cloth.faces }, 3);
    else painter.move(this.standing.places, 3);
    this.looked = "";
  }

  /**
   * Looks at the robot: where everything is in the picture. It changes less often than the pressure.
   * @param {number} width
   * @param {number} height
   */
  look(width, height) {
    const { standing, cloth, orbit } = this;
    const key = `${width} ${height} ${JSON.stringify(orbit.camera)}`;
    if (!standing || !cloth || key === this.looked) return;
    this.looked = key;
    for (const svg of [this.back, this.front])
      for (const [name, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` }))
        svg.setAttribute(name, String(value));
    const half = width / 2;
    const sides = this.turns
      ? [{ camera: orbit.camera, name: "", left: 0, width }]
      : [
          { camera: { ...home(), ...FRONT, turn: 0, tilt: 0 }, name: "front", left: 0, width: half },
          { camera: { ...home(), ...FRONT, turn: Math.PI, tilt: 0 }, name: "back", left: half, width: half },
        ];
    this.aspects = sides.map((side) => {
      const view = sight(side.camera, standing.box, [side.width, height], MARGINS);
      const seen = new Float32Array(standing.places.length);
      for (let at = 0; at < seen.length; at += 3) {
        const [x = 0, y = 0, z = 0] = standing.places.subarray(at, at + 3);
        const [right, down, near] = view.place(x, y, z);
        seen.set([right + side.left, down, near], at);
      }
      const viewer = toward(side.camera);
      const order = this.turns ? new Uint32Array(0) : facing(seen, cloth.faces, standing.normals, viewer);
      return { ...side, sight: view, seen, viewer, order };
    });
    const [first] = this.aspects;
    if (first && this.turns) light(this.data, standing.normals, first.viewer);
    this.placeNames();
    this.said = 0;
    this.bones.setAttribute("d", this.poses ? this.aspects.map((aspect) => this.skeleton(aspect)).join("") : "");
  }

  /**
   * Lines from each link's origin to that of the link that it hangs on.
   * @param {Aspect} aspect
   */
  skeleton(aspect) {
    const { body, standing } = this;
    if (!body || !standing) return "";
    const lines = body.links.map(({ parent }, at) => {
      const [from, to] = [parent === null ? null : standing.origins[parent], standing.origins[at]];
      if (!from || !to) return "";
      const ends = [from, to].map((end) => text(pixel(aspect, end)));
      return `M${ends.join("L")}`;
    });
    return lines.join("");
  }

  /**
   * The taxel at a point of the picture; null if there is none.
   * @param {[number, number] | null} at
   */
  taxelAt(at) {
    const { cloth, aspects } = this;
    const aspect = at && aspects.find(({ left, width }) => at[0] >= left && at[0] < left + width);
    const corner = cloth && aspect ? under(aspect.seen, cloth.faces, ...at) : null;
    const taxel = corner === null ? NONE : (cloth?.taxels[corner] ?? NONE);
    return taxel === NONE ? null : taxel;
  }

  /**
   * A stroke over each taxel on which the garment folds, where its outside is seen.
   * @param {Aspect} aspect
   * @param {number[]} folding
   */
  strokes({ seen, viewer }, folding) {
    const { cloth, standing } = this;
    if (!cloth || !standing || !folding.length) return "";
    const folded = new Set(folding);
    let strokes = "";
    cloth.taxels.forEach((taxel, corner) => {
      // A taxel that stands alone has four corners: one stroke is enough.
      if (!folded.delete(taxel)) return;
      const facing = viewer.reduce((sum, part, axis) => sum + part * (standing.normals[3 * corner + axis] ?? 0), 0);
      const [x, y] = [seen[3 * corner] ?? 0, seen[3 * corner + 1] ?? 0];
      if (facing > 0) strokes += `M${(x - STROKE).toFixed(1)} ${(y + STROKE).toFixed(1)}l${2 * STROKE} ${-2 * STROKE}`;
    });
    return strokes;
  }

  /**
   * Names the links, and draws each contact with its force, and the chosen taxel.
   * @param {BodyScene} scene
   */
  mark(scene) {
    const { body, bounds, posed } = this;
    if (!body || !bounds || !posed) return;
    const contacts = scene.pressing?.contacts ?? [];
    const wait = this.said + SAID_MS - performance.now();
    const isDue = wait <= 0;
    clearTimeout(this.late);
    if (isDue) this.said = performance.now();
    else this.late = setTimeout(() => this.mark(scene), wait);
    const perMetre = 10 * PER_ARROW * scene.top;
    const arrows = this.aspects.flatMap((aspect) =>
      contacts.flatMap((touch) => {
        const pose = posed[touch.link];
        if (!pose) return [];
        const { tip, tail, normal } = arrowOf(pose, touch, perMetre, bounds);
        const isBehind = normal.reduce((sum, part, axis) => sum + part * (aspect.viewer[axis] ?? 0), 0) < 0;
        // One of two sides shows it.
        if (isBehind && !this.turns) return [];
        const name = touch.board ? `${touch.board} ${touch.id}` : String(touch.id);
        const words = `${name} · ${scene.force(Math.hypot(...touch.force_counts))}`;
        return [{ d: arrow(pixel(aspect, tail), pixel(aspect, tip)), at: pixel(aspect, tail), name, isBehind, words }];
      }),
    );
    const labels = arrows.map(({ at: [x, y], words: name }) => ({ name, at: /** @type {[number, number]} */ ([x, y - 7]) }));
    apart(labels, 0);
    grown(this.forces, arrows.length, marker).forEach((group, at) => {
      const [one, label] = [arrows[at], labels[at]];
      set(group, "display", one ? "inline" : "none");
      const [halo, line, words] = group.children;
      if (!one || !label || !halo || !line || !words) return;
      set(group, "opacity", one.isBehind ? "0.4" : "1");
      for (const path of [halo, line]) set(path, "d", one.d);
      set(words, "transform", `translate(${text(label.at)})`);
      if (isDue || !words.textContent?.startsWith(`${one.name} ·`)) say(words, one.words);
    });
    if (isDue) this.name(scene);
    this.choose(scene.chosen);
    const strokes = this.aspects.map((aspect) => this.strokes(aspect, scene.folding)).join("");
    for (const path of this.folds) set(path, "d", strokes);
    const note = [
      this.poses ? "" : "No robot is known: each link stands in its own frame.",
      this.cloth?.bare.length ? `No place on the robot: ${this.cloth.bare.join(", ")}.` : "",
      contacts.length ? `An arrow of 10 cm: ${scene.force(PER_ARROW * scene.top)}; none is longer than 20 cm.` : "",
    ];
    say(this.note, note.filter(Boolean).join(" "));
  }

  /**
   * Writes the links' names, each with the force that presses on it. Those of a figure's other links, which are known
   * at sight, would only lie over it.
   * @param {BodyScene} scene
   */
  name({ body, figure, pressing, force }) {
    grown(this.names, this.named.length, () => draw("text")).forEach((words, at) => {
      const name = this.named[at] ?? "";
      const pressed = pressing?.links.find(({ link }) => link === name)?.pressed_counts ?? 0;
      const isKnown = figure && body.links.some((link) => link.name === name);
      say(words, pressed > 0 ? `${name} ${force(pressed)}` : isKnown ? "" : name);
    });
  }

  /** Places the names of the sides, and of the links that carry cloth or end a limb. */
  placeNames() {
    const { cloth, standing, body } = this;
    if (!cloth || !standing || !body) return;
    const named = this.aspects.flatMap((aspect) => [
      ...(aspect.name ? [{ name: aspect.name, at: middle(aspect) }] : []),
      ...body.links.flatMap(({ name }, link) => {
        const at = below(aspect, cloth, link);
        const isEnd = !body.links.some(({ parent }) => parent === link);
        const origin = standing.origins[link];
        if (at) return [{ name, at }];
        return isEnd && origin ? [{ name, at: pixel(aspect, origin) }] : [];
      }),
    ]);
    apart(named);
    this.named = named.map(({ name }) => name);
    grown(this.names, named.length, () => draw("text")).forEach((words, at) => {
      const [x, y] = named[at]?.at ?? [0, 0];
      words.setAttribute("transform", `translate(${text([x, y])})`);
    });
  }

  /** @param {number | null} chosen */
  choose(chosen) {
    const corner = chosen === null ? -1 : (this.cloth?.taxels.indexOf(chosen) ?? -1);
    // Where it can be seen: on the side that it faces.
    const normal = this.standing?.normals.subarray(3 * corner, 3 * corner + 3) ?? [];
    const facingIt = (/** @type {Aspect} */ { viewer }) =>
      viewer.reduce((sum, part, axis) => sum + part * (normal[axis] ?? 0), 0);
    const aspect = this.aspects.find((one) => facingIt(one) > 0) ?? this.aspects[0];
    set(this.ring, "display", corner < 0 || !aspect ? "none" : "inline");
    if (corner < 0 || !aspect) return;
    const at = text([aspect.seen[3 * corner] ?? 0, aspect.seen[3 * corner + 1] ?? 0]);
    set(this.ring, "transform", `translate(${at})`);
  }
}
