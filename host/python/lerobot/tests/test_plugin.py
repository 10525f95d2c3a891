"""The plug-in without LeRobot, and the environment."""

from __future__ import annotations

import importlib.util
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import taxel

sys.path.insert(0, str(Path(__file__).parents[1]))
from lerobot_robot_taxel import ROWS, Touch, Windows, Wrapped, observations, schema  # noqa: E402


class Arm:
    """A robot as LeRobot has them."""

    observation_features: dict[str, Any] = {"elbow.pos": float, "front": (480, 640, 3)}
    action_features: dict[str, Any] = {"elbow.pos": float}
    cameras = {"front": "a camera"}
    is_connected = False
    is_calibrated = True

    def connect(self, calibrate: bool = True) -> None:
        self.is_connected = True

    def disconnect(self) -> None:
        self.is_connected = False

    def get_observation(self) -> dict[str, Any]:
        return {"elbow.pos": 1.5, "front": np.zeros((480, 640, 3), np.uint8)}

    def send_action(self, action: dict[str, Any]) -> dict[str, Any]:
        return action


def test_no_image_is_lost() -> None:
    windows = Windows()
    images = [np.full(4, number, np.uint16) for number in range(40)]
    seen: list[int] = []
    for number, image in enumerate(images):
        windows.add(number, number * 5128, image)
        if number % 9 == 8:
            window = windows.take(4)
            assert window.values.shape == (ROWS, 4) and window.images == ROWS
            seen += window.values[: window.images, 0].tolist()
    while windows:
        window = windows.take(4)
        assert not window.values[window.images :].any()
        numbers = window.values[: window.images, 0].tolist()
        assert window.frames[: window.images].tolist() == numbers
        assert window.time_us[: window.images].tolist() == [number * 5128 for number in numbers]
        seen += numbers
    assert seen == list(range(40))


def test_a_robot_has_touch() -> None:
    robot = Wrapped(Arm(), Touch(lambda: taxel.open("sim:pat", realtime=True, repeat=True)))
    features = robot.observation_features
    assert not robot.is_connected
    robot.connect()
    assert robot.is_connected and robot.is_calibrated and robot.observation_features == features
    assert robot.cameras == Arm.cameras
    times: list[int] = []
    for _ in range(20):
        time.sleep(1 / 30)
        seen = robot.get_observation()
        assert set(features) <= set(seen) and seen["elbow.pos"] == 1.5
        assert seen["touch"].shape == (ROWS, 2048) and seen["touch"].dtype == np.float32
        times += seen["touch_time_us"][: seen["touch_count"][0]].tolist()
    assert times == sorted(set(times)) and len(times) > 40
    assert robot.send_action({"elbow.pos": 2.0}) == {"elbow.pos": 2.0}
    robot.disconnect()
    assert not robot.is_connected
    assert features["touch.left_arm.total"] is float and features["touch.attack"] is float


def test_every_image_of_the_board_is_in_a_window() -> None:
    with taxel.open("sim:pat", frames=250) as stream:
        reported = [event for event in stream if isinstance(event, taxel.Frame)]
    touch = Touch(lambda: taxel.open("sim:pat", frames=250))
    with touch:
        time.sleep(1)
        rows: list[Any] = []
        while touch.waiting:
            window = touch.observe().window
            parts = (window.frames, window.time_us, window.values)
            rows += zip(*(part[: window.images] for part in parts), strict=True)
    assert [row[:2] for row in rows] == [(event.frame, event.time_us) for event in reported]
    for (*_, values), event in zip(rows, reported, strict=True):
        assert event.image is not None and np.array_equal(values, event.image)


def test_a_recording_has_the_observations_of_its_images(tmp_path: Path) -> None:
    file = tmp_path / "pat.mcap"
    record = ["record", "--source", "sim:pat", "--for", "2s", "-o", str(file)]
    subprocess.run([sys.executable, "-m", "taxel", *record], check=True, capture_output=True)
    recording = taxel.read(file)
    seen = list(observations(recording, fps=30))
    assert 58 <= len(seen) <= 60
    images = [event for event in recording.frames() if event.image is not None]
    reported = [number for one in seen for number in one.window.frames[: one.window.images].tolist()]
    assert reported == [event.frame for event in images[: len(reported)]] and len(images) - len(reported) <= ROWS
    assert max(one.felt["kindness"] for one in seen) > 0.5
    assert set(schema.dataset_frame(seen[0])) == set(schema.dataset_features(ROWS, 2048, simulated=True))


def test_rows_of_a_data_set_have_its_features() -> None:
    with Touch(lambda: taxel.open("sim:pat", realtime=True)) as touch:
        time.sleep(0.1)
        row = schema.dataset_frame(touch.observe())
        assert touch.simulated
    features = schema.dataset_features(ROWS, 2048, simulated=touch.simulated)
    assert features[schema.VALUES]["info"] == {"simulated": True}
    assert {name: (str(value.dtype), value.shape) for name, value in row.items()} == {
        name: (one["dtype"], one["shape"]) for name, one in features.items()
    }


def test_forces_by_link_have_a_fixed_shape() -> None:
    links = ("torso", "left_upper_arm")
    touch = Touch(lambda: taxel.open("sim:pat", realtime=True, repeat=True, body="reference"), links=links)
    robot = Wrapped(Arm(), touch)
    features = robot.observation_features
    robot.connect()
    pressed = 0.0
    for _ in range(100):
        time.sleep(1 / 30)
        seen = robot.get_observation()
        assert set(features) <= set(seen)
        wrenches = seen["touch_links"]
        assert wrenches.shape == (2, 9) and wrenches.dtype == np.float32
        assert [seen[f"touch.torso.{part}"] for part in schema.PARTS] == pytest.approx(wrenches[0], rel=1e-6)
        assert not wrenches[1].any()
        pressed = max(pressed, seen["touch.torso.fx"])
        if wrenches[0].any():
            # The back is pressed forward, and its centre of pressure lies behind the axis.
            assert seen["touch.torso.fx"] > 0 and seen["touch.torso.px"] < 0
    robot.disconnect()
    assert pressed > 1000
    assert schema.dataset_features(ROWS, 2048, 2, simulated=True)[schema.LINKS]["shape"] == (2, 9)
    assert schema.LINKS not in schema.dataset_features(ROWS, 2048, simulated=True)


def test_nothing_is_simulated_in_place_of_a_board(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # A machine without ports; a wheel as it is given away has those of this machine.
    (tmp_path / "ports.toml").write_text("")
    monkeypatch.setenv("TAXEL_PORTS", str(tmp_path / "ports.toml"))
    touch = Touch(lambda: taxel.open("auto", realtime=True, repeat=True))
    with pytest.raises(taxel.BoardError, match="no board is plugged in"):
        touch.connect()
    with pytest.raises(taxel.BoardError, match="no board is plugged in"):
        _ = touch.panels


def recorded(file: Path, *words: str) -> bytes:
    """Returns what a pressed board sends in two seconds."""
    record = ["record", "--source", "sim:press", "--for", "2s", *words, "-o", str(file)]
    subprocess.run([sys.executable, "-m", "taxel", *record], check=True, capture_output=True)
    return b"".join(one.data for one in taxel.read(file).messages("/taxel/wire"))


def test_another_board_is_no_touch(tmp_path: Path) -> None:
    wires = [recorded(tmp_path / "press.mcap"), recorded(tmp_path / "other.mcap", "--garment", "block-4x16")]
    server = socket.create_server(("127.0.0.1", 0))
    cut, reported = threading.Event(), threading.Event()

    def boards() -> None:
        for wire, until in zip(wires, (cut, reported), strict=True):
            link, _ = server.accept()
            with link:
                link.sendall(wire)
                until.wait(30)

    threading.Thread(target=boards, daemon=True).start()
    touch = Touch(lambda: taxel.open(f"tcp:127.0.0.1:{server.getsockname()[1]}"))
    with server, touch:
        assert touch.observe().window.images > 0
        cut.set()
        until, why = time.monotonic() + 20, ""
        while "another board" not in why:
            assert time.monotonic() < until, f"it goes on: {why}"
            time.sleep(0.01)
            try:
                seen = touch.observe()
                assert seen.window.values.shape[1] == 2048
            except taxel.BoardError as error:
                why = str(error)
        assert why.endswith("it has the garment block-4x16, not reference")
        with pytest.raises(taxel.BoardError, match="another board"):
            touch.observe()
        reported.set()


def test_a_lost_board_is_no_touch(tmp_path: Path) -> None:
    wire = recorded(tmp_path / "press.mcap")
    server = socket.create_server(("127.0.0.1", 0))
    cut, seen, mended = threading.Event(), threading.Event(), threading.Event()

    def board() -> None:
        for until, then in ((cut, seen), (mended, mended)):
            link, _ = server.accept()
            with link:
                link.sendall(wire)
                until.wait(30)
            then.wait(30)

    threading.Thread(target=board, daemon=True).start()
    touch = Touch(lambda: taxel.open(f"tcp:127.0.0.1:{server.getsockname()[1]}"))
    with server, touch:
        assert touch.observe().window.images > 0
        cut.set()

        def lost() -> bool:
            try:
                touch.observe()
            except taxel.BoardError as error:
                assert "is gone" in str(error)
                return True
            return False

        until = time.monotonic() + 20
        while not lost():
            assert time.monotonic() < until, "it goes on"
            time.sleep(0.01)
        assert touch.waiting == 0
        seen.set()
        while lost():
            assert time.monotonic() < until, "it does not come back"
            time.sleep(0.01)
        mended.set()


def test_errors_of_the_stream_are_raised() -> None:
    with pytest.raises(taxel.UsageError):
        Touch(lambda: taxel.open("sim:nope")).connect()
    with pytest.raises(taxel.BoardError, match="not connected"):
        Touch(lambda: taxel.open("sim:pat")).observe()


@pytest.mark.skipif(importlib.util.find_spec("gymnasium") is None, reason="gymnasium is not installed")
def test_the_environment() -> None:
    from gymnasium.utils.env_checker import check_env
    from lerobot_robot_taxel.env import MEANINGS, TouchEnv

    check_env(TouchEnv(), skip_render_check=True)
    env = TouchEnv(render_mode="ansi")
    assert env.render() is None
    _, reported = env.reset(seed=1, options={"scene": "lash"})
    assert reported == {"scene": "lash"}
    steps, right, meant, over = 0, 0.0, set(), False
    while not over:
        _, reward, over, _, info = env.step(np.int64(MEANINGS.index("attack")))
        steps, right = steps + 1, right + reward
        meant.add(info["meaning"])
    env.close()
    assert steps > 100 and 0 < right < steps and {"none", "attack"} <= meant
