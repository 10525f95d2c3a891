"""The spread: it fulfils what can be fulfilled, is nearest to its profile, and says what it lacks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from conftest import Pressed, Dressed

from taxel_physics.spread import nearest, spread


def test_it_is_nearest_to_the_profile() -> None:
    rng = np.random.default_rng(5)
    for _ in range(50):
        left = rng.normal(size=(4, 12))
        profile = np.maximum(rng.normal(size=12), 0.0)
        wanted = np.maximum(rng.normal(size=12), 0.0)
        found = nearest(profile, left, left @ wanted)
        assert found.min() >= 0.0
        assert np.abs(left @ (found - wanted)).max() < 1e-4
        # No step that keeps the equations and the signs leads nearer.
        shape = profile / profile.sum()
        width = shape + 1e-2 * shape.max()
        best = ((found - shape) ** 2 / width).sum()
        for _ in range(200):
            other = np.maximum(found + rng.normal(size=12) * 0.05, 0.0)
            other = other - np.linalg.pinv(left) @ (left @ (other - found))
            if other.min() >= 0.0:
                assert ((other - shape) ** 2 / width).sum() >= best - 1e-3


def test_a_profile_that_fits_is_kept() -> None:
    left = np.array([[1.0, 1.0, 1.0]])
    assert np.allclose(nearest(np.array([1.0, 2.0, 1.0]), left, np.ones(1)), [0.25, 0.5, 0.25])


def test_what_cannot_be_carried_is_reported(dressed: Dressed, pressed: list[Pressed]) -> None:
    """A force 10 degrees off the normals, and a point beyond the garment."""
    dressed.world.reset()
    touch = next(each.touch for each in pressed if each.touch.link == "torso")
    off = replace(touch, force=touch.force + np.array([0.0, 0.0, 0.176 * touch.newtons]))
    assert spread(dressed.world, dressed.places, off).force_error > 0.1
    top = dressed.places.at[dressed.places.on("torso")][:, 2].max()
    beyond = replace(touch, point=np.array([*touch.point[:2], top + 0.012]))
    assert spread(dressed.world, dressed.places, beyond).center_error > 0.01
    away = replace(touch, point=np.array([*touch.point[:2], top + 0.2]))
    assert spread(dressed.world, dressed.places, away).force_error == 1.0
