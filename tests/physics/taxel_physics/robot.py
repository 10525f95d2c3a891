"""A robot of a child's size in MuJoCo, and the things that touch it.

The links are drawn here from primitives and from a closed frustum, by the radii of a body file and by nothing
that ``taxel`` computes, so that MuJoCo can judge where ``taxel`` places the taxels. A link's surface is the
layer of its taxels. Frames are those of a URDF: x forward, y to the left, z up.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, pi, radians, sin, tan

import mujoco
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

STEP_S = 0.001
"""Time step of the simulation."""

SIDES = 4096
"""Sides of a frustum's mesh: each turns by 0.09 degrees, which is what their normals err by."""

OBJECTS = {
    "ball": '<geom type="sphere" size="0.03" pos="0 0 -0.03"/>',
    "finger": '<geom type="capsule" size="0.008 0.03" pos="0 0 -0.038"/>',
    "rod": '<geom type="capsule" size="0.01 0.04" pos="0 0 -0.01" quat="0.70711 0 0.70711 0"/>',
    "box": '<geom type="box" size="0.02 0.015 0.01" pos="0 0 -0.01"/>',
    "palm": '<geom type="box" size="0.045 0.035 0.006" pos="0 0 -0.006"/>',
}
"""Things that touch, as MJCF geoms: z points at the robot, and the foremost point is the origin."""

SOFT = 'solref="0.008 1" solimp="0.3 0.9 0.004"'
"""Contacts as soft as a garment on a body: 40 N press the objects 2 to 4 mm in."""

Motion = Callable[[float], Mapping[str, float]]
"""Targets of joints (rad) at a time (s) since the motion began."""


@dataclass(frozen=True)
class Robot:
    """MJCF of a robot's links, without objects."""

    assets: str
    torso: str
    joints: tuple[str, ...]
    """Names of its hinges, each with a servo of the same name."""


def _frustum(name: str, low: tuple[float, float], high: tuple[float, float]) -> str:
    """A closed mesh around z from (z, radius) to (z, radius), m."""
    points = [
        f"{radius * cos(2 * pi * side / SIDES):.9f} {radius * sin(2 * pi * side / SIDES):.9f} {z:.9f}"
        for z, radius in (low, high)
        for side in range(SIDES)
    ]
    return f'<mesh name="{name}" vertex="{" ".join(points)}"/>'


def _cone_radius(z: float, middle: float, radius: float, angle_deg: float) -> float:
    """Radius of a cone that narrows downwards, and has ``radius`` at ``middle``."""
    return radius + (z - middle) * tan(radians(angle_deg))


def _hinge(name: str, axis: str, low: float, high: float) -> str:
    return f'<joint name="{name}" axis="{axis}" range="{low} {high}" damping="4" armature="0.05"/>'


def _torso(inner: str) -> str:
    return f"""
    <body name="torso" pos="0 0 0.5">{_hinge("waist", "0 0 1", -1, 1)}
      <geom name="torso" type="cylinder" size="0.06112 0.2" pos="0 0 0.2" mass="4" class="link"/>
      {inner}
    </body>"""


def reference() -> Robot:
    """Torso and two arms, for the body ``reference``. The forearms carry nothing."""
    top, bottom = 0.01, -0.335
    ends = [(z, _cone_radius(z, -0.16, 0.04, 1.5)) for z in (bottom, top)]

    def arm(side: str, y: float) -> str:
        return f"""
      <body name="{side}_upper_arm" pos="0 {y} 0.34">
        {_hinge(f"{side}_shoulder_roll", f"{1 if y > 0 else -1} 0 0", 0, 1.6)}
        {_hinge(f"{side}_shoulder_pitch", "0 -1 0", -1, 2.5)}
        <geom name="{side}_upper_arm" type="mesh" mesh="upper_arm" mass="0.5" class="link"/>
        <body name="{side}_forearm" pos="0 0 -0.36">
          {_hinge(f"{side}_elbow", "0 -1 0", 0, 2.4)}
          <geom name="{side}_forearm" type="capsule" size="0.03" fromto="0 0 -0.06 0 0 -0.28" mass="0.3"
            class="link"/>
        </body>
      </body>"""

    joints = [f"{side}_{joint}" for side in ("left", "right") for joint in _ARM]
    inner = arm("left", 0.14) + arm("right", -0.14)
    return Robot(_frustum("upper_arm", ends[0], ends[1]), _torso(inner), ("waist", *joints))


def bent() -> Robot:
    """Torso and a left arm that carries both sleeves, for the body ``bent.toml``.

    The elbow's hinge lies at its inner side, and the forearm crosses the upper arm when it is folded back:
    smooth surfaces meet there, not the ends of the links, where no taxels are.
    """
    top, bottom = 0.01, -0.345
    ends = [(z, _cone_radius(z, -0.17, 0.04, 1.5)) for z in (bottom, top)]
    inner = f"""
      <body name="left_upper_arm" pos="0 0.16 0.34">
        {_hinge("left_shoulder_roll", "1 0 0", 0, 1.6)}
        {_hinge("left_shoulder_pitch", "0 -1 0", -1, 2.5)}
        <geom name="left_upper_arm" type="mesh" mesh="upper_arm" mass="0.5" class="link"/>
        <body name="left_forearm" pos="0 -0.033 -0.36" euler="{radians(12):.9f} 0 0">
          <joint name="left_elbow" axis="0 {-cos(radians(12)):.9f} {sin(radians(12)):.9f}" pos="0.038 0 0"
            range="0 3.3" damping="4" armature="0.05"/>
          <geom name="left_forearm" type="cylinder" size="0.036" fromto="0 0 -0.03 0 0 -0.4" mass="0.3"
            class="link"/>
        </body>
      </body>"""
    joints = [f"left_{joint}" for joint in _ARM]
    return Robot(_frustum("upper_arm", ends[0], ends[1]), _torso(inner), ("waist", *joints))


_ARM = ("shoulder_roll", "shoulder_pitch", "elbow")


def mjcf(robot: Robot) -> str:
    """The whole model: the robot, and each of ``OBJECTS`` on a slide of its own, parked beside it."""
    objects = "".join(
        f'<body name="{name}" pos="3 {index} 0.5" gravcomp="1">'
        f'<joint name="{name}" type="slide" axis="0 0 1" damping="4"/>{geom}</body>'
        for index, (name, geom) in enumerate(OBJECTS.items())
    )
    servos = "".join(
        f'<position name="{joint}" joint="{joint}" kp="600" dampratio="1"/>' for joint in robot.joints
    )
    # By default MuJoCo leaves out contacts of a link with its parent, such as those in a bent elbow, and
    # gives a flat face within 3 degrees of a cylinder's side its own normal instead of the side's.
    return f"""
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{STEP_S}" integrator="implicitfast" ccd_iterations="200" ccd_tolerance="1e-9">
    <flag filterparent="disable" multiccd="disable"/>
  </option>
  <default>
    <geom {SOFT} mass="0.3" contype="1" conaffinity="2"/>
    <default class="link"><geom {SOFT} contype="2" conaffinity="3"/></default>
  </default>
  <asset>{robot.assets}</asset>
  <worldbody>{robot.torso}{objects}</worldbody>
  <actuator>{servos}</actuator>
</mujoco>"""


class World:
    """A robot and the things that touch it, in motion."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.xml = mjcf(robot)
        self.model = mujoco.MjModel.from_xml_string(self.xml)
        self.data = mujoco.MjData(self.model)
        self.reset()

    def reset(self) -> None:
        """Straightens the robot, takes all objects away, and begins at time 0."""
        mujoco.mj_resetData(self.model, self.data)
        for name in OBJECTS:
            self.park(name)

    def link_pose(self, link: str) -> tuple[Array, Array]:
        """Origin (3,) and rotation (3, 3) of a link's frame in the world, m."""
        body = self.data.body(link)
        return np.array(body.xpos), np.array(body.xmat).reshape(3, 3)

    def bend(self, angles: Mapping[str, float]) -> None:
        """Sets joints (rad) at once, and the targets of their servos. Velocities become 0."""
        for joint, angle in angles.items():
            self.data.joint(joint).qpos[0] = angle
            self.data.ctrl[self.model.actuator(joint).id] = angle
        self.data.qvel[:] = 0.0
        mujoco.mj_forward(self.model, self.data)

    def lay(self, name: str, link: str, at: Array, toward: Array, spin: float, gap: float = 0.006) -> None:
        """Holds an object before a place of a link.

        ``at`` (3,) is the place and ``toward`` (3,) the direction in which the object will move, both in the
        link's frame; ``spin`` (rad) turns the object about that direction; ``gap`` (m) is its distance.
        """
        origin, turned = self.link_pose(link)
        z = turned @ (toward / np.linalg.norm(toward))
        helper = np.eye(3)[np.argmin(np.abs(z))]
        x = np.cross(helper, z)
        x /= np.linalg.norm(x)
        x = x * cos(spin) + np.cross(z, x) * sin(spin)
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, np.column_stack([x, np.cross(z, x), z]).ravel())
        body = self.model.body(name)
        body.pos[:] = origin + turned @ at - gap * z
        body.quat[:] = quat
        joint = self.data.joint(name)
        joint.qpos[0] = joint.qvel[0] = joint.qfrc_applied[0] = 0.0
        mujoco.mj_forward(self.model, self.data)

    def park(self, name: str) -> None:
        """Takes an object away."""
        body = self.model.body(name)
        body.pos[:] = [3.0, list(OBJECTS).index(name), 0.5]
        joint = self.data.joint(name)
        joint.qpos[0] = joint.qvel[0] = joint.qfrc_applied[0] = 0.0
        mujoco.mj_forward(self.model, self.data)

    def push(self, name: str, newtons: float) -> None:
        """Pushes an object along its direction from now on."""
        self.data.joint(name).qfrc_applied[0] = newtons

    def run(self, seconds: float, motion: Motion | None = None) -> None:
        """Lets time pass. ``motion`` moves the servos."""
        for step in range(round(seconds / STEP_S)):
            if motion is not None:
                for joint, angle in motion(step * STEP_S).items():
                    self.data.ctrl[self.model.actuator(joint).id] = angle
            mujoco.mj_step(self.model, self.data)
        # Contacts and poses of the state that the last step has reached.
        mujoco.mj_forward(self.model, self.data)
        if any(int(warning.number) for warning in self.data.warning):
            raise RuntimeError("the simulation has become unstable")
