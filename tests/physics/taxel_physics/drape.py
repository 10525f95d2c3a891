"""A panel draped over a link of any shape: the points of a body file's ``on.grid``, found by rays.

The rays go inwards to an axis of the link, as a tape measure around an arm would find its surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

FAR_M = 1.0
"""Where rays begin, from the axis."""


@dataclass(frozen=True)
class Around:
    """Where a panel lies on a link: around an axis, within two angles; vectors in the link's frame."""

    link: str
    start: Array
    """(3,) Point of the axis beside the panel's first row, m."""
    end: Array
    """(3,) Point of the axis beside its last row, m."""
    facing: Array
    """(3,) Direction from the axis to the panel's middle."""
    half_angle: float
    """Angle from its middle to its outermost columns, rad."""


def grid(model: mujoco.MjModel, around: Around, rows: int, columns: int) -> Array:
    """(rows, columns, 3) Points of a link's geoms, evenly spaced in height and angle, in its frame, m.

    Raises ``ValueError`` where the link has no surface.
    """
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    body = model.body(around.link).id
    down = (around.end - around.start) / np.linalg.norm(around.end - around.start)
    out = around.facing - down * (around.facing @ down)
    out /= np.linalg.norm(out)
    # Seen from outside, columns run to the right when rows run down.
    right = np.cross(out, down)
    points = np.zeros((rows, columns, 3))
    for row, height in enumerate(np.linspace(0.0, 1.0, rows)):
        center = around.start + (around.end - around.start) * height
        for column, angle in enumerate(np.linspace(-around.half_angle, around.half_angle, columns)):
            ray = -(out * np.cos(angle) + right * np.sin(angle))
            way = hit(model, data, body, center - FAR_M * ray, ray)
            if way is None:
                raise ValueError(f"no surface of {around.link} in row {row}, column {column}")
            points[row, column] = center + (way - FAR_M) * ray
    return points


def hit(model: mujoco.MjModel, data: mujoco.MjData, body: int, start: Array, ray: Array) -> float | None:
    """Way of a ray (m) to the nearest geom of one body, in the body's frame; None if it misses it."""
    turned = np.array(data.xmat[body]).reshape(3, 3)
    origin = np.array(data.xpos[body])
    ways = []
    for geom in range(model.body_geomadr[body], model.body_geomadr[body] + model.body_geomnum[body]):
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
            way = mujoco.mj_rayMesh(model, data, geom, origin + turned @ start, turned @ ray)
        else:
            way = mujoco.mju_rayGeom(
                data.geom_xpos[geom],
                data.geom_xmat[geom],
                model.geom_size[geom],
                origin + turned @ start,
                turned @ ray,
                model.geom_type[geom],
            )
        if way >= 0.0:
            ways.append(float(way))
    return min(ways, default=None)


def body_file(panel: str, link: str, points: Array) -> str:
    """A body file of one panel that lies through these points (rows, columns, 3)."""
    rows = ",\n  ".join(
        "[" + ", ".join("[" + ", ".join(f"{x:.6f}" for x in point) + "]" for point in row) + "]"
        for row in points
    )
    return f'[[patches]]\npanel = "{panel}"\nlink = "{link}"\non.grid.points = [\n  {rows},\n]\n'
