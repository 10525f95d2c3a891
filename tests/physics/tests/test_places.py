"""Where ``taxel`` places the taxels, judged by rays against MuJoCo's geoms."""

from __future__ import annotations

import mujoco
import numpy as np
from conftest import Dressed, table

from taxel_physics.places import Array

OUTSIDE_M = 0.02


def from_rays(dressed: Dressed, shift: Array) -> tuple[Array, Array]:
    """Distance (m) of each taxel, moved by ``shift`` (3,), from its link's geom along its normal, and the
    angle (rad) between its normal and the geom's."""
    world = dressed.world
    world.reset()
    # Arms away from the torso: rays would meet them.
    world.bend({joint: 1.0 for joint in world.robot.joints if "roll" in joint})
    gaps, angles = [], []
    for link in dressed.places.links:
        origin, turned = world.link_pose(link)
        for taxel in dressed.places.on(link):
            out = turned @ dressed.places.normal[taxel]
            start = origin + turned @ (dressed.places.at[taxel] + shift) + OUTSIDE_M * out
            geom, normal = np.zeros(1, np.int32), np.zeros(3)
            way = mujoco.mj_ray(world.model, world.data, start, -out, None, True, -1, geom, normal)
            assert world.model.geom(int(geom[0])).name == link
            gaps.append(abs(way - OUTSIDE_M))
            angles.append(np.arccos(np.clip(normal @ out, -1.0, 1.0)))
    return np.array(gaps), np.array(angles)


def test_taxels_lie_on_the_links(dressed: Dressed) -> None:
    gaps, angles = from_rays(dressed, np.zeros(3))
    assert len(gaps) == 2048
    columns = {"taxel from surface, um": gaps * 1e6, "normal, degrees": np.degrees(angles)}
    bars = {"taxel from surface, um": 5.0, "normal, degrees": 0.1}
    table(f"Places of 2048 taxels, body {dressed.name}", columns, bars)
    assert gaps.max() < 5e-6
    # Half of the angle between two sides of a frustum's mesh is 0.05 degrees.
    assert np.degrees(angles).max() < 0.1


def test_a_millimetre_is_seen(dressed: Dressed) -> None:
    gaps, _ = from_rays(dressed, np.array([1e-3, 0.0, 0.0]))
    assert gaps.max() > 0.9e-3
