"""The model of creases: what its file promises."""

from __future__ import annotations

import hashlib
from itertools import pairwise
from math import radians
from pathlib import Path

import numpy as np
from conftest import Dressed, table

from taxel_physics.crease import FILE, Creases
from taxel_physics.places import Array, Places

STEP_S = 0.01
FIXED = "28c6e4abbc3eae899ceaa8bf5766aa37aa1dfa0ca4674f7c48e8abd07874860d"


def bent_by(creases: Creases, angles_deg: Array, joint: str = "left_elbow") -> Array:
    """(steps, taxels) Forces along a course of angles."""
    return np.array([creases.step({joint: radians(angle)}, STEP_S) for angle in angles_deg])


def test_the_file_is_as_it_was_fixed() -> None:
    assert hashlib.sha256(FILE.read_bytes()).hexdigest() == FIXED


def test_a_straight_arm_has_no_crease_and_a_bent_one_has(dressed: Dressed) -> None:
    creases = Creases(dressed.places)
    assert bent_by(creases, np.zeros(50)).max() == 0.0
    forces = bent_by(creases, np.linspace(0, 130, 200))[-1]
    for link in dressed.places.links:
        total = forces[dressed.places.on(link)].sum()
        if link in ("left_upper_arm", "left_forearm"):
            assert 2.0 < total < 40.0, link
        else:
            assert total == 0.0, link
    # The reference garment carries the upper arm alone.
    assert ("left_forearm" in dressed.places.links) == (dressed.name == "bent")


def middle(places: Places, newtons: Array, link: str) -> float:
    """Distance along the link's z at which its creases lie, mm."""
    on = places.on(link)
    return float(newtons[on] @ places.at[on, 2] / newtons[on].sum() * 1e3)


def test_bulges_grow_and_move(dressed: Dressed, tmp_path: Path) -> None:
    angles = np.linspace(0, 150, 301)
    totals = bent_by(Creases(dressed.places), angles).sum(axis=1)
    assert all(np.diff(totals[[int(np.searchsorted(angles, angle)) for angle in (50, 80, 110, 140)]]) > 0.5)
    # The first bulge alone comes nearer to the elbow, which lies at the lower end of the upper arm.
    alone = tmp_path / "alone.toml"
    alone.write_text(
        "[[bulge]]".join(FILE.read_text(encoding="utf-8").split("[[bulge]]")[:2]), encoding="utf-8"
    )
    forces = bent_by(Creases(dressed.places, file=alone), angles)
    places = [
        middle(dressed.places, forces[np.searchsorted(angles, angle)], "left_upper_arm") for angle in (60, 150)
    ]
    # The reference sleeve ends before the elbow, which cuts the bulge.
    assert 3.0 < places[0] - places[1] < 20.0


def test_the_way_back_is_another(dressed: Dressed) -> None:
    way = np.concatenate([np.linspace(0, 130, 261), np.linspace(130, 0, 261)])
    totals = bent_by(Creases(dressed.places), way).sum(axis=1)
    up, down = totals[:261], totals[261:][::-1]
    angles = np.linspace(0, 130, 261)
    inner = (angles > 40) & (angles < 110)
    assert (down[inner] - up[inner]).mean() > 0.05 * up[inner].mean()
    assert totals[-1] == 0.0
    # Held, the fabric gives way.
    creases = Creases(dressed.places)
    bent = bent_by(creases, np.linspace(0, 120, 50))[-1].sum()
    held = bent_by(creases, np.full(3000, 120.0))[-1].sum()
    assert 0.78 < held / bent < 0.9


def test_each_day_is_another(dressed: Dressed) -> None:
    way = np.linspace(0, 120, 60)
    days = [bent_by(Creases(dressed.places, day), way)[-1] for day in range(40)]
    assert np.array_equal(days[3], bent_by(Creases(dressed.places, 3), way)[-1])
    totals = np.array([day.sum() for day in days])
    middles = np.array([middle(dressed.places, day, "left_upper_arm") for day in days])
    # What a memory of one day's fold is worth on another day.
    left = [np.abs(a - b).sum() / a.sum() for a, b in pairwise(days)]
    columns = {
        "force of all bulges, N": totals,
        "place on the upper arm from its mean, mm": np.abs(middles - middles.mean()),
        "difference from the day before, share": left,
        "most on a taxel, N": [day.max() for day in days],
    }
    table(f"Creases at 120 degrees on 40 days, body {dressed.name}", columns, {})
    assert totals.std() > 0.05 * totals.mean()
    assert middles.std() > 2.0
    assert np.median(left) > 0.3
