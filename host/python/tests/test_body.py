"""A body on the board: what presses on the links of the robot."""

from __future__ import annotations

import math
import time
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import taxel


def test_a_body_on_the_board_says_what_presses_where() -> None:
    board = taxel.VirtualBoard()
    rest = np.full(board.taxels, 100, dtype=np.uint16)
    board.set_body("reference")
    board.set_pressing()
    board.tare(frames=16)
    board.set_poses({"torso": ((0.0, 0.0, 1.0), (0.0, 0.0, 1.0, 0.0))})
    answers: list[taxel.Answer] = []
    time_us = 0

    def hold(codes: npt.NDArray[np.uint16], frames: int) -> list[taxel.Pressing]:
        nonlocal time_us
        pressing = []
        for _ in range(frames):
            time_us += 5_128
            for event in board.step(codes, time_us):
                if isinstance(event, taxel.Answer):
                    answers.append(event)
                elif isinstance(event, taxel.Pressing):
                    pressing.append(event)
        return pressing

    assert hold(rest, 250) == []
    assert [event.refusal for event in answers] == [None] * len(answers)
    touched = rest.copy()
    touched[[263, 264, 279, 280]] += 500
    last = hold(touched, 10)[-1]
    (link,) = last.links
    assert (link.link, link.pressed_counts) == ("torso", 2000)
    (contact,) = last.contacts
    assert contact.at_m == link.center_m
    # Half a turn about z, and a metre up.
    x, y, z = contact.at_m
    assert contact.base is not None and contact.base.at_m == pytest.approx((-x, -y, z + 1.0), abs=5e-6)
    # Gains count.
    board.set_gains([2.0] * board.taxels)
    hold(rest, 30)
    assert hold(touched, 10)[-1].links[0].pressed_counts == 4000


def test_a_simulated_board_has_a_body_from_the_start() -> None:
    with taxel.open("sim:pat", body="reference", seconds=1) as board:
        links = {link.link for event in board if isinstance(event, taxel.Pressing) for link in event.links}
    assert links == {"torso"}


WAIST = 0.5
ARMS = [f"{side}_shoulder_{way}" for side in ("left", "right") for way in ("pitch", "roll", "yaw")]


def test_joints_become_poses_of_the_links() -> None:
    options: dict[str, Any] = {"body": "reference", "robot": "reference", "motion": {"angular": 2.0}}
    joints = {"waist": WAIST, **dict.fromkeys(ARMS, 0.0)}
    posed, errors = 0, []
    with taxel.open("sim:five", realtime=True, seconds=4, **options) as board:
        for event in board:
            if isinstance(event, taxel.Contacts):
                board.set_joints(joints, time.time_ns())
            if not isinstance(event, taxel.Pressing) or event.pose_age_us is None:
                continue
            assert event.posed_us == event.time_us - event.pose_age_us
            for contact in [one for one in event.contacts if one.link == "torso"]:
                x, y, z = contact.at_m
                cos, sin = math.cos(WAIST), math.sin(WAIST)
                want = (x * cos - y * sin, x * sin + y * cos, z)
                assert contact.base is not None and contact.base.at_m == pytest.approx(want, abs=1e-4)
                posed += 1
            if event.pose_error_m is not None:
                errors.append(event.pose_error_m)
    assert posed > 50 and len(errors) > 50
    # The robot does not move, but for all that is known it might.
    assert 0 < sorted(errors)[len(errors) // 2] < 0.1


def is_refused(board: taxel.Board, positions: dict[str, float]) -> bool:
    """Sends positions of joints."""
    try:
        board.set_joints(positions)
    except taxel.Error:
        return True
    return False


def test_wrong_joints_and_robots_are_refused_by_name() -> None:
    with pytest.raises(taxel.UsageError, match="a robot needs a body"):
        taxel.open("sim:pat", robot="reference")
    with pytest.raises(taxel.UsageError, match="name one"):
        taxel.open("sim:pat", body="reference", poses_hz=10.0)
    with pytest.raises(taxel.UsageError, match="motion: \"speed=1.0\": the name must be"):
        taxel.open("sim:pat", body="reference", robot="reference", motion={"speed": 1.0})
    with pytest.raises(taxel.UsageError, match="poses per second must be 0.1 to 1000"):
        taxel.open("sim:pat", body="reference", robot="reference", poses_hz=0.0)
    with taxel.open("sim:pat", body="reference", seconds=1) as board:
        with pytest.raises(taxel.UsageError, match="no robot was named"):
            board.set_joints({"waist": 0.0})
    with taxel.open("sim:pat", body="reference", robot="reference", realtime=True, seconds=2) as board:
        # Until the board has sent its time, positions are passed over.
        next(event for event in board if isinstance(event, taxel.Frame) and is_refused(board, {"wast": 0.0}))
        for positions, why in [({"wast": 0.0}, 'no joint "wast"'), ({"waist": 9.0}, "out of its range")]:
            with pytest.raises(taxel.Error, match=why):
                board.set_joints(positions)
        with pytest.raises(taxel.UsageError, match="stamped .* s from now"):
            board.set_joints({"waist": 0.0}, 1)
