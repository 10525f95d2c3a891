"""A recorded image as the creases of one joint: it grows with the angle, lags behind it, and lies elsewhere each day.

Recordings of worn garments are single images without angles. Their creases are real; how they grow and move is
that of one bulge of ``creases.toml``, whose numbers for days and hysteresis hold here, too.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping

import numpy as np

from .crease import FILE, Growth, Sleeve
from .places import Array


class Pattern:
    """The creases of a garment of one panel on one day, at one joint."""

    def __init__(self, newtons: Array, pitch_mm: float, day: int) -> None:
        """Lays (rows, columns) forces, N, which are those of the whole bend, as on this ``day``."""
        read = tomllib.loads(FILE.read_text(encoding="utf-8"))
        spread, first = read["day"], read["bulge"][0]
        rng = np.random.default_rng([2027, day])
        shift_mm = rng.normal(0.0, np.hypot(spread["along_mm"], spread["sleeve_along_mm"]), 2)
        force = float(np.exp(spread["force_share"] * rng.normal()))
        self._sleeve, self._growth = Sleeve(read["hysteresis"]), Growth(read["hysteresis"])
        self._from_deg = first["from_deg"] + spread["onset_deg"] * rng.normal()
        self._over_deg = first["full_deg"] - first["from_deg"]
        self._crest = force * _shifted(newtons, shift_mm / pitch_mm).ravel()

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints at which the garment creases."""
        return ("left_elbow",)

    def step(self, angles: Mapping[str, float], seconds: float) -> Array:
        """(taxels,) Forces, N, when the joint has come to its angle (rad) within ``seconds``."""
        degrees = self._sleeve.follow(float(np.degrees(angles.get(self.joints[0], 0.0))))
        _, share = self._growth.step(degrees, self._from_deg, self._over_deg, seconds)
        newtons: Array = share * self._crest
        return newtons


def _shifted(image: Array, by: Array) -> Array:
    """(rows, columns) An image moved by so many rows and columns; what comes from outside is 0."""
    for axis, shift in enumerate(by):
        whole = int(np.floor(shift))
        part = float(shift - whole)
        image = (1.0 - part) * _moved(image, whole, axis) + part * _moved(image, whole + 1, axis)
    return image


def _moved(image: Array, by: int, axis: int) -> Array:
    """An image moved by whole rows (axis 0) or columns (1)."""
    count = image.shape[axis]
    at = np.arange(count) - by
    is_inside = (at >= 0) & (at < count)
    kept = np.take(image, np.clip(at, 0, count - 1), axis)
    moved: Array = np.where(is_inside if axis == 1 else is_inside[:, None], kept, 0.0)
    return moved
