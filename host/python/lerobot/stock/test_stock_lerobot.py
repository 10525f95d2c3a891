"""The plug-in in LeRobot itself; `cargo xtask campaign --only lerobot` installs it and runs this."""

import os
import time
from dataclasses import dataclass
from pathlib import Path

# Nothing is asked of the hub.
os.environ["HF_HUB_OFFLINE"] = "1"

import lerobot
import numpy as np
import pytest
import taxel
from lerobot.configs.dataset import DatasetRecordConfig
from lerobot.datasets.lerobot_dataset import LeRobotDataset
from lerobot.robots import Robot, RobotConfig, make_robot_from_config
from lerobot.scripts.lerobot_record import RecordConfig, record
from lerobot.teleoperators import Teleoperator, TeleoperatorConfig
from lerobot.utils.feature_utils import hw_to_dataset_features
from lerobot.utils.import_utils import register_third_party_plugins

register_third_party_plugins()
from lerobot_robot_taxel import ROWS, TaxelRobotConfig, schema  # noqa: E402

FPS = 30
SECONDS = 60
#: Seconds of which the board's time must hold every scan; the recording is a little longer.
MORE = 3
SHAPE = (48, 64, 3)
#: A hand that comes again each second. A script that is over begins anew with a scan of its own: this one is longer
#: than the recording.
SOURCE = f"sim:{Path(__file__).parent / 'hand.toml'}"


class Device:
    """Base of robots and teleoperators here: nothing to set up."""

    is_connected = False
    is_calibrated = True

    def connect(self, calibrate: bool = True) -> None:
        self.is_connected = True
        self.due = time.monotonic()

    def disconnect(self) -> None:
        self.is_connected = False

    def calibrate(self) -> None: ...

    def configure(self) -> None: ...


@RobotConfig.register_subclass("stub")
@dataclass(kw_only=True)
class ArmConfig(RobotConfig):
    """An arm with a camera."""


class Arm(Device, Robot):
    """An arm of one joint, with a camera of 30 images per second: an observation waits for the next one."""

    config_class = ArmConfig
    name = "stub"
    observation_features = {"elbow.pos": float, "front": SHAPE}
    action_features = {"elbow.pos": float}
    cameras = {"front": None}
    images = 0

    def get_observation(self):
        self.due += 1 / FPS
        time.sleep(max(0.0, self.due - time.monotonic()))
        self.images += 1
        return {"elbow.pos": float(self.images), "front": np.full(SHAPE, self.images % 256, np.uint8)}

    def send_action(self, action):
        return action


@TeleoperatorConfig.register_subclass("stub")
@dataclass(kw_only=True)
class LeaderConfig(TeleoperatorConfig):
    """An arm that leads."""


class Leader(Device, Teleoperator):
    """Leader that does not move."""

    config_class = LeaderConfig
    name = "stub"
    action_features = {"elbow.pos": float}
    feedback_features: dict = {}

    def get_action(self):
        return {"elbow.pos": 0.5}

    def send_feedback(self, feedback) -> None: ...


def touched() -> TaxelRobotConfig:
    """The arm with a simulated garment. Without a tare, each run brings the same images."""
    return TaxelRobotConfig(robot=ArmConfig(), source=SOURCE, tare=0)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[dict]]:
    """A data set of an episode, and what its rows are made of."""
    root = tmp_path_factory.mktemp("lerobot") / "touch"
    robot = make_robot_from_config(touched())
    taxels = sum(rows * columns for rows, columns in robot.touch.panels.values())
    features = hw_to_dataset_features(robot.action_features, "action")
    features |= hw_to_dataset_features(robot.observation_features, "observation")
    touch = schema.dataset_features(ROWS, taxels, simulated=robot.touch.simulated)
    features |= touch
    dataset = LeRobotDataset.create(
        "taxel/touch", FPS, features, root=root, robot_type=robot.name, image_writer_threads=2
    )
    robot.connect()
    # What came before the recording.
    while robot.touch.waiting > 0:
        robot.get_observation()
    rows = []
    state = features["observation.state"]["names"]
    for _ in range(FPS * (SECONDS + MORE)):
        seen = robot.get_observation()
        row = {name: seen[name.removeprefix("observation.")] for name in touch}
        row["observation.state"] = np.array([seen[name] for name in state], np.float32)
        row["action"] = np.array([0.5], np.float32)
        rows.append(row)
        dataset.add_frame(row | {"observation.images.front": seen["front"], "task": "be touched"})
    robot.disconnect()
    dataset.save_episode()
    dataset.finalize()
    return root, rows


def test_every_scan_is_in_the_data_set_once(recorded: tuple[Path, list[dict]]) -> None:
    root, rows = recorded
    loaded = LeRobotDataset("taxel/touch", root=root)
    assert loaded.meta.robot_type == "taxel_simulated"
    assert loaded.features[schema.VALUES]["info"]["simulated"] is True
    assert len(loaded) == len(rows) == FPS * (SECONDS + MORE)
    frames, times, counts, images = [], [], [], {}
    for index, row in enumerate(rows):
        item = loaded[index]
        for name, value in row.items():
            assert np.array_equal(item[name].numpy().reshape(value.shape), value), (index, name)
        count = int(item[schema.COUNT])
        counts.append(count)
        window = item[schema.VALUES].numpy()
        assert window.shape == (ROWS, 2048) and not window[count:].any()
        frames += item[schema.FRAMES][:count].tolist()
        times += item[schema.TIMES][:count].tolist()
        images |= dict(zip(item[schema.FRAMES][:count].tolist(), window, strict=False))
        # The camera's image, through a video's loss.
        assert abs(float(item["observation.images.front"].mean()) * 255 - (index_of(row) % 256)) < 4
    assert frames == list(range(frames[0], frames[0] + len(frames)))
    within = [time for time in times if time < times[0] + SECONDS * 1_000_000]
    assert len(within) in (11_718, 11_719) and len(within) < len(times)
    # They are the board's.
    compared = 0
    with taxel.open(SOURCE, repeat=True, tare=0, frames=frames[-1] + 1) as board:
        for event in board:
            if isinstance(event, taxel.Frame) and event.frame in images:
                assert event.image is not None and np.array_equal(images[event.frame], event.image), event.frame
                compared += 1
    assert compared == len(frames)
    print(
        f"lerobot: {lerobot.__version__}: {len(within)} scans in {SECONDS} s of the board's time, each once; "
        f"{len(rows)} rows beside a camera of {FPS} images/s, windows of {min(counts)} to {max(counts)}; all "
        f"{compared} images read back by the stock loader are the board's"
    )


def index_of(row: dict) -> int:
    """Number of the camera's image: the arm reports it as its position."""
    return int(row["observation.state"][0])


def test_the_stock_recorder_takes_the_numbers(tmp_path: Path) -> None:
    settings = DatasetRecordConfig(
        repo_id="taxel/numbers", single_task="be touched", root=tmp_path / "numbers", fps=FPS, episode_time_s=4,
        num_episodes=1, video=False, push_to_hub=False,
    )
    record(RecordConfig(robot=touched(), dataset=settings, teleop=LeaderConfig(), play_sounds=False))
    loaded = LeRobotDataset(settings.repo_id, root=settings.root)
    names = loaded.features["observation.state"]["names"]
    assert {"elbow.pos", "touch.back.total", "touch.left_arm.peak", "touch.attack"} <= set(names)
    totals = [float(item["observation.state"][names.index("touch.back.total")]) for item in loaded]
    assert len(totals) > 60 and max(totals) > 0
    print(f"lerobot: {lerobot.__version__}: lerobot-record takes {len(names)} numbers of {len(totals)} observations")
