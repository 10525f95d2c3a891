"""Presses at random: which object presses where on which link, how hard, on a still or a moving robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import exp, log, sin, tau

import numpy as np
import numpy.typing as npt

from .places import Places
from .robot import OBJECTS, Motion, World
from .touch import Touch, touches

Array = npt.NDArray[np.float64]

HOLD_S = 0.4
"""Time for which an object presses before it is looked at."""

FORCES_N = (0.5, 40.0)
"""Range of forces; their logarithm is even."""

SIZE_M = {"ball": 0.01, "finger": 0.01, "rod": 0.05, "box": 0.027, "palm": 0.057}
"""How far a contact may lie beside the place at which an object aims."""

MOVED_M = 0.009
"""How much farther if the robot moves."""

TILT = 0.1
"""Spread of an object's direction about the surface's normal, rad."""

SWING, SWING_S = 0.008, 0.4
"""Amplitude (rad) and period of the joints of a robot that moves."""


@dataclass(frozen=True)
class Press:
    """A press of one object on one link; vectors in the link's frame."""

    by: str
    link: str
    at: Array
    """(3,) Place aimed at, m."""
    toward: Array
    """(3,) Direction of the object."""
    spin: float
    """Turn of the object about its direction, rad."""
    newtons: float
    posture: Mapping[str, float]
    """Angles of the joints, rad."""
    moves: bool
    """True if all joints swing meanwhile."""


def within(places: Places, link: str, margin: float) -> npt.NDArray[np.intp]:
    """Taxels of a link with others all around them, at least ``margin`` (m) from the garment's edge.

    A taxel is at an edge if no other lies within 1.5 of the usual distance on one of its four sides.
    """
    on = places.on(link)
    at, normal = places.at[on], places.normal[on]
    apart = np.linalg.norm(at[:, None] - at[None], axis=2)
    pitch = np.median(np.sort(apart, axis=1)[:, 4])
    edge = np.zeros(len(on), bool)
    for taxel in range(len(on)):
        away = at - at[taxel]
        # Directions across the normal: along the link's z as far as possible, and around it.
        z = np.array([0.0, 0.0, 1.0]) - normal[taxel] * normal[taxel, 2]
        z /= np.linalg.norm(z)
        frame = np.stack([z, np.cross(normal[taxel], z)])
        near = (apart[taxel] < 1.5 * pitch) & (apart[taxel] > 0.0)
        sides = away[near] @ frame.T / pitch
        edge[taxel] = not all((sign * sides[:, axis] > 0.5).any() for axis in (0, 1) for sign in (-1, 1))
    far = apart[:, edge].min(axis=1) >= margin if edge.any() else np.ones(len(on), bool)
    chosen: npt.NDArray[np.intp] = on[far]
    return chosen


def random_presses(places: Places, world: World, seed: int) -> Iterator[Press]:
    """Presses without end: links and objects in turn, still and moving in turn, all else at random."""
    rng = np.random.default_rng(seed)
    allowed = {
        (link, by, moves): within(places, link, SIZE_M[by] + MOVED_M * moves)
        for link in places.links
        for by in OBJECTS
        for moves in (False, True)
    }
    while True:
        for by in OBJECTS:
            for link in places.links:
                for moves in (False, True):
                    taxel = rng.choice(allowed[link, by, moves])
                    tilt = np.clip(rng.normal(0.0, TILT, 3), -2 * TILT, 2 * TILT)
                    aside = rng.uniform(-0.006, 0.006, 3)
                    yield Press(
                        by,
                        link,
                        places.at[taxel] + np.cross(places.normal[taxel], aside),
                        -places.normal[taxel] + tilt,
                        float(rng.uniform(0.0, tau)),
                        exp(rng.uniform(log(FORCES_N[0]), log(FORCES_N[1]))),
                        _posture(world, rng),
                        moves,
                    )


def _posture(world: World, rng: np.random.Generator) -> dict[str, float]:
    """A posture with the arms away from the torso."""
    ranges = {"roll": (0.6, 1.3), "pitch": (-0.3, 0.8), "elbow": (0.0, 1.0), "waist": (-0.5, 0.5)}
    return {
        joint: float(rng.uniform(*ranges[kind]))
        for joint in world.robot.joints
        for kind in ranges
        if kind in joint
    }


def press(world: World, press: Press) -> list[Touch] | None:
    """Lets an object press, and returns what then touches its link. None if the way to it is not free."""
    world.reset()
    world.bend(press.posture)
    world.lay(press.by, press.link, press.at, press.toward, press.spin)
    if world.data.ncon > 0:
        return None
    world.push(press.by, press.newtons)
    world.run(HOLD_S, swing(press.posture) if press.moves else None)
    return touches(world, [press.link])


def swing(posture: Mapping[str, float]) -> Motion:
    """All joints swing about a posture, each a little later than the one before."""

    def motion(time_s: float) -> dict[str, float]:
        return {
            joint: angle + SWING * (sin(tau * time_s / SWING_S + phase) - sin(phase))
            for phase, (joint, angle) in enumerate(posture.items())
        }

    return motion
