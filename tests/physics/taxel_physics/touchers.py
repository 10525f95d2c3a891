"""Robots that are moved by touch: an arm and a humanoid as URDF and in MuJoCo, and hands on springs that press them.

Both robots are made from one table, others than the reference robot. Joints go as fast as they are commanded, whatever
presses: drives of industry do. A hand is a sphere of 1.5 kg on a spring whose other end is driven by position.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

STEP_S = 0.0005
HAND_KG = 1.5
HAND_M = 0.02


@dataclass(frozen=True)
class Joint:
    """A joint and the link that it carries: a capsule along z of the link's frame."""

    name: str
    parent: str
    at: tuple[float, float, float]
    axis: tuple[float, float, float]
    limits: tuple[float, float]
    length: float
    radius: float = 0.05

    @property
    def link(self) -> str:
        """Name of the link."""
        return f"{self.name}_link"


def arm() -> list[Joint]:
    """An arm of seven joints, 1.2 m long."""
    lengths = (0.16, 0.20, 0.20, 0.20, 0.18, 0.12, 0.10)
    axes = ((0, 0, 1), (0, 1, 0), (0, 0, 1), (0, 1, 0), (0, 0, 1), (0, 1, 0), (1, 0, 0))
    joints: list[Joint] = []
    for number, (length, axis) in enumerate(zip(lengths, axes, strict=True)):
        parent, height = (joints[-1].link, joints[-1].length) if joints else ("base", 0.1)
        joints.append(Joint(f"a{number}", parent, (0, 0, height), axis, (-2.6, 2.6), length))
    return joints


def humanoid() -> list[Joint]:
    """A torso on a waist of three joints, with two arms of six."""
    waist = [
        Joint("waist_yaw", "base", (0, 0, 0.8), (0, 0, 1), (-1.2, 1.2), 0.05, 0.08),
        Joint("waist_roll", "waist_yaw_link", (0, 0, 0.05), (1, 0, 0), (-0.4, 0.4), 0.05, 0.08),
        Joint("waist_pitch", "waist_roll_link", (0, 0, 0.05), (0, 1, 0), (-0.5, 0.9), 0.35, 0.09),
    ]
    arms = [
        part
        for side, sign in (("left", 1.0), ("right", -1.0))
        for part in (
            Joint(f"{side}_pitch", "waist_pitch_link", (0, 0.2 * sign, 0.33), (0, 1, 0), (-2.5, 2.5), 0.04),
            Joint(f"{side}_roll", f"{side}_pitch_link", (0, 0.03 * sign, 0), (1, 0, 0), (-2.2, 2.2), 0.04),
            Joint(f"{side}_yaw", f"{side}_roll_link", (0, 0, 0.04), (0, 0, 1), (-1.6, 1.6), 0.27),
            Joint(f"{side}_elbow", f"{side}_yaw_link", (0, 0, 0.27), (0, 1, 0), (-2.4, 0.1), 0.05, 0.045),
            Joint(f"{side}_turn", f"{side}_elbow_link", (0, 0, 0.05), (0, 0, 1), (-1.7, 1.7), 0.22, 0.04),
            Joint(f"{side}_wrist", f"{side}_turn_link", (0, 0, 0.22), (1, 0, 0), (-0.9, 0.9), 0.12, 0.035),
        )
    ]
    return waist + arms


def urdf(joints: list[Joint]) -> str:
    """Description of a robot for ``taxel``."""
    parts = ['<robot name="judged">', '<link name="base"/>']
    for joint in joints:
        at, axis = (" ".join(f"{number:g}" for number in vector) for vector in (joint.at, joint.axis))
        parts += [
            f'<link name="{joint.link}"/>',
            f'<joint name="{joint.name}" type="revolute"><parent link="{joint.parent}"/><child link="{joint.link}"/>'
            f'<origin xyz="{at}"/><axis xyz="{axis}"/>'
            f'<limit lower="{joint.limits[0]}" upper="{joint.limits[1]}" effort="100" velocity="3"/></joint>',
        ]
    return "\n".join([*parts, "</robot>"])


def _body(joints: list[Joint], parent: str) -> str:
    text = ""
    for joint in (each for each in joints if each.parent == parent):
        at, axis = (" ".join(f"{number:g}" for number in vector) for vector in (joint.at, joint.axis))
        text += (
            f'<body name="{joint.link}" pos="{at}"><joint name="{joint.name}" axis="{axis}" armature="1e6"/>'
            f'<geom name="{joint.link}" type="capsule" fromto="0 0 0 0 0 {joint.length:g}" size="{joint.radius:g}" '
            f'mass="1" contype="1" conaffinity="2"/>{_body(joints, joint.link)}</body>'
        )
    return text


def _hand(number: int) -> str:
    ways = zip("xyz", ("1 0 0", "0 1 0", "0 0 1"), strict=True)
    slides = "".join(f'<joint name="hand{number}{way}" type="slide" axis="{axis}"/>' for way, axis in ways)
    ball = f'<geom name="hand{number}" size="{HAND_M}" mass="{HAND_KG}" contype="2" conaffinity="1"/>'
    return f'<body name="hand{number}" pos="9 9 {9 + number}">{slides}{ball}</body>'


@dataclass
class Hand:
    """A hand: the place of its driven end, stiffness (N/m) and damping (N s/m) of its spring."""

    driven: Array
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Felt:
    """What a hand presses: the link, place and outward normal in the base, force along the normal (N)."""

    hand: int
    link: str
    at: Array
    normal: Array
    newtons: float
    force: Array
    """Whole force on the hand, friction too."""


@dataclass
class TouchedRobot:
    """A robot in MuJoCo and hands that press it."""

    joints: list[Joint]
    hands: list[Hand]
    skin: float = 40_000.0
    """Stiffness of skin and cloth where a hand presses, N/m; damped."""
    model: mujoco.MjModel = field(init=False)
    data: mujoco.MjData = field(init=False)

    def __post_init__(self) -> None:
        balls = "".join(_hand(number) for number in range(len(self.hands)))
        damping = 1.5 * self.skin**0.5
        self.model = mujoco.MjModel.from_xml_string(
            f'<mujoco><option timestep="{STEP_S}" gravity="0 0 0" cone="elliptic"/><default>'
            f'<geom solref="-{self.skin:g} -{damping:g}" solimp="0.95 0.95 0.001" friction="0.4"/></default>'
            f'<worldbody>{_body(self.joints, "base")}{balls}</worldbody></mujoco>'
        )
        self.data = mujoco.MjData(self.model)
        self.count = len(self.joints)
        names = [joint.name for joint in self.joints]
        self.order = [int(self.model.joint(name).qposadr[0]) for name in names]
        self.first = [int(self.model.joint(f"hand{number}x").qposadr[0]) for number in range(len(self.hands))]

    def pose(self, posture: Array) -> None:
        """Puts the robot into a posture; the order is that of the joints."""
        self.data.qpos[self.order] = posture
        self.data.qvel[:] = 0.0
        mujoco.mj_forward(self.model, self.data)

    @property
    def posture(self) -> Array:
        """Positions of the joints, rad."""
        return np.array(self.data.qpos[self.order])

    def put(self, hand: int, at: Array) -> None:
        """Puts a hand, and its driven end, to a place at rest."""
        first, offset = self.first[hand], np.array([9.0, 9.0, 9.0 + hand])
        self.data.qpos[first : first + 3] = at - offset
        self.data.qvel[first : first + 3] = 0.0
        self.hands[hand].driven = np.array(at)
        mujoco.mj_forward(self.model, self.data)

    def place(self, hand: int) -> Array:
        """Where a hand is."""
        return np.array(self.data.body(f"hand{hand}").xpos)

    def step(self, velocities: Array) -> None:
        """Half a millisecond in which the joints go as fast as they are told."""
        self.data.qvel[self.order] = velocities
        for number, (hand, first) in enumerate(zip(self.hands, self.first, strict=True)):
            stretched = hand.driven - self.place(number)
            moving = self.data.qvel[first : first + 3]
            self.data.qfrc_applied[first : first + 3] = hand.stiffness * stretched - hand.damping * moving
        mujoco.mj_step(self.model, self.data)

    def felt(self) -> list[Felt]:
        """What the hands press now."""
        found = []
        wrench = np.zeros(6)
        for number in range(self.data.ncon):
            contact = self.data.contact[number]
            names = [self.model.geom(int(geom)).name for geom in contact.geom]
            hand = next((index for index in range(2) if names[index].startswith("hand")), None)
            if hand is None or names[1 - hand].startswith("hand"):
                continue
            mujoco.mj_contactForce(self.model, self.data, number, wrench)
            frame = np.array(contact.frame).reshape(3, 3)
            # The frame's x leads from the first geom to the second.
            outwards = frame[0] if hand == 1 else -frame[0]
            force = (1.0 if hand == 1 else -1.0) * (frame.T @ wrench[:3])
            if wrench[0] > 0.0:
                at = np.array(contact.pos)
                found.append(Felt(int(names[hand][4:]), names[1 - hand], at, outwards, float(wrench[0]), force))
        return found

    def jacobian(self, link: str, at: Array) -> Array:
        """Velocity of a point of a link for each joint, (3, joints), by MuJoCo."""
        jacobian = np.zeros((3, self.model.nv))
        mujoco.mj_jac(self.model, self.data, jacobian, None, at, self.model.body(link).id)
        return jacobian[:, self.order]

    def local(self, link: str, vector: Array, *, is_place: bool) -> Array:
        """A place or a direction of the base in the frame of a link."""
        body = self.data.body(link)
        rotation = np.array(body.xmat).reshape(3, 3)
        return rotation.T @ (vector - body.xpos if is_place else vector)
