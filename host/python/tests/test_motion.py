"""`taxel.Motion`: from touch to motion."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
import pytest
import taxel

POSTURE = {"left_shoulder_pitch": 0.8, "left_shoulder_roll": 0.7, "left_shoulder_yaw": 0.3, "left_elbow": 1.2}
PRESS = taxel.MotionTouch("left_forearm", (0.03, 0.0, -0.15), (2.0, 0.0, 0.0), 40.0, touch=7, region="left forearm")


def test_it_begins_disarmed_and_moves_once_it_is_armed() -> None:
    motion = taxel.Motion("reference", "people")
    command = motion(POSTURE, 5000, [PRESS])
    assert (command.phase, command.deed, command.speed) == ("disarmed", "nothing", None)
    assert not command.velocities.any() and command.velocities.dtype == np.float64
    motion.arm(POSTURE, 10_000)
    for cycle in range(10):
        command = motion(POSTURE, 15_000 + 5000 * cycle, [PRESS])
    assert (command.phase, command.deed, command.speed, command.fault) == ("armed", "retreat", 0.0, None)
    moved = {name for name, at in zip(motion.joints, command.velocities, strict=True) if at}
    assert "left_elbow" in moved and not any(name.startswith("right") for name in moved)
    assert command.causes == [
        {"touch": 7, "region": "left forearm", "link": "left_forearm", "newtons": 40.0, "do": "retreat", "row": None}
    ]
    motion.disarm()
    assert not motion(POSTURE, 65_000, [PRESS]).velocities.any()


def test_faults_stop_it_and_are_counted() -> None:
    motion = taxel.Motion("reference")
    motion.arm(POSTURE, 10_000)
    command = motion(POSTURE, 15_000, [PRESS], posture_us=10_000, frame_us=12_000)
    assert command.velocities.any()
    command = motion({**POSTURE, "left_elbow": float("nan")}, 20_000, [PRESS])
    assert (command.fault, command.speed, motion.phase) == ("not_a_number", 0.0, "stopped")
    assert not command.velocities.any() and motion.faults["not_a_number"] == 1
    with pytest.raises(taxel.Error, match="not armed: stale_posture"):
        motion.arm(POSTURE, 100_000, posture_us=40_000)
    motion.arm(POSTURE, 100_000)
    assert motion(POSTURE, 105_000, [PRESS], frame_us=80_000).fault == "time_jumps"
    motion.arm(POSTURE, 110_000)
    assert motion(POSTURE, 135_000, [PRESS], frame_us=110_000).fault == "late_frame"


def test_positions_may_be_an_array_in_the_order_of_the_joints() -> None:
    by_name, by_order = taxel.Motion("reference"), taxel.Motion("reference")
    listed = np.array([POSTURE.get(name, 0.0) for name in by_order.joints])
    for each, posture in ((by_name, POSTURE), (by_order, listed)):
        each.arm(posture, 1000)
    named = by_name(POSTURE, 6000, [PRESS], leading="attack")
    assert np.array_equal(named.velocities, by_order(listed, 6000, [PRESS], leading="attack").velocities)
    assert by_order(listed[:3], 11_000).fault == "not_a_number"


def test_what_is_wrong_is_said(tmp_path: Path) -> None:
    file = tmp_path / "b.toml"
    file.write_text("name = \"x\"\n[retreat]\nspeed = 9\n")
    with pytest.raises(taxel.Error, match=r"line 3, `retreat.speed`: must be 0.01 to 2, not 9"):
        taxel.Motion("reference", file)
    with pytest.raises(taxel.UsageError, match='did you mean "people"'):
        taxel.Motion("reference", "poeple")
    with pytest.raises(taxel.UsageError, match="leading must be none, kindness, threat or attack"):
        taxel.Motion("reference")(POSTURE, 0, leading="joy")
    with pytest.raises(taxel.Error, match="no link"):
        taxel.Motion("reference")(POSTURE, 0, [taxel.MotionTouch("leg", (0, 0, 0), (1, 0, 0), 1.0)])


def test_a_cycle_is_short() -> None:
    motion = taxel.Motion("reference")
    motion.arm(POSTURE, 1000)
    touches = [
        taxel.MotionTouch("left_forearm", (0.03, 0.0, -0.01 * number), (1.0, 0.02 * number, 0.0), 30.0, touch=number)
        for number in range(16)
    ]
    spent = []
    for cycle in range(200):
        begun = time.perf_counter()
        assert motion(POSTURE, 6000 + 5000 * cycle, touches).phase == "armed"
        spent.append(time.perf_counter() - begun)
    median = sorted(spent)[100] * 1e6
    print(f"a cycle through Python, 7 joints, 16 contacts: median {median:.0f} us")
    assert median < 5000
