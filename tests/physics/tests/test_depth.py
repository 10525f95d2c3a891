"""Depth inside geoms, judged by MuJoCo's own distances."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from taxel_physics.depth import depth
from taxel_physics.robot import OBJECTS, Robot, World, bent, reference

DOT_M = 1e-5
"""Radius of the sphere that stands for a point."""


def dotted(world: World) -> World:
    """The world with a small sphere that touches nothing."""
    spec = mujoco.MjSpec.from_string(world.xml)
    body = spec.worldbody.add_body(name="dot", mocap=True)
    body.add_geom(name="dot", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[DOT_M, 0, 0], contype=0, conaffinity=0)
    world.model = spec.compile()
    world.data = mujoco.MjData(world.model)
    world.reset()
    return world


@pytest.mark.parametrize("name", [*OBJECTS, "torso", "left_upper_arm", "left_forearm"])
@pytest.mark.parametrize("robot", [reference(), bent()], ids=["reference", "bent"])
def test_depths_are_mujocos_distances(name: str, robot: Robot) -> None:
    world = dotted(World(robot))
    geom = int(world.model.body_geomadr[world.model.body(name).id])
    rng = np.random.default_rng(3)
    size = world.model.geom_rbound[geom]
    center = np.array(world.data.geom_xpos[geom])
    points = center + rng.uniform(-1.2, 1.2, (300, 3)) * [0.05, 0.05, size]
    deep = depth(world, geom, points)
    is_mesh = world.model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH
    compared = 0
    for point, found in zip(points, deep, strict=True):
        world.data.mocap_pos[0] = point
        mujoco.mj_kinematics(world.model, world.data)
        away = mujoco.mj_geomDistance(world.model, world.data, world.model.geom("dot").id, geom, 1.0, None)
        # Outside a mesh, the nearest plane may be nearer than the mesh.
        if is_mesh and found < 0.0:
            assert -found <= away + DOT_M + 1e-5
        else:
            assert abs(-found - (away + DOT_M)) < 2e-5, point
            compared += 1
    assert compared > 20


def test_a_geom_without_a_formula_is_refused() -> None:
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><geom type="ellipsoid" size="1 2 3"/></worldbody></mujoco>'
    )
    world = World(reference())
    world.model, world.data = model, mujoco.MjData(model)
    with pytest.raises(ValueError, match="mjGEOM_ELLIPSOID"):
        depth(world, 0, np.zeros((1, 3)))
