"""A touch's force spread over the taxels near it.

The taxels' forces are those nearest to a profile by depth that push, never pull, and whose sum and moment are
those of the touch. With a profile p, widths D and equations A f = b this is

    minimise  (f - p)^T D^-1 (f - p) / 2 + |A f - b|^2 / (2 eps),   f >= 0,

whose solution is f = max(0, p + D A^T y), where y has as many numbers as there are equations: eight. Newton's
method finds it in a few steps. What the equations lack is reported, not hidden: on a cone, for example, no taxel
forces have exactly a wide touch's direction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .depth import depth
from .places import Places
from .robot import World
from .touch import Touch
from .wrench import off_line

Array = npt.NDArray[np.float64]

COVER_M = 0.004
"""Thickness of the garment: an object presses on a taxel from this distance on."""

REACH_M = 0.018
"""Taxels up to this distance from the contact may carry force even if the object does not reach them: 1.5 of
the reference garment's larger pitch. The fabric bridges the gaps under a thin finger."""

LENGTH_M = 0.01
"""Length by which moments are compared with forces: about a pitch."""

EPSILON = 1e-8
"""Weight of the profile against the equations."""

CENTER, MOMENT = 0.1, 0.03
"""Weights of the equations for the centre of pressure and for the moment against those for the force. The
normal that a solver gives need not be exactly that of the surface at its point (a mesh has flat sides): the
equations then contradict each other by some thousandths, and the force is kept."""


@dataclass(frozen=True)
class Spread:
    """Forces on taxels, and what they lack."""

    taxels: npt.NDArray[np.intp]
    """(n,) Numbers of the taxels that carry the touch."""
    newtons: Array
    """(n,) Their forces, N."""
    force_error: float
    """Length of the difference of the sum's vector from the touch's, as a share of the touch's force."""
    moment_error: float
    """Length of the moment about the contact point that is too much, m: as a share of the touch's force."""
    center_error: float
    """Distance of the centre of pressure from the touch's line, m."""


def spread(world: World, places: Places, touch: Touch) -> Spread:
    """Spreads a touch over its link's taxels. Without a taxel in reach, nothing carries it."""
    on = places.on(touch.link)
    origin, turned = world.link_pose(touch.link)
    deep = depth(world, touch.geom, origin + places.at[on] @ turned.T)
    near = np.linalg.norm(places.at[on] - touch.point, axis=1) < REACH_M
    push = -touch.force / touch.newtons
    chosen = ((deep > -COVER_M) | near) & (places.normal[on] @ push > 0.0)
    taxels = on[chosen]
    if len(taxels) == 0:
        return Spread(taxels, np.zeros(0), 1.0, np.inf, np.inf)
    at, normal = places.at[taxels], places.normal[taxels]
    profile = np.maximum(deep[chosen] + COVER_M, 0.0)
    left, right = equations(at, normal, touch)
    newtons = nearest(profile, left, right) * touch.newtons
    forces = -newtons[:, None] * normal
    moment = np.cross(at - touch.point, forces).sum(axis=0) - touch.moment
    center = newtons @ at / max(newtons.sum(), 1e-12)
    return Spread(
        taxels,
        newtons,
        float(np.linalg.norm(forces.sum(axis=0) - touch.force)) / touch.newtons,
        float(np.linalg.norm(moment)) / touch.newtons,
        off_line(touch.force, touch.point, center),
    )


def equations(at: Array, normal: Array, touch: Touch) -> tuple[Array, Array]:
    """Left (8, n) and right (8,) sides for the taxels' shares of a touch's force.

    Three for the sum of the forces, three for their moment about the point, two for the centre of pressure
    across the force's line.
    """
    along = touch.force / touch.newtons
    arm = (at - touch.point) / LENGTH_M
    across = np.linalg.svd(along[None, :])[2][1:]
    moment = touch.moment / (touch.newtons * LENGTH_M)
    left = np.vstack([-normal.T, -MOMENT * np.cross(arm, normal).T, CENTER * across @ arm.T])
    right = np.concatenate([along, MOMENT * moment, np.zeros(2)])
    return left, right


def nearest(profile: Array, left: Array, right: Array) -> Array:
    """(n,) Numbers from 0 up, nearest to a profile (n,) in shape, that fulfil ``left`` @ x = ``right``."""
    total = profile.sum()
    # Where the object reaches no taxel, all in reach begin alike.
    shape = profile / total if total > 0.0 else np.full(len(profile), 1.0 / len(profile))
    # A taxel may change by about as much as it carries; those beside the object only if nothing else helps.
    width = shape + 1e-2 * shape.max()
    dual = np.zeros(len(right))

    def lack(dual: Array) -> tuple[Array, Array]:
        x = np.maximum(shape + width * (left.T @ dual), 0.0)
        return x, right - left @ x - EPSILON * dual

    def height(dual: Array) -> float:
        x = np.maximum(shape + width * (left.T @ dual), 0.0)
        return float(right @ dual - 0.5 * (x * x / width).sum() - 0.5 * EPSILON * dual @ dual)

    x, slope = lack(dual)
    for _ in range(100):
        if np.abs(slope).max() < 1e-12:
            break
        active = left[:, x > 0.0]
        steep = (active * width[x > 0.0]) @ active.T + EPSILON * np.eye(len(right))
        step = np.linalg.solve(steep, slope)
        share, before = 1.0, height(dual)
        while height(dual + share * step) < before + 1e-4 * share * float(slope @ step) and share > 1e-9:
            share *= 0.5
        dual = dual + share * step
        x, slope = lack(dual)
    return x
