"""The robot of a world as others describe robots: a URDF of its links and joints, without shapes."""

from __future__ import annotations

import mujoco
import numpy as np
import numpy.typing as npt

from .robot import World

Array = npt.NDArray[np.float64]


def described(world: World) -> str:
    """URDF of the robot, for ``taxel``: the same names, frames and angles as in the world.

    A body with several hinges becomes a chain of links, of which the last has its name.
    """
    model = world.model
    parts = ['<robot name="physics">', '<link name="world"/>']
    hinges = {model.joint(name).id for name in world.robot.joints}
    for body in range(1, model.nbody):
        first = int(model.body_jntadr[body])
        joints = range(first, first + int(model.body_jntnum[body]))
        if not set(joints) & hinges:
            continue
        name = model.body(body).name
        parent = model.body(int(model.body_parentid[body])).name
        at, turned = model.body_pos[body], np.zeros(9)
        mujoco.mju_quat2Mat(turned, model.body_quat[body])
        rotation = turned.reshape(3, 3)
        for joint in joints:
            beside = model.jnt_pos[joint]
            is_last = joint == joints[-1] and not np.any(beside)
            child = name if is_last else f"{name}_{model.joint(joint).name}"
            low, high = model.jnt_range[joint]
            origin = f'xyz="{_numbers(at + rotation @ beside)}" rpy="{_numbers(_rpy(rotation))}"'
            parts += [
                f'<link name="{child}"/>',
                f'<joint name="{model.joint(joint).name}" type="revolute"><parent link="{parent}"/>'
                f'<child link="{child}"/><origin {origin}/><axis xyz="{_numbers(model.jnt_axis[joint])}"/>'
                f'<limit lower="{low - 0.5}" upper="{high + 0.5}" effort="100" velocity="10"/></joint>',
            ]
            parent, at, rotation = child, -beside, np.eye(3)
        if parent != name:
            # The last hinge lies beside the origin of its frame.
            parts += [
                f'<link name="{name}"/>',
                f'<joint name="{name}_frame" type="fixed"><parent link="{parent}"/><child link="{name}"/>'
                f'<origin xyz="{_numbers(at)}" rpy="0 0 0"/></joint>',
            ]
    return "\n".join([*parts, "</robot>"])


def _numbers(vector: Array) -> str:
    return " ".join(f"{number:.9g}" for number in vector)


def _rpy(matrix: Array) -> Array:
    """Angles about the fixed axes x, y, z, in this order, of a rotation (3, 3), rad."""
    return np.array(
        [
            np.arctan2(matrix[2, 1], matrix[2, 2]),
            np.arcsin(np.clip(-matrix[2, 0], -1.0, 1.0)),
            np.arctan2(matrix[1, 0], matrix[0, 0]),
        ]
    )
