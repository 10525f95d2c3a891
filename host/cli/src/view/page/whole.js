// The garments of a robot's boards as one garment on one body, for the picture of the whole robot.

/**
 * @typedef {import("./types.d.ts").Panel} Panel
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {import("./types.d.ts").BodyState} BodyState
 * @typedef {import("./types.d.ts").PoseOfLink} PoseOfLink
 * @typedef {import("./types.d.ts").Pushed} Pushed
 * @typedef {object} Part a board
 * @property {string} name
 * @property {Panel[]} panels
 * @property {BodyState | null} body null if it is not known where the panels lie
 * @property {Record<string, PoseOfLink> | null} poses of the links
 * @property {ArrayLike<number> | null} image counts; null if it is not known what presses now
 * @property {Pushed | null} pressing
 * @property {number[]} folding taxels
 * @property {{ pressure: number, force: number }} scale counts of the picture for one of this board
 * @typedef {object} Joined
 * @property {BodyState} body
 * @property {Panel[]} panels
 * @property {number[]} bases number of the first taxel of each part
 * @typedef {object} WholeScene
 * @property {BodyState} body
 * @property {Record<string, PoseOfLink> | null} poses
 * @property {Panel[]} panels
 * @property {Float32Array} image
 * @property {Uint8Array} unknown 1 on taxels of which it is not known what presses
 * @property {Pushed} pressing
 * @property {number[]} folding
 */

/** Joins the boards: what changes with each image is joined anew, places only if they are others. */
export class Whole {
  constructor() {
    /** @type {(BodyState | Panel[] | null)[]} what was joined last */
    this.of = [];
    /** @type {Joined} */
    this.joined = joined([]);
  }

  /**
   * @param {Part[]} parts
   * @returns {WholeScene}
   */
  scene(parts) {
    const of = parts.flatMap(({ body, panels }) => [body, panels]);
    if (of.length !== this.of.length || of.some((one, at) => one !== this.of[at])) {
      [this.of, this.joined] = [of, joined(parts)];
    }
    const { body, panels, bases } = this.joined;
    const image = new Float32Array(body.taxels.length);
    const unknown = new Uint8Array(image.length).fill(1);
    parts.forEach(({ image: own, scale }, part) => {
      const base = bases[part] ?? 0;
      for (let taxel = 0; own && taxel < own.length; taxel += 1) image[base + taxel] = (own[taxel] ?? 0) * scale.pressure;
      if (own) unknown.fill(0, base, base + own.length);
    });
    return {
      body,
      poses: parts.find(({ poses }) => poses)?.poses ?? null,
      panels,
      image,
      unknown,
      pressing: pushed(parts),
      folding: parts.flatMap(({ folding }, part) => folding.map((taxel) => (bases[part] ?? 0) + taxel)),
    };
  }
}

/**
 * @param {Part[]} parts
 * @returns {Joined}
 */
function joined(parts) {
  /** @type {Joined} */
  const whole = { body: { type: "body", name: "robot", links: [], taxels: [] }, panels: [], bases: [] };
  const { links, taxels } = whole.body;
  /** @type {Map<string, number>} */
  const numbers = new Map();
  for (const { name, panels, body } of parts) {
    const base = taxels.length;
    whole.bases.push(base);
    for (const panel of panels) {
      const placed = { ...panel, name: `${name}: ${panel.name}`, index: whole.panels.length, base: base + panel.base };
      whole.panels.push(placed);
    }
    // A parent is before its children: it has its number already.
    for (const link of body?.links ?? []) {
      if (numbers.has(link.name)) continue;
      const parent = link.parent === null ? undefined : body?.links[link.parent]?.name;
      numbers.set(link.name, links.length);
      links.push({ name: link.name, parent: parent === undefined ? null : (numbers.get(parent) ?? null) });
    }
    const count = panels.reduce((sum, { rows, columns }) => sum + rows * columns, 0);
    for (let taxel = 0; taxel < count; taxel += 1) {
      const place = body?.taxels[taxel] ?? null;
      const link = place && numbers.get(body?.links[place[0]]?.name ?? "");
      taxels.push(place && typeof link === "number" ? [link, place[1], place[2]] : null);
    }
  }
  return whole;
}

/**
 * Contacts and forces on all boards: the contacts with their boards, and the force on each link.
 * @param {Part[]} parts
 * @returns {Pushed}
 */
function pushed(parts) {
  /** @type {Map<string, number>} */
  const links = new Map();
  const contacts = parts.flatMap(({ name, pressing, scale }) => {
    for (const { link, pressed_counts: pressed } of pressing?.links ?? []) {
      links.set(link, (links.get(link) ?? 0) + pressed * scale.force);
    }
    return (pressing?.contacts ?? []).map(({ id, link, at_m, normal, force_counts: force }) => {
      const [x, y, z] = force;
      const scaled = /** @type {Triple} */ ([x * scale.force, y * scale.force, z * scale.force]);
      return { id, board: name, link, at_m, normal, force_counts: scaled };
    });
  });
  return { contacts, links: [...links].map(([link, pressed_counts]) => ({ link, pressed_counts })) };
}
