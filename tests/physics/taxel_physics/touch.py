"""What touches a link, as MuJoCo's solver says it.

Only normal forces count: a garment that measures pressure does not feel friction, so friction is left out.
The points at which MuJoCo lets one object touch one link (up to four for flat ones) are one touch.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

from .robot import World

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Touch:
    """One geom that presses on one link; all vectors in the link's frame."""

    link: str
    by: str
    """Name of the body that presses."""
    geom: int
    """Number of the geom that presses."""
    force: Array
    """(3,) Sum of the normal forces on the link, N."""
    point: Array
    """(3,) Point of the contact, weighted by force, m. MuJoCo puts it halfway through the overlap."""
    moment: Array
    """(3,) Moment of the normal forces about ``point``, N m; 0 for one point of contact."""

    @property
    def newtons(self) -> float:
        """Magnitude of the force."""
        return float(np.linalg.norm(self.force))


def touches(world: World, links: Iterable[str]) -> list[Touch]:
    """Everything that presses on these links now, other links included; links in the order given."""
    found: dict[tuple[str, int], list[tuple[Array, Array]]] = {}
    for link in links:
        for geom, force, point in _points(world, link):
            found.setdefault((link, geom), []).append((force, point))
    return [_touch(world, link, geom, points) for (link, geom), points in found.items()]


def _points(world: World, link: str) -> list[tuple[int, Array, Array]]:
    """Geom that presses, force on the link (3,) and point (3,) of each point of contact, in the world."""
    model, data = world.model, world.data
    body = model.body(link).id
    points = []
    wrench = np.zeros(6)
    for index in range(data.ncon):
        contact = data.contact[index]
        geoms = (int(contact.geom1), int(contact.geom2))
        mine = [int(model.geom_bodyid[geom]) == body for geom in geoms]
        if not any(mine):
            continue
        mujoco.mj_contactForce(model, data, index, wrench)
        if wrench[0] <= 0.0:
            continue
        # The contact's x axis points from the first geom to the second, which is pushed along it.
        sign = -1.0 if mine[0] else 1.0
        normal = np.array(contact.frame[:3])
        points.append((geoms[1] if mine[0] else geoms[0], sign * wrench[0] * normal, np.array(contact.pos)))
    return points


def _touch(world: World, link: str, geom: int, points: list[tuple[Array, Array]]) -> Touch:
    origin, turned = world.link_pose(link)
    forces = np.array([force for force, _ in points]) @ turned
    at = (np.array([point for _, point in points]) - origin) @ turned
    size = np.linalg.norm(forces, axis=1)
    center = size @ at / size.sum()
    moment = np.cross(at - center, forces).sum(axis=0)
    by = world.model.body(int(world.model.geom_bodyid[geom])).name
    return Touch(link, by, geom, forces.sum(axis=0), center, moment)
