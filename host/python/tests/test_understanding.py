"""`taxel.features`, `taxel.moments` beside NumPy, and `taxel.fcm` beside the command."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import taxel
from conftest import program
from taxel import fcm


def test_moments_are_exact_sums() -> None:
    image = np.random.default_rng(7).integers(0, 400, (12, 9), np.uint16)
    found = taxel.moments(image)
    y, x = np.indices(image.shape)
    m = int(image.sum())
    assert (found["m"], found["sx"], found["sy"]) == (m, int((x * image).sum()), int((y * image).sum()))
    assert found["x"] == pytest.approx((x * image).sum() / m, abs=1e-12)
    inertia = (((x - found["x"]) ** 2 + (y - found["y"]) ** 2) * image).sum()
    assert found["nmi"] == pytest.approx(np.sqrt(inertia) / m, rel=1e-7)


def test_features_are_of_the_board() -> None:
    frames = np.random.default_rng(8).integers(0, 4000, (40, 32, 16), np.uint16)
    found = taxel.features(frames, pressed=100)
    assert found.shape == (127,) and found.dtype == np.uint16 and not found.flags.writeable
    assert np.array_equal(found, taxel.features(frames.tolist(), pressed=100))
    assert not np.array_equal(found, taxel.features(frames[:20], pressed=100))
    with pytest.raises(TypeError):
        taxel.features(frames / 2)


def test_maps_run_as_by_the_command() -> None:
    tactile = fcm.load("tactile")
    assert tactile.concepts[-1] and "kindness" in tactile.concepts
    given = {tactile.concepts[0]: 0.75, tactile.concepts[3]: 0.5}
    words = [f"--input={name}={value}" for name, value in given.items()]
    assert tactile.run(given) == json.loads(program("fcm", "tactile", "--json", *words))
    assert tactile.explain(given) == json.loads(program("fcm", "why", "tactile", "--json", *words))
    changed = tactile.explain(given, of="kindness", set={tactile.concepts[0]: 0.0})
    more = ["--of", "kindness", f"--set={tactile.concepts[0]}=0"]
    assert changed == json.loads(program("fcm", "why", "tactile", "--json", *words, *more))


def test_maps_are_built_and_kept(tmp_path: Path) -> None:
    concepts: list[str | dict[str, str]] = ["a", {"name": "b", "note": "the effect"}]
    mine = fcm.build("two", concepts=concepts, edges=[("a", "b", "strong -")], transfer="sigmoid")
    assert mine.to_dict()["edge"] == [{"from": "a", "to": "b", "weight": "strong -"}]
    assert fcm.parse(mine.to_toml()) == mine and mine.draw().startswith('digraph "two"') and "2 concepts" in repr(mine)
    fcm.save(mine, tmp_path / "two.toml")
    assert fcm.load(tmp_path / "two.toml") == mine
    with pytest.raises(FileExistsError):
        fcm.save(mine, tmp_path / "two.toml")
    assert isinstance(mine.check(), dict)
    with pytest.raises(taxel.Error, match="unknown concept"):
        fcm.build("two", concepts=["a"], edges=[("a", "c", 1.0)]).run()
    with pytest.raises(taxel.UsageError, match="a must be a number from -1 to 1"):
        mine.run({"a": 3.0})
    with pytest.raises(taxel.UsageError, match='no map "tactil"'):
        fcm.load("tactil")
