"""Force, moment and centre of pressure by link, from newtons by taxel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .places import Places

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Wrench:
    """What taxels feel on one link; vectors in its frame."""

    force: Array
    """(3,) Sum of the taxels' forces, each against its normal, N."""
    moment: Array
    """(3,) Their moment about the link's origin, N m."""
    pressed: float
    """Sum of the magnitudes, N."""
    center: Array
    """(3,) Centre of pressure, m: places weighted by magnitude; 0 if nothing presses."""


def wrench(places: Places, newtons: Array, link: str) -> Wrench:
    """Wrench on a link, from the force on each taxel (taxels,), N."""
    on = places.on(link)
    each, at = newtons[on], places.at[on]
    forces = -each[:, None] * places.normal[on]
    pressed = float(each.sum())
    center = each @ at / pressed if pressed > 0.0 else np.zeros(3)
    return Wrench(forces.sum(axis=0), np.cross(at, forces).sum(axis=0), pressed, center)


def reach(places: Places, link: str) -> float:
    """Distance of a link's farthest taxel from its origin, m."""
    return float(np.linalg.norm(places.at[places.on(link)], axis=1).max())


def off_line(touch_force: Array, touch_point: Array, center: Array) -> float:
    """Distance (m) of a centre of pressure from the line of a force.

    A force may be moved along its line without any effect, so that only this distance means something. On a
    curved link the weighted mean of places lies under the surface.
    """
    along = touch_force / np.linalg.norm(touch_force)
    away = center - touch_point
    return float(np.linalg.norm(away - along * (away @ along)))
