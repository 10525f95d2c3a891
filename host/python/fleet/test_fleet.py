"""The example of many recordings, by Ray and alone; `cargo xtask campaign --only fleet` installs what it needs and
runs this."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import polars as pl
import pytest
from polars.testing import assert_frame_equal
from ray.cluster_utils import Cluster

EXAMPLE = Path(__file__).parents[1] / "examples/fleet.py"
SCENES = ["pat", "lash", "press", "stroke", "hold", "finger", "ball", "box", "idle", "two-hands"]
RECORDINGS = 1000


def run(*words: object) -> str:
    """Runs Python with these arguments; returns what it printed."""
    # Nothing is sent to Ray's makers.
    variables = os.environ | {"RAY_USAGE_STATS_ENABLED": "0"}
    done = subprocess.run([sys.executable, *map(str, words)], env=variables, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A thousand recordings; one of them is none."""
    folder = tmp_path_factory.mktemp("fleet") / "recordings"
    folder.mkdir()

    def record(number: int) -> None:
        scene = f"sim:{SCENES[number % len(SCENES)]}"
        file = folder / f"{number:04}.mcap"
        run("-m", "taxel", "record", "--source", scene, "--seed", number, "--for", "1.5s", "-o", file)

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(record, range(RECORDINGS)))
    (folder / "0500.mcap").write_bytes(b"none")
    return folder


def features(folder: Path, name: str, *words: object) -> tuple[pl.DataFrame, float]:
    """The table of the example, and the seconds that it took."""
    table = folder.parent / f"{name}.parquet"
    start = time.monotonic()
    said = run(EXAMPLE, folder, table, *words)
    seconds = time.monotonic() - start
    assert f"{RECORDINGS} recordings, 1 of them not read" in said
    return pl.read_parquet(table), seconds


def test_two_workers_and_two_machines_say_what_one_process_says(folder: Path) -> None:
    alone, alone_s = features(folder, "alone", "--one")
    assert alone["file"].to_list() == [f"{number:04}.mcap" for number in range(RECORDINGS)]
    lost = alone.filter(pl.col("error").is_not_null())
    assert lost["file"].to_list() == ["0500.mcap"] and "0500.mcap" in lost["error"][0]
    # In one scene nothing touches.
    touched = alone.filter(pl.col("panel").is_not_null())
    assert len(touched) == RECORDINGS * 9 // 10 - 1
    assert touched["features"].list.len().unique().to_list() == [127]
    assert touched["features"].n_unique() == len(touched)
    workers, workers_s = features(folder, "workers", "--workers", 2)
    assert_frame_equal(workers, alone)
    machines = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    machines.add_node(num_cpus=1)
    try:
        cluster, cluster_s = features(folder, "cluster", "--address", machines.address)
    finally:
        machines.shutdown()
    assert_frame_equal(cluster, alone)
    print(
        f"fleet: {RECORDINGS} recordings of 1.5 s: one process {alone_s:.1f} s, Ray with two workers {workers_s:.1f} s, "
        f"with two nodes of a core each {cluster_s:.1f} s (Ray's own start counts); the tables are equal"
    )
