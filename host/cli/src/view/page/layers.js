// Places of a map's concepts, causes before their effects: from left to right or, where that would be small, from top
// to bottom.

/** Width and height of a concept. */
export const [WIDTH, HEIGHT] = [98, 38];
/** Free space around the picture. */
export const MARGIN = 12;
/** By how much downwards must be larger to be chosen: maps are drawn rightwards elsewhere. */
const TALL = 1.4;
/**
 * A reading direction: distances of concepts along and across it, the size of a concept likewise, and the share of a
 * distance by which every other layer is shifted, so that few edges cross a concept.
 * @typedef {{ along: number, across: number, size: [number, number], shift: number }} Way
 */
/** @type {Way} */
const RIGHT = { along: 126, across: 50, size: [WIDTH, HEIGHT], shift: 0.4 };
/** @type {Way} */
const DOWN = { along: 58, across: 106, size: [HEIGHT, WIDTH], shift: 0.2 };

/**
 * Upper left corners of concepts, and the size of the picture without its margin.
 * @param {number[]} layers the layer of each concept; 0 has no cause
 * @param {[number, number]} room width and height
 * @returns {{ isDown: boolean, places: [number, number][], extent: [number, number] }}
 */
export function arrange(layers, [width, height]) {
  const [right, down] = [best(layers, [width, height], RIGHT), best(layers, [height, width], DOWN)];
  if (down.scale <= TALL * right.scale) return { isDown: false, ...right };
  const turned = (/** @type {[number, number]} */ [along, across]) => /** @type {[number, number]} */ ([across, along]);
  return { isDown: true, places: down.places.map(turned), extent: turned(down.extent) };
}

/**
 * The arrangement with as many lines of inputs, of which there are many, as make the picture large.
 * @param {number[]} layers
 * @param {[number, number]} room along and across
 * @param {Way} way
 */
function best(layers, room, way) {
  const inputs = layers.filter((layer) => layer === 0).length;
  const all = Array.from({ length: Math.max(1, inputs) }, (_, at) => inLines(layers, at + 1, room, way));
  return all.reduce((best, one) => (one.scale > best.scale ? one : best));
}

/**
 * @param {number[]} layers
 * @param {number} first lines of the inputs
 * @param {[number, number]} room along and across
 * @param {Way} way
 */
function inLines(layers, first, room, { along, across, size, shift }) {
  const count = (/** @type {number} */ layer) => layers.filter((other) => other === layer).length;
  const deep = Math.ceil(count(0) / first);
  const length = (/** @type {number} */ layer) => (layer === 0 ? deep : count(layer));
  const longest = Math.max(...layers.map(length));
  const places = layers.map((layer, at) => {
    const before = layers.slice(0, at).filter((other) => other === layer).length;
    const line = layer === 0 ? Math.floor(before / deep) : layer - 1 + first;
    const place = (layer === 0 ? before % deep : before) + (longest - length(layer)) / 2;
    const shifted = (line % 2) * (layer === 0 ? shift : 2 * shift);
    return /** @type {[number, number]} */ ([line * along, (place + shifted) * across]);
  });
  const end = (/** @type {0 | 1} */ axis) => Math.max(...places.map((place) => place[axis])) + size[axis];
  const extent = /** @type {[number, number]} */ ([end(0), end(1)]);
  const scale = Math.min(...extent.map((part, axis) => (room[axis] ?? 1) / (part + 2 * MARGIN)));
  return { places, extent, scale };
}
