"""Whose motion has caused a touch: the robot's own, or that of what touches it."""

from __future__ import annotations

import os
from collections import Counter
from pathlib import Path

import pytest
from conftest import note

from taxel_physics.bumps import KINDS, Bumps, Felt
from taxel_physics.places import BODIES, places
from taxel_physics.robot import World, bent, reference

COUNT = int(os.environ.get("TAXEL_BUMPS", "200"))
"""Touches of each kind."""

FOLDS = max(COUNT // 5, 1)
"""Folds of an arm."""

RIGHT = 0.95


@pytest.fixture(scope="module")
def felt(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Felt]]:
    bumps = Bumps(World(reference()), places(), tmp_path_factory.mktemp("bumps"))
    found: dict[str, list[Felt]] = {kind: [] for kind in KINDS}
    for number, kind in enumerate(KINDS):
        for seed, bump in enumerate(bumps.random(kind, seed=700 + number)):
            assert seed < 6 * COUNT, "most must reach their link"
            if min(len(found[kind]), COUNT) == COUNT:
                break
            each = bumps.feel(bump, seed)
            # What touches more lightly than a contact begins is not felt.
            if each is not None and each.truth == kind and each.mover is not None:
                found[kind].append(each)
    return found


def test_whose_motion_it_was_is_reported(felt: dict[str, list[Felt]]) -> None:
    lines = ["Whose motion has caused a touch     reported: own, other, unsure; announced an attack"]
    for kind, each in felt.items():
        counted = Counter(one.mover for one in each)
        attacks = sum("attack" in one.leading for one in each)
        counts = ", ".join(str(counted[mover]) for mover in ("own", "other", "unsure"))
        lines.append(f"  {kind:8}{len(each):5} touches   {counts}; {attacks}")
    note("\n".join(lines))
    for kind in ("own", "other"):
        right = sum(one.mover == kind for one in felt[kind])
        assert right >= RIGHT * len(felt[kind]), [
            (one.mover, one.bump, one.link_m_s, one.object_m_s) for one in felt[kind] if one.mover != kind
        ]
    assert not [one for one in felt["own"] if "attack" in one.leading]
    assert any("attack" in one.leading for one in felt["other"])


def test_a_folded_arm_touches_itself(tmp_path: Path) -> None:
    folded = Bumps(World(bent()), places(BODIES / "bent.toml"), tmp_path, str(BODIES / "bent.toml"))
    felt: list[Felt] = []
    for seed, bump in enumerate(folded.folds(seed=23)):
        assert seed < 2 * FOLDS, "most must touch"
        if len(felt) == FOLDS:
            break
        each = folded.feel(bump, seed)
        if each is not None and each.mover is not None:
            felt.append(each)
    counted = Counter(one.mover for one in felt)
    note(f"  folded  {FOLDS:5} touches   {counted['own']}, {counted['other']}, {counted['unsure']}")
    assert counted["own"] >= RIGHT * FOLDS
    assert not [one for one in felt if "attack" in one.leading]


def test_the_robot_that_is_described_is_that_of_the_world(tmp_path: Path) -> None:
    """A wrong description would be judged as a wrong robot: the speeds that it says are the world's."""
    bumps = Bumps(World(reference()), places(), tmp_path)
    for seed, bump in enumerate(bumps.random("own", seed=5)):
        each = bumps.feel(bump, seed)
        if each is not None:
            assert each.link_m_s > 0.0 and abs(each.object_m_s) < 0.01
        if seed > 4:
            break
