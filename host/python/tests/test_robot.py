"""`taxel.open_robot`: all boards of a robot as one stream."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taxel
from conftest import program

ROBOT = """name = "two"
[[boards]]
name = "torso"
source = "sim:five"
garment = "reference"
[[boards]]
name = "hand"
source = "sim:press"
garment = "block-4x16"
tare = 32
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "robot.toml"
    path.write_text(ROBOT)
    return path


def untimed(line: dict[str, Any]) -> dict[str, Any]:
    """The line without the host's time, which is another in each run."""
    assert line.pop("host_time_us") > 1e15
    line.pop("host_time_uncertainty_us", None)
    return line


def test_events_of_each_board_are_the_lines_of_the_program(file: Path) -> None:
    lines = program("live", str(file), "--for", "1s", "--json").splitlines()
    reported = [line for line in map(json.loads, lines) if line["type"] != "board"]
    with taxel.open_robot(file, seconds=1) as robot:
        assert robot.boards == ["torso", "hand"]
        events = list(robot)
    for name in ("torso", "hand"):
        own = [event for event in events if event.board == name and not isinstance(event, taxel.BoardState)]
        assert [untimed(event.to_dict()) for event in own] == [untimed(line) for line in reported if line["board"] == name]
        # All boards go by one time of the host.
        assert all(event.host_ns == event.to_dict()["host_time_us"] * 1000 for event in own)
        states = [event.state for event in events if isinstance(event, taxel.BoardState) and event.board == name]
        assert states == ["met", "over"]
        images = [event.image for event in own if isinstance(event, taxel.Frame)]
        assert len(images) > 50 and all(image is not None for image in images)


def test_a_board_is_asked_by_its_name(file: Path) -> None:
    file.write_text(ROBOT.replace("sim:five", "sim:idle").replace("sim:press", "sim:idle").replace("32", "0"))
    answers = []
    with taxel.open_robot(file, realtime=True, seconds=2) as robot:
        with pytest.raises(taxel.UsageError, match='there is no board "hnad": did you mean "hand"'):
            robot.tare(board="hnad")
        with pytest.raises(taxel.UsageError, match="from 1 to 4096"):
            robot.tare(5000)
        with pytest.raises(taxel.Error, match="contact.high must not be below"):
            robot.set_scene("name = \"wrong\"\n[contact]\nlow = 900\n")
        robot.self_test(board="hand")
        robot.set_scene("name = \"calm\"\n[contact]\nlow = 70\nhigh = 140\n", board="torso")
        for event in robot:
            if isinstance(event, taxel.Answer):
                assert event.refusal is None
                answers.append((event.board, event.request))
    assert ("hand", "self-test") in answers and ("torso", "self-test") not in answers
    assert ("torso", "set-scene") in answers and ("hand", "set-scene") not in answers
    with pytest.raises(taxel.UsageError, match="the robot is closed"):
        robot.tare()


def test_images_and_contacts_of_all_boards_are_aligned(file: Path) -> None:
    with pytest.raises(taxel.UsageError, match="keep must be a time of 0 to 3600 seconds"):
        taxel.open_robot(file, keep=-1.0)
    reported: dict[str, list[taxel.Contacts]] = {"torso": [], "hand": []}
    newest: dict[str, taxel.Frame] = {}
    with taxel.open_robot(file, seconds=2, keep=3600) as robot:
        for event in robot:
            board = event.board or ""
            if isinstance(event, taxel.Frame):
                newest[board] = event
            if isinstance(event, taxel.Contacts):
                reported[board].append(event)
            if isinstance(event, taxel.BoardState) and event.state == "over" and board == "hand":
                assert robot.frames(host_ns=1) == {"torso": None, "hand": None}
        # Between two lists a contact is between them.
        one, two = next(
            pair for pair in zip(reported["hand"], reported["hand"][1:], strict=False) if len(pair[0].contacts) and len(pair[1].contacts)
        )
        middle = (one.host_ns + two.host_ns) // 2
        moment = robot.contacts(middle)["hand"]
        assert moment is not None and moment.contacts.dtype == taxel.MOMENT and not moment.contacts.flags.writeable
        assert abs(moment.host_ns - middle) < 1000 and moment.contacts["panel_name"][0] == "mat"
        for field in ("column", "row", "total"):
            between = (float(one.contacts[field][0]) + float(two.contacts[field][0])) / 2
            assert abs(float(moment.contacts[field][0]) - between) <= 1.0 + 1e-3 * between
        assert moment.contacts["force_n"][0] == pytest.approx(moment.contacts["total"][0] / 1000)
        # The newest image until a time is that event.
        frames = robot.frames(2**63)
        for name, event in newest.items():
            frame = frames[name]
            assert frame is not None and frame.image is not None and event.image is not None
            assert frame.host_ns == event.host_ns and np.array_equal(frame.image, event.image)
        # By default: the newest that all have reported.
        aligned = robot.contacts()
        last = min(events[-1].host_ns for events in reported.values())
        assert {name: moment is not None and moment.host_ns <= last + 1000 for name, moment in aligned.items()} == {
            "torso": True,
            "hand": True,
        }
    with pytest.raises(taxel.UsageError, match="the robot is closed"):
        robot.frames()
    with taxel.open_robot(file, seconds=0.1) as robot, pytest.raises(taxel.UsageError, match="keep=1.0"):
        robot.contacts()


HUG = """name = "two"
urdf = "reference"
[[boards]]
name = "front"
source = "sim:front.toml"
garment = "reference"
[[boards]]
name = "rear"
source = "sim:rear.toml"
garment = "reference"
"""


def test_the_robot_s_map_says_what_touches_of_two_boards_mean(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(HUG)
    for name, panel in (("front", "chest"), ("rear", "back")):
        touch = f'panel = "{panel}"\nshape = "palm"\nat = [7.5, 15.5]\nsize_mm = [120, 90]\nforce_n = 12\nstart_s = 0.6\n'
        script = f'duration_s = 2.5\ngarment = "reference"\n[[touch]]\n{touch}rise_s = 0.4\nhold_s = 1.2\n'
        (tmp_path / f"{name}.toml").write_text(script)
    meant: list[taxel.RobotIntent] = []
    why: dict[str, Any] = {}
    with taxel.open_robot(file, realtime=True) as robot:
        with pytest.raises(taxel.UsageError, match='did you mean "vision"'):
            robot.set_input("visoin", 0.5)
        with pytest.raises(taxel.UsageError, match="must be -1 to 1"):
            robot.set_input("vision", 1.5)
        with pytest.raises(taxel.Error, match='there is no joint "knee"'):
            robot.set_joints({"knee": 0.5})
        for event in robot:
            if not meant:
                robot.set_input("voice", 0.5, age_ms=20)
            if isinstance(event, taxel.RobotIntent):
                meant.append(event)
                if "hug" in event.holding and not why:
                    why = robot.why("hug")
    hugs = [event for event in meant if "hug" in event.holding]
    assert any(event.leading == "kindness" for event in hugs)
    assert all(event.concepts["hug"] >= 0.4 and "plan" in event.defaults for event in hugs)
    assert "voice" not in hugs[0].defaults
    causes = {heard["concept"]: heard["causes"] for heard in why["heard"]}
    assert why["concept"] == "hug" and {cause["board"] for cause in causes["chest"]} == {"front"}
    assert {cause["region"] for cause in causes["back"]} == {"back"}


def test_boards_at_times_of_their_own_have_no_mind(file: Path) -> None:
    with taxel.open_robot(file, seconds=0.1) as robot:
        with pytest.raises(taxel.UsageError, match="realtime=True"):
            robot.set_input("vision", 0.5)
        with pytest.raises(taxel.UsageError, match="realtime=True"):
            robot.why()


def test_a_robot_is_stepped_by_hand(tmp_path: Path) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(
        'name = "one"\nurdf = "reference"\n[[boards]]\nname = "torso"\nsource = "sim:idle"\n'
        'garment = "reference"\nbody = "reference"\ntare = 16\n'
    )
    robot = taxel.VirtualRobot(file)
    assert (robot.boards, robot.taxels("torso")) == (["torso"], 2048)
    with pytest.raises(taxel.UsageError, match='did you mean "torso"'):
        robot.taxels("torsi")
    with pytest.raises(taxel.UsageError, match="3 codes for a garment of 2048 taxels"):
        robot.step("torso", np.zeros(3, np.uint16), 0)
    with pytest.raises(taxel.UsageError, match='did you mean "vision"'):
        robot.set_input("visoin", 0.5, 0)
    meant: list[taxel.RobotIntent] = []
    for time_us in range(0, 1_800_000, 5_000):
        codes = np.full(2048, 100, np.uint16)
        if time_us > 500_000:
            # Pats of 8 N on the chest: each rises for 40 ms, and lasts 130 ms.
            pat_us = (time_us - 500_000) % 400_000
            press = 120 * min(pat_us, 170_000 - pat_us, 40_000) // 40_000
            codes[:512].reshape(32, 16)[12:20, 4:12] += np.uint16(max(press, 0))
        if time_us % 10_000 == 0:
            robot.set_joints({"waist": 0.0, "left_shoulder_pitch": 0.0}, time_us, age_ms=2)
        news = robot.step("torso", codes, time_us)
        if news is not None:
            meant.append(news)
    (touch,) = robot.touches()
    assert (touch.region, touch.link, touch.mover) == ("chest", "torso", "other")
    assert touch.approach is not None and touch.approach.speed_m_s == 0.0 and touch.probe is None
    assert [news.leading for news in meant] == ["kindness"]
    why = robot.why("kindness")
    assert why["concept"] == "kindness" and why["seconds"] > 0.5


def test_a_robot_by_hand_needs_garments(file: Path) -> None:
    file.write_text('name = "one"\n[[boards]]\nname = "a"\nsource = "sim:idle"\n')
    with pytest.raises(taxel.UsageError, match="board a has no `garment`"):
        taxel.VirtualRobot(file)


def test_a_recording_has_the_events_of_each_board(file: Path, tmp_path: Path) -> None:
    touch = tmp_path / "touch.mcap"
    program("record", str(file), "-o", str(touch), "--for", "1s")
    for board, taxels in (("torso", 2048), ("hand", 64)):
        part = taxel.read(f"{touch}#{board}")
        assert part.images().values.shape == (part.topics[f"/taxel/{board}/frames"], taxels)
        lines = program("live", f"{touch}#{board}", "--json").splitlines()
        contacts = [json.loads(line) for line in lines if '"type":"contacts"' in line]
        assert [event.to_dict() for event in part.contacts()] == contacts
    with pytest.raises(taxel.UsageError, match="name one, .*touch.mcap#torso"):
        next(taxel.read(touch).frames())
