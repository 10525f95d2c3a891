"""The garment creases where a joint bends: bulges press on its taxels although nothing touches it.

The bulges move and grow with the angle, lag behind it, and lie elsewhere each day; ``creases.toml`` has the
numbers and says what they mean. This is a model, and knows nothing of how anyone distinguishes folds from touches.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .places import Places

Array = npt.NDArray[np.float64]

FILE = Path(__file__).parent / "creases.toml"
"""The numbers of the model."""


class Sleeve:
    """Angle of a sleeve that lags behind that of its joint: Prandtl's play between two stops."""

    def __init__(self, hysteresis: Mapping[str, float]) -> None:
        """Begins straight."""
        self._play, self._share = hysteresis["play_deg"], hysteresis["share"]
        self._played = 0.0

    def follow(self, degrees: float) -> float:
        """Angle of the sleeve, degrees, when the joint has come to this one."""
        self._played = min(max(self._played, degrees - self._play), degrees + self._play)
        return (1.0 - self._share) * degrees + self._share * self._played


class Growth:
    """How far a bulge has grown: it appears at once, grows, gives way while it is held, and vanishes at once."""

    def __init__(self, hysteresis: Mapping[str, float]) -> None:
        """Begins as nothing."""
        self._held = hysteresis
        self._is_out = False
        self._relaxed = 0.0
        """Share of the force that the fabric has given up, 0 to 1 of what it gives up."""

    def step(self, degrees: float, onset_deg: float, over_deg: float, seconds: float) -> tuple[float, float]:
        """How much of its way it has gone, 0 to 1, and the share of its force, at this angle of its sleeve.

        It begins at ``onset_deg`` and is full ``over_deg`` later; ``seconds`` have passed.
        """
        held = self._held
        self._is_out = degrees > (onset_deg if self._is_out else onset_deg + held["snap_deg"])
        if not self._is_out:
            self._relaxed = 0.0
            return 0.0, 0.0
        self._relaxed += (1.0 - self._relaxed) * (1.0 - float(np.exp(-seconds / held["relaxes_s"])))
        part = min(max((degrees - onset_deg) / over_deg, 0.0), 1.0)
        grown = held["snap_share"] + (1.0 - held["snap_share"]) * part
        return part, grown * (1.0 - held["relaxes"] * self._relaxed)


@dataclass
class _Bulge:
    """One bulge on one side of one elbow, as it lies today."""

    elbow: int
    taxels: npt.NDArray[np.intp]
    along_mm: Array
    """(n,) Distance of each taxel from the joint along the link."""
    around_deg: Array
    """(n,) Direction of each taxel from the inner side."""
    numbers: Mapping[str, Any]
    onset_deg: float
    force: float
    shift_mm: float
    turn_deg: float
    growth: Growth


class Creases:
    """The creases of a garment on one day. They depend on the angles so far; a new day begins straight."""

    def __init__(self, places: Places, day: int = 0, file: Path = FILE) -> None:
        """Lays the bulges of ``file`` on a garment, as on this ``day``. A side without taxels has none."""
        self._taxels = places.taxels
        read = tomllib.loads(file.read_text(encoding="utf-8"))
        hysteresis: Mapping[str, float] = read["hysteresis"]
        self._joints: list[str] = [elbow["joint"] for elbow in read["elbow"]]
        rng = np.random.default_rng([2026, day])
        spread: Mapping[str, float] = read["day"]
        self._bulges: list[_Bulge] = []
        for index, elbow in enumerate(read["elbow"]):
            for number, side in enumerate(elbow["side"]):
                sleeve_mm = rng.normal(0.0, spread["sleeve_along_mm"])
                sleeve_deg = rng.normal(0.0, spread["sleeve_around_deg"])
                on = places.on(side["link"])
                along, around = _unrolled(places.at[on], side)
                for bulge in read["bulge"]:
                    # Drawn for all, so that what a garment lies on does not change the day of the rest.
                    own = rng.normal(size=4)
                    if bulge["side"] == number and len(on) > 0:
                        self._bulges.append(
                            _Bulge(
                                index,
                                on,
                                along,
                                around,
                                bulge,
                                spread["onset_deg"] * own[0],
                                bulge["newtons"] * float(np.exp(spread["force_share"] * own[1])),
                                sleeve_mm + spread["along_mm"] * own[2],
                                sleeve_deg + spread["around_deg"] * own[3],
                                Growth(hysteresis),
                            )
                        )
        self._sleeves = [Sleeve(hysteresis) for _ in self._joints]

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints at which the garment creases."""
        return tuple(self._joints)

    def step(self, angles: Mapping[str, float], seconds: float) -> Array:
        """(taxels,) Forces, N, when the joints have come to ``angles`` (rad) within ``seconds``.

        Joints that are left out are straight.
        """
        degrees = [float(np.degrees(angles.get(joint, 0.0))) for joint in self._joints]
        felt = [sleeve.follow(angle) for sleeve, angle in zip(self._sleeves, degrees, strict=True)]
        newtons = np.zeros(self._taxels)
        for bulge in self._bulges:
            np.add.at(newtons, bulge.taxels, self._press(bulge, felt[bulge.elbow], seconds))
        return newtons

    def _press(self, bulge: _Bulge, degrees: float, seconds: float) -> Array:
        """(n,) Forces of a bulge on its taxels at this angle of its sleeve, N."""
        it = bulge.numbers
        onset, over = it["from_deg"] + bulge.onset_deg, it["full_deg"] - it["from_deg"]
        part, share = bulge.growth.step(degrees, onset, over, seconds)
        if share == 0.0:
            return np.zeros(len(bulge.taxels))
        crest = bulge.force * share

        def between(key: str) -> float:
            first, last = it[key]
            return float(first + (last - first) * part)

        off_mm = (bulge.along_mm - between("along_mm") - bulge.shift_mm) / between("width_mm")
        turned = bulge.around_deg - between("around_deg") - bulge.turn_deg
        off_deg = ((turned + 180.0) % 360.0 - 180.0) / between("length_deg")
        away = off_mm**2 + off_deg**2
        # A bulge has an end: fabric that lies flat does not press.
        return np.where(away < 6.25, crest * np.exp(-away / 2.0), 0.0)


def _unrolled(at: Array, side: Mapping[str, Any]) -> tuple[Array, Array]:
    """Distance from the joint along the link (mm) and direction from the inner side (degrees) of (n, 3)."""
    along, inner = (np.asarray(side[key], np.float64) for key in ("along", "inner"))
    away = at - np.asarray(side["at"], np.float64)
    return away @ along * 1e3, np.degrees(np.arctan2(away @ np.cross(along, inner), away @ inner))
