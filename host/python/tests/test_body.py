"""A body on the board: what presses on the links of the robot."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
import taxel


def test_a_body_on_the_board_tells_what_presses_where() -> None:
    board = taxel.Board()
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
    assert (link["link"], link["pressed"]) == ("torso", 2000)
    (contact,) = last.contacts
    assert contact["at_m"] == link["center_m"]
    # Half a turn about z, and a metre up.
    x, y, z = contact["at_m"]
    assert contact["base"]["at_m"] == pytest.approx([-x, -y, z + 1.0], abs=5e-6)
    # Gains count.
    board.set_gains([2.0] * board.taxels)
    hold(rest, 30)
    assert hold(touched, 10)[-1].links[0]["pressed"] == 4000


def test_a_simulated_board_has_a_body_from_the_start() -> None:
    with taxel.open("sim:pat", body="reference", seconds=1) as board:
        links = {link["link"] for event in board if isinstance(event, taxel.Pressing) for link in event.links}
    assert links == {"torso"}
