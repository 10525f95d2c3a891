"""A garment that creases while its joints move, on the very board, which knows of its folds or does not.

The creases are those of :mod:`~taxel_physics.crease`, or of a :mod:`~taxel_physics.pattern`; the codes are those
of :mod:`~taxel_physics.fabric`. A posture is sent to the board 50 times a second, as a robot reports it: between two
of them the joints go on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Protocol

import numpy as np
import taxel

from .crease import Creases
from .fabric import FRAME_US, Fabric
from .places import Array, Places

FOLDING_US, POSTURE_US = 10_000, 20_000
"""Time from one step of the creases to the next, and from one posture to the next: one scan at least."""

BEND_RAD, SPEED_RAD_S = 2.3, 1.0
"""Greatest angle of a random motion, whose least is 0, and its greatest mean speed between two angles."""

HELD_S = 1.5
"""Longest time for which a joint of a random motion rests at an angle."""

TIP_M, TIP_REACH_M = 0.007, 0.016
"""Width of the pressure of a fingertip, and the distance at which it ends."""

PRESSES_IN_S = 0.1
"""Time in which a fingertip comes to its force."""


class Folds(Protocol):
    """What presses on a garment that folds. It depends on the angles so far."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints at which it folds."""

    def step(self, angles: Mapping[str, float], seconds: float) -> Array:
        """(taxels,) Forces, N, when the joints have come to ``angles`` (rad) within ``seconds``."""


def random_motion(joints: int, seconds: float, seed: int, scan_us: int = FRAME_US) -> Array:
    """(scans, joints) Angles, rad: each joint goes smoothly from angle to angle, and may rest there."""
    rng = np.random.default_rng(seed)
    scans = scans_in(seconds, scan_us)
    angles = np.zeros((scans, joints))
    for joint in range(joints):
        course, at = [np.zeros(0)], 0.0
        while sum(map(len, course)) < scans:
            to = rng.uniform(0.0, BEND_RAD)
            speed = SPEED_RAD_S * rng.uniform(0.3, 1.0)
            along = np.linspace(0.0, 1.0, max(2, scans_in(abs(to - at) / speed, scan_us)))
            course.append(at + (to - at) * (1.0 - np.cos(pi * along)) / 2.0)
            course.append(np.full(scans_in(rng.uniform(0.0, HELD_S), scan_us), to))
            at = to
        angles[:, joint] = np.concatenate(course)[:scans]
    return angles


def scans_in(seconds: float, scan_us: int = FRAME_US) -> int:
    """Scans in this time; of the reference board, if nothing else is said."""
    return round(seconds * 1e6 / scan_us)


def fingertip(places: Places, taxel: int, newtons: float) -> Array:
    """(taxels,) Forces, N, of a fingertip on the four to nine taxels about one, ``newtons`` in all."""
    away = np.linalg.norm(places.at - places.at[taxel], axis=1)
    is_near = (away < TIP_REACH_M) & (places.link == places.link[taxel])
    share = np.where(is_near, np.exp(-((away / TIP_M) ** 2) / 2.0), 0.0)
    forces: Array = newtons / share.sum() * share
    return forces


@dataclass(frozen=True)
class Moment:
    """What one scan was, and what the board made of it."""

    time_s: float
    """Since the motion began."""
    known: Array
    """(joints,) Angles as last sent to the board, or as they would be, rad."""
    folds: Array
    """(taxels,) Forces of the garment's folds, N."""
    frame: taxel.Frame
    """The image and its contacts."""
    leading: str
    """Intention that is announced, or ``none``."""
    said: taxel.Folds | None
    """What the board says of its folds, about ten times a second."""


class Folding:
    """A garment on one day, and the board with it."""

    def __init__(
        self,
        places: Places,
        *,
        day: int,
        seed: int,
        table: Path | None = None,
        folds: Folds | None = None,
        garment: str | Path = "reference",
        scan_us: int = FRAME_US,
    ) -> None:
        """Tares the board and gives it the ``table`` of folds, if there is one.

        ``seed`` is that of the fabric; ``day`` lays the creases, unless there are other ``folds``. ``garment`` is
        that of the places, a preset or a file, and ``scan_us`` the time from scan to scan.
        """
        self.fabric = Fabric(places.taxels, seed)
        self.scan_us = scan_us
        self.board = taxel.VirtualBoard(str(garment))
        self.touch = np.zeros(places.taxels)
        """(taxels,) Forces of what else presses, N: to be set between two moments."""
        self.sent = True
        """False from when on the board is sent no posture."""
        self._folds = folds or Creases(places, day)
        self._time_us = 0
        self._leading = "none"
        nothing = np.zeros(places.taxels)
        self.board.tare(frames=64)
        for _ in range(80):
            self._scan(nothing)
        if table is not None:
            self.board.set_folds(table)
            scans = 0
            while len(self.board.folds()[0]) == 0:
                self._scan(nothing)
                scans += 1
                if scans > 1000:
                    raise RuntimeError(f"{table}: the board has not stored it")

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints at which the garment folds."""
        return self._folds.joints

    def run(self, motion: Array) -> Iterator[Moment]:
        """Moves the joints along (scans, joints) angles, rad, as of :func:`random_motion`."""
        known, folds = motion[0], self.touch
        step, posture = (max(1, round(us / self.scan_us)) for us in (FOLDING_US, POSTURE_US))
        for scan, angles in enumerate(motion):
            if scan % step == 0:
                bent = dict(zip(self.joints, angles.tolist(), strict=True))
                folds = self._folds.step(bent, step * self.scan_us * 1e-6)
            if scan % posture == 0:
                known = angles
                if self.sent:
                    degrees = np.degrees(angles).tolist()
                    self.board.set_posture(dict(zip(self.joints, degrees, strict=True)))
            frame, said = self._scan(folds + self.touch)
            yield Moment(scan * self.scan_us * 1e-6, known, folds, frame, self._leading, said)

    def counts(self, newtons: Array) -> Array:
        """(taxels,) Counts, without noise, that these forces (taxels,), N, are."""
        counts: Array = self.fabric.sensor.counts_per_newton * self.fabric.gain * newtons
        return counts

    def _scan(self, newtons: Array) -> tuple[taxel.Frame, taxel.Folds | None]:
        """One scan at these forces (taxels,), N."""
        self._time_us += self.scan_us
        frame, said = None, None
        for event in self.board.step(self.fabric.codes(newtons), self._time_us):
            if isinstance(event, taxel.Frame):
                frame = event
            elif isinstance(event, taxel.Folds):
                said = event
            elif isinstance(event, taxel.Intent):
                self._leading = event.leading
            elif isinstance(event, taxel.Answer) and event.refusal is not None:
                raise RuntimeError(event.refusal)
        if frame is None:
            raise RuntimeError(f"no image of the scan at {self._time_us} us")
        return frame, said
