"""The garment creases where a joint bends: bulges press on its taxels although nothing touches it.

The bulges move and grow with the angle, lag behind it, and lie elsewhere each day; ``creases.toml`` has the
numbers and says what they mean. This is a model, and knows nothing of how anyone tells folds from touches.
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
    is_out: bool = False
    relaxed: float = 0.0
    """Share of the force that the fabric has given up, 0 to 1 of what it gives up."""


class Creases:
    """The creases of a garment on one day. They depend on the angles so far; a new day begins straight."""

    def __init__(self, places: Places, day: int = 0, file: Path = FILE) -> None:
        """Lays the bulges of ``file`` on a garment, as on this ``day``. A side without taxels has none."""
        self._taxels = places.taxels
        read = tomllib.loads(file.read_text(encoding="utf-8"))
        self._hysteresis: Mapping[str, float] = read["hysteresis"]
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
                    # Drawn for all, so that what a garment wears does not change the day of the rest.
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
                            )
                        )
        self._played = np.zeros(len(self._joints))

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints at which the garment creases."""
        return tuple(self._joints)

    def step(self, angles: Mapping[str, float], seconds: float) -> Array:
        """(taxels,) Forces, N, when the joints have come to ``angles`` (rad) within ``seconds``.

        Joints that are left out are straight.
        """
        degrees = np.degrees([angles.get(joint, 0.0) for joint in self._joints])
        play, share = self._hysteresis["play_deg"], self._hysteresis["share"]
        # What plays between two stops that the joint drags along (Prandtl's play).
        self._played = np.clip(self._played, degrees - play, degrees + play)
        felt = (1.0 - share) * degrees + share * self._played
        newtons = np.zeros(self._taxels)
        for bulge in self._bulges:
            np.add.at(newtons, bulge.taxels, self._press(bulge, float(felt[bulge.elbow]), seconds))
        return newtons

    def _press(self, bulge: _Bulge, degrees: float, seconds: float) -> Array:
        """(n,) Forces of a bulge on its taxels at this angle of its sleeve, N."""
        held, it = self._hysteresis, bulge.numbers
        onset = it["from_deg"] + bulge.onset_deg
        bulge.is_out = degrees > (onset if bulge.is_out else onset + held["snap_deg"])
        if not bulge.is_out:
            bulge.relaxed = 0.0
            return np.zeros(len(bulge.taxels))
        bulge.relaxed += (1.0 - bulge.relaxed) * (1.0 - float(np.exp(-seconds / held["relaxes_s"])))
        part = min(max((degrees - onset) / (it["full_deg"] - it["from_deg"]), 0.0), 1.0)
        grown = held["snap_share"] + (1.0 - held["snap_share"]) * part
        crest = bulge.force * grown * (1.0 - held["relaxes"] * bulge.relaxed)

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
