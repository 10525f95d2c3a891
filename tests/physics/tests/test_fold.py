"""The arm folds back on itself: the solver presses the forearm on the upper arm, and both feel it."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from conftest import table

from taxel_physics.places import BODIES, Places, places
from taxel_physics.robot import World, bent
from taxel_physics.spread import spread
from taxel_physics.touch import Touch, touches

LINKS = ("left_upper_arm", "left_forearm")


@pytest.fixture(scope="module")
def garment() -> Places:
    return places(BODIES / "bent.toml")


def folded(world: World, target: float) -> list[Touch]:
    """Touches of the two links of an arm that wants to bend to ``target`` (rad)."""
    world.reset()
    world.bend({"left_shoulder_roll": 1.0, "left_elbow": 2.9})
    world.run(0.6, lambda time: {"left_elbow": 2.9 + (target - 2.9) * min(time / 0.4, 1.0)})
    return touches(world, LINKS)


def test_both_links_feel_the_fold(garment: Places) -> None:
    world = World(bent())
    force, center, solver = [], [], []
    for target in np.linspace(3.154, 3.168, 12):
        found = folded(world, float(target))
        if not found:
            continue
        assert [touch.link for touch in found] == list(LINKS)
        # What one link feels, the other feels in return.
        world_forces = [world.link_pose(touch.link)[1] @ touch.force for touch in found]
        assert np.allclose(world_forces[0], -world_forces[1], atol=1e-9)
        for touch in found:
            spreads = spread(world, garment, touch)
            force.append(spreads.force_error)
            center.append(spreads.center_error / 0.01)
            solver.append(touch.newtons)
    columns = {
        "force, share of the solver's": force,
        "centre of pressure, pitches": center,
        "solver's force, N": solver,
    }
    bars = {"force, share of the solver's": 1e-3, "centre of pressure, pitches": 0.1}
    table("Forearm on upper arm, both links, body bent", columns, bars)
    assert len(force) >= 10
    assert max(force) < 1e-3
    assert max(center) < 0.1


def test_mujoco_filters_the_fold_by_default() -> None:
    world = World(bent())
    model = mujoco.MjModel.from_xml_string(world.xml.replace('filterparent="disable"', ""))
    world.model, world.data = model, mujoco.MjData(model)
    assert folded(world, 3.25) == []
