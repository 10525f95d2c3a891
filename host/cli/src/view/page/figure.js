// The robot behind its garment: triangles that belong to no taxel.

/**
 * @typedef {import("./types.d.ts").Triple} Triple
 * @typedef {import("./cloth.js").Cloth} Cloth
 */

/** Number of the taxel of a corner that has none. */
export const NONE = 0xffffffff;
/** Distance by which the robot is thinner than it is, m: cloth on its skin is drawn over it. */
const UNDER = 0.003;

/**
 * A cloth, and what the robot looks like: faces whose last two corners are one.
 * @param {Cloth} cloth
 * @param {import("./types.d.ts").BodyState} body
 * @param {import("./messages.d.ts").FigureLine | null} figure
 * @returns {Cloth}
 */
export function withFigure(cloth, body, figure) {
  const numbers = new Map(body.links.map(({ name }, link) => [name, link]));
  const parts = /** @type {Record<"links" | "own" | "normals" | "faces", number[]>} */ ({});
  for (const name of /** @type {const} */ (["links", "own", "normals", "faces"])) parts[name] = [...cloth[name]];
  for (const { name, points, triangles } of figure?.links ?? []) {
    const link = numbers.get(name);
    if (link === undefined) continue;
    const first = parts.links.length;
    const normals = normalsOf(points, triangles);
    points.forEach((point, at) => {
      const normal = normals[at] ?? [0, 0, 0];
      parts.links.push(link);
      parts.normals.push(...normal);
      parts.own.push(...point.map((part, axis) => part - UNDER * (normal[axis] ?? 0)));
    });
    for (const [a, b, c] of triangles) parts.faces.push(first + a, first + b, first + c, first + c);
  }
  const taxels = new Uint32Array(parts.links.length).fill(NONE);
  taxels.set(cloth.taxels);
  return {
    ...cloth,
    taxels,
    links: Uint16Array.from(parts.links),
    own: Float32Array.from(parts.own),
    normals: Float32Array.from(parts.normals),
    faces: Uint32Array.from(parts.faces),
  };
}

/**
 * The direction of each corner: the mean of its triangles', by their areas.
 * @param {Triple[]} points
 * @param {Triple[]} triangles
 * @returns {Triple[]}
 */
function normalsOf(points, triangles) {
  const sums = points.map(() => /** @type {Triple} */ ([0, 0, 0]));
  for (const corners of triangles) {
    const [a = [0, 0, 0], b = a, c = a] = corners.map((corner) => points[corner]);
    const [u, v] = [b, c].map((end) => /** @type {Triple} */ (end.map((part, axis) => part - (a[axis] ?? 0))));
    if (!u || !v) continue;
    const area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const sum of corners.map((corner) => sums[corner]))
      for (const axis of /** @type {const} */ ([0, 1, 2])) if (sum) sum[axis] += area[axis] ?? 0;
  }
  return sums.map((sum) => {
    const length = Math.hypot(...sum) || 1;
    return [sum[0] / length, sum[1] / length, sum[2] / length];
  });
}
