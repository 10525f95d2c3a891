"""Robots of other people: their kinematics by two programs, and panels draped over their meshes."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yourdfpy

from taxel_physics.drape import Around, body_file, grid, hit
from taxel_physics.places import Array, places
from taxel_physics.urdf import load

PACKAGES = next(
    Path(path) / "cmeel.prefix/share" for path in sys.path if (Path(path) / "cmeel.prefix").is_dir()
)
"""Where PyPI's ``example-robot-data`` puts its robots."""


@dataclass(frozen=True)
class Other:
    """A robot, and where a panel lies on it."""

    urdf: str
    around: Around


def around(link: str, start: list[float], end: list[float], half_angle: float) -> Around:
    return Around(link, np.array(start), np.array(end), np.array([1.0, 0.0, 0.0]), half_angle)


ROBOTS = {
    "G1": Other(
        "g1_description/urdf/g1_29dof_rev_1_0.urdf",
        around("torso_link", [0.0, 0.0, 0.25], [0.0, 0.0, 0.06], 1.2),
    ),
    "Panda": Other(
        "panda_description/urdf/panda.urdf",
        around("panda_link2", [0.0, -0.15, 0.0], [0.0, -0.05, 0.0], 1.5),
    ),
    "TALOS": Other(
        "talos_data/robots/talos_reduced.urdf",
        around("torso_2_link", [0.0, 0.0, 0.2], [0.0, 0.0, 0.05], 1.0),
    ),
    "UR5": Other(
        "ur_description/urdf/ur5_robot.urdf",
        around("forearm_link", [0.0, 0.0, 0.08], [0.0, 0.0, 0.3], 1.5),
    ),
}


@pytest.fixture(params=ROBOTS)
def other(request: pytest.FixtureRequest) -> Other:
    return ROBOTS[str(request.param)]


def file(other: Other) -> Path:
    return PACKAGES / "example-robot-data/robots" / other.urdf


def test_two_programs_agree_where_the_links_are(other: Other) -> None:
    model = load(file(other), PACKAGES)
    data = mujoco.MjData(model)
    second = yourdfpy.URDF.load(str(file(other)), load_meshes=False)
    links = {model.body(body).name for body in range(1, model.nbody)}
    assert links | {second.base_link} == set(second.link_map) | {second.base_link}
    rng = np.random.default_rng(7)
    for _ in range(20):
        angles = {}
        for joint in range(model.njnt):
            limits = model.jnt_range[joint] if model.jnt_limited[joint] else (-np.pi, np.pi)
            angles[model.joint(joint).name] = float(rng.uniform(*limits))
        for name, joint in second.joint_map.items():
            # MuJoCo lets a joint that mimics another move, and pulls it back with a force.
            if joint.mimic is not None and name in angles:
                angles[name] = joint.mimic.multiplier * angles[joint.mimic.joint] + joint.mimic.offset
        for name, angle in angles.items():
            data.joint(name).qpos[0] = angle
        mujoco.mj_kinematics(model, data)
        second.update_cfg({name: angles[name] for name in second.actuated_joint_names})
        for body in range(1, model.nbody):
            pose = second.get_transform(model.body(body).name, second.base_link)
            assert np.abs(pose[:3, 3] - data.xpos[body]).max() < 1e-9
            assert np.abs(pose[:3, :3] - data.xmat[body].reshape(3, 3)).max() < 1e-9


def from_mesh(model: mujoco.MjModel, link: str, at: Array, normal: Array) -> Array:
    """(n,) Distance of places (n, 3) from a link's surface along their normals (n, 3), m."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    body = model.body(link).id
    ways = [hit(model, data, body, place + 0.1 * out, -out) for place, out in zip(at, normal, strict=True)]
    return np.array([np.inf if way is None else abs(way - 0.1) for way in ways])


@pytest.mark.parametrize(("rows", "columns", "median_mm"), [(32, 16, 0.001), (17, 9, 0.5)])
def test_panels_lie_on_the_meshes(
    other: Other, rows: int, columns: int, median_mm: float, tmp_path: Path
) -> None:
    """With a point for each taxel they lie on the mesh; with fewer, nearly everywhere."""
    model = load(file(other), PACKAGES)
    points = grid(model, other.around, rows, columns)
    body = tmp_path / "draped.toml"
    body.write_text(body_file("chest", other.around.link, points), encoding="utf-8")
    draped = places(body)
    on = draped.on(other.around.link)
    away = from_mesh(model, other.around.link, draped.at[on], draped.normal[on]) * 1e3
    print(f"{other.around.link}, {rows} x {columns}: median {np.median(away):.4f}, worst {away.max():.3f} mm")
    assert len(on) == 512
    assert np.median(away) < median_mm
    outward = ((draped.at[on] - (other.around.start + other.around.end) / 2) * draped.normal[on]).sum(axis=1)
    assert (outward > 0.0).mean() > 0.95


def test_a_mesh_that_is_not_there_is_named(tmp_path: Path) -> None:
    lost = tmp_path / "lost.urdf"
    lost.write_text(
        '<robot name="r"><link name="a"><collision><geometry><mesh filename="package://x/y.stl"/></geometry>'
        "</collision></link></robot>"
    )
    with pytest.raises(ValueError, match=r"y\.stl"):
        load(lost, tmp_path)
