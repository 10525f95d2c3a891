"""Touches that the robot's own motion causes, touches that are done to it, and touches in which both move.

Whose motion it was is said by the velocities along the surface's normal in the step before the first contact.
The robot bumps into objects that stand still: on the way of its joints, as a table is; or folds its arm, so that it
touches itself. What is done to it meets a robot at rest, or one that moves along its own surface there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import tau
from pathlib import Path

import mujoco
import numpy as np
import numpy.typing as npt
import taxel

from .described import described
from .fabric import Fabric
from .places import Places
from .presses import SIZE_M, within
from .robot import OBJECTS, STEP_S, World
from .spread import spread
from .touch import touches

Array = npt.NDArray[np.float64]

KINDS = ("own", "other", "both")

SCAN_US = 5_000
"""Time from scan to scan."""

JOINTS_US, LATE_US, READ_RAD = 10_000, 8_000, 1e-4
"""Joints are sent this often, this late, with this standard deviation: an encoder of 16 bits."""

SPEED_M_S = (0.06, 0.5)
"""Speeds of the robot's surface along its normal when it moves itself."""

OBJECT_M_S = (0.06, 1.5)
"""Speeds of what touches it."""

INTO = 0.4
"""Least share of its speed that the robot's surface has along its normal if it is to bump into something."""

RATE = 3.0
"""Greatest rate of a joint, rad/s."""

RUN_S, AFTER_S = 0.25, 0.4
"""Time before and after the first contact."""

BEYOND_S = 0.03
"""Time for which a joint goes on after the first contact."""

STILL = 0.1
"""One has not moved if its velocity along the normal is at most this share of the other's."""

HARD = 1e6
"""Damping of an object that stands still."""


@dataclass(frozen=True)
class Bump:
    """A touch to be: what moves how; vectors in the link's frame."""

    kind: str
    by: str
    link: str
    taxel: int
    spin: float
    posture: Mapping[str, float]
    """Angles at the first contact, rad."""
    rates: Mapping[str, float]
    """Rates of the joints, rad/s."""
    speed: float
    """Speed of the object, m/s."""
    newtons: float
    """Force that goes on pushing the object."""


@dataclass
class Felt:
    """What happened, and what the robot made of it."""

    bump: Bump
    link_m_s: float = 0.0
    """Velocity of the link's surface along its normal before the contact, outwards."""
    object_m_s: float = 0.0
    """Velocity of the object against the normal: towards the robot."""
    newtons: float = 0.0
    """Greatest force."""
    mover: str | None = None
    """Whose motion it was, as the robot says; None if it has felt nothing."""
    approach: taxel.Approach | None = None
    """How the robot says that its surface moved."""
    leading: list[str] = field(default_factory=list)
    """Intentions that the robot announced."""

    @property
    def truth(self) -> str:
        """``own``, ``other`` or ``both``."""
        link, other = abs(self.link_m_s), abs(self.object_m_s)
        if other <= STILL * link:
            return "own"
        return "other" if link <= STILL * other else "both"


class Bumps:
    """A world whose robot carries a garment, and the very board that feels it."""

    def __init__(self, world: World, places: Places, folder: Path, body: str = "reference") -> None:
        self.world, self.places = world, places
        self.file = folder / "robot.toml"
        (folder / "robot.urdf").write_text(described(world))
        self.file.write_text(
            'name = "physics"\nurdf = "robot.urdf"\n[[boards]]\nname = "board"\nsource = "sim:idle"\n'
            f'garment = "reference"\nbody = "{body}"\ntare = 32\n'
        )

    def random(self, kind: str, seed: int) -> Iterator[Bump]:
        """Touches of a kind without end; links and objects in turn."""
        rng = np.random.default_rng(seed)
        allowed = {(link, by): within(self.places, link, SIZE_M[by]) for link in self.places.links for by in OBJECTS}
        while True:
            for by in OBJECTS:
                for link in self.places.links:
                    taxel_number = int(rng.choice(allowed[link, by]))
                    posture = self._posture(rng)
                    aims = kind != "other" or bool(rng.integers(2))
                    rates = self._rates(rng, kind, link, taxel_number, posture) if aims else {}
                    if rates is None:
                        continue
                    speed = 0.0 if kind == "own" else float(np.exp(rng.uniform(*np.log(OBJECT_M_S))))
                    newtons = float(np.exp(rng.uniform(np.log(2.0), np.log(30.0))))
                    yield Bump(kind, by, link, taxel_number, float(rng.uniform(0.0, tau)), posture, rates, speed, newtons)

    def feel(self, bump: Bump, seed: int) -> Felt | None:
        """Lets it happen. None if the way was not free, or nothing was met."""
        world, model, data = self.world, self.world.model, self.world.data
        at, normal = self.places.at[bump.taxel], self.places.normal[bump.taxel]
        if bump.by not in OBJECTS:
            return self._run(bump, self._back(bump), seed)
        dof = int(model.joint(bump.by).dofadr[0])
        damping = float(model.dof_damping[dof])
        world.reset()
        world.bend(bump.posture)
        gap = RUN_S * bump.speed
        world.lay(bump.by, bump.link, at, -normal, bump.spin, gap)
        before = self._back(bump)
        if data.ncon > 0:
            return None
        data.joint(bump.by).qvel[0] = bump.speed
        model.dof_damping[dof] = HARD if bump.kind == "own" else 0.0
        try:
            return self._run(bump, before, seed)
        finally:
            model.dof_damping[dof] = damping

    def folds(self, seed: int) -> Iterator[Bump]:
        """Bends of the left elbow of ``bent`` until the forearm touches the upper arm, without end."""
        rng = np.random.default_rng(seed)
        number = int(self.places.on("left_forearm")[0])
        while True:
            posture = {**self._posture(rng), "left_elbow": float(rng.uniform(3.1, 3.25))}
            rates = {"left_elbow": float(rng.uniform(0.5, RATE))}
            yield Bump("own", "left_upper_arm", "left_forearm", number, 0.0, posture, rates, 0.0, 0.0)

    def _back(self, bump: Bump) -> dict[str, float]:
        """Bends the robot back to where it is before the touch, and lets its joints move at their rates."""
        if bump.by not in OBJECTS:
            self.world.reset()
        before = {joint: angle - RUN_S * bump.rates.get(joint, 0.0) for joint, angle in bump.posture.items()}
        self.world.bend(before)
        for joint, rate in bump.rates.items():
            self.world.data.joint(joint).qvel[0] = rate
        return before

    def _run(self, bump: Bump, before: Mapping[str, float], seed: int) -> Felt | None:
        world, model, data = self.world, self.world.model, self.world.data
        rng = np.random.default_rng(seed)
        fabric = Fabric(self.places.taxels, seed)
        robot = taxel.VirtualRobot(self.file)
        felt = Felt(bump)
        now_us, began, first = 0, 200_000, None
        readings: list[tuple[int, dict[str, float]]] = []
        steps = round(SCAN_US * 1e-6 / STEP_S)
        newtons, stop_s = np.zeros(self.places.taxels), np.inf
        # A hinge beside what it presses has a long lever: a folded arm does not crush itself.
        beyond_s = BEYOND_S if bump.by in OBJECTS else 0.0
        while first is None or now_us < first + AFTER_S * 1e6:
            if first is None and now_us > began + (RUN_S + 0.15) * 1e6:
                return None
            if now_us >= began:
                for _ in range(steps):
                    # It goes on a little beyond the first contact, and holds there.
                    way = min(float(data.time), stop_s)
                    for joint, rate in bump.rates.items():
                        data.ctrl[model.actuator(joint).id] = before[joint] + rate * way
                    if bump.kind != "own" and first is not None:
                        data.joint(bump.by).qfrc_applied[0] = bump.newtons
                    velocities = self._velocities(bump)
                    mujoco.mj_step(model, data)
                    if first is None and any(touch.by == bump.by for touch in touches(world, [bump.link])):
                        first, stop_s = now_us, float(data.time) + beyond_s
                        felt.link_m_s, felt.object_m_s = velocities
                mujoco.mj_forward(model, data)
                newtons[:] = 0.0
                for touch in touches(world, self.places.links):
                    carried = spread(world, self.places, touch)
                    newtons[carried.taxels] += carried.newtons
                felt.newtons = max(felt.newtons, float(newtons.sum()))
            if now_us % JOINTS_US == 0:
                read = {joint: float(data.joint(joint).qpos[0] + rng.normal(0.0, READ_RAD)) for joint in world.robot.joints}
                readings.append((now_us, read))
            while readings and readings[0][0] + LATE_US <= now_us:
                at_us, read = readings.pop(0)
                robot.set_joints(read, now_us, age_ms=(now_us - at_us) // 1000)
            meant = robot.step("board", fabric.codes(newtons), now_us)
            if meant is not None:
                felt.leading.append(meant.leading)
            strongest = self._strongest(robot.touches(), (bump.link, bump.by))
            if strongest and first is not None:
                felt.mover, felt.approach = strongest.mover, strongest.approach
            now_us += SCAN_US
        return felt

    @staticmethod
    def _strongest(touches: list[taxel.RobotTouch], links: tuple[str, str]) -> taxel.RobotTouch | None:
        """The strongest touch of the links; of two links that touch each other, the one that is not reported right."""
        on = [[touch for touch in touches if touch.link == link] for link in links]
        most = [max(each, key=lambda touch: touch.load) for each in on if each]
        return min(most, key=lambda touch: touch.mover == "own", default=None)

    def _velocities(self, bump: Bump) -> tuple[float, float]:
        """Of the link's surface at the taxel and of the object, along the normal, m/s; see :class:`Felt`."""
        world, model, data = self.world, self.world.model, self.world.data
        origin, turned = world.link_pose(bump.link)
        normal = turned @ self.places.normal[bump.taxel]
        at = origin + turned @ self.places.at[bump.taxel]
        both = np.zeros(6)
        link = model.body(bump.link).id
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, link, both, 0)
        moved = both[3:] + np.cross(both[:3], at - origin)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, model.body(bump.by).id, both, 0)
        return float(moved @ normal), float(-both[3:] @ normal)

    def _posture(self, rng: np.random.Generator) -> dict[str, float]:
        ranges = {"roll": (0.5, 1.2), "pitch": (-0.3, 0.8), "elbow": (0.1, 1.0), "waist": (-0.5, 0.5)}
        return {
            joint: float(rng.uniform(*ranges[kind])) for joint in self.world.robot.joints for kind in ranges if kind in joint
        }

    def _rates(
        self, rng: np.random.Generator, kind: str, link: str, number: int, posture: Mapping[str, float]
    ) -> dict[str, float] | None:
        """Rates of the joints that move a taxel along its normal, or across it; None if there are none."""
        side = link.split("_", maxsplit=1)[0]
        joints = [joint for joint in posture if joint == "waist" or joint.startswith(f"{side}_")]
        joints = [joint for joint in joints if "elbow" not in joint]
        normal_then = self._at(link, number, posture)[1]
        start = self._at(link, number, posture)[0]
        slopes = []
        for joint in joints:
            moved = self._at(link, number, {**posture, joint: posture[joint] + 1e-4})[0]
            slopes.append((moved - start) / 1e-4)
        slope = np.array(slopes)
        for _ in range(100):
            rates = rng.normal(size=len(joints))
            velocity = rates @ slope
            along, size = float(velocity @ normal_then), float(np.linalg.norm(velocity))
            if kind == "other":
                # Along the surface, or away from it.
                target = float(np.exp(rng.uniform(*np.log(SPEED_M_S))))
                if size < 1e-3 or abs(along) > 0.01 * size:
                    # The part along the normal is taken out by one of the joints.
                    lever = slope @ normal_then
                    chosen = int(np.argmax(np.abs(lever)))
                    if abs(lever[chosen]) < 1e-3:
                        continue
                    rates[chosen] -= along / lever[chosen]
                    velocity = rates @ slope
                    size = float(np.linalg.norm(velocity))
                if size < 1e-2:
                    continue
                rates *= target / size
            else:
                target = float(np.exp(rng.uniform(*np.log(SPEED_M_S))))
                if abs(along) < INTO * size:
                    continue
                rates *= target / along
            if np.abs(rates).max() <= RATE:
                return dict(zip(joints, rates.tolist(), strict=True))
        return None

    def _at(self, link: str, number: int, posture: Mapping[str, float]) -> tuple[Array, Array]:
        """Place and normal of a taxel in the world."""
        self.world.bend(posture)
        origin, turned = self.world.link_pose(link)
        return origin + turned @ self.places.at[number], turned @ self.places.normal[number]
