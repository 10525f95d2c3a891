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
    assert found["column"] == pytest.approx((x * image).sum() / m, abs=1e-12)
    inertia = (((x - found["column"]) ** 2 + (y - found["row"]) ** 2) * image).sum()
    assert found["nmi"] == pytest.approx(np.sqrt(inertia) / m, abs=6e-8)


def test_features_are_of_the_board() -> None:
    frames = np.random.default_rng(8).integers(0, 4000, (40, 32, 16), np.uint16)
    found = taxel.features(frames, pressed=100)
    assert found.shape == (127,) and found.dtype == np.uint16 and not found.flags.writeable
    assert np.array_equal(found, taxel.features(frames.tolist(), pressed=100))
    assert not np.array_equal(found, taxel.features(frames[:20], pressed=100))
    with pytest.raises(TypeError):
        taxel.features(frames / 2)


def test_a_model_of_planes_decides_by_the_greatest(tmp_path: Path) -> None:
    still, moving = (np.full((40, 8, 8), 500, np.uint16), np.zeros((40, 8, 8), np.uint16))
    moving[np.arange(40), np.arange(40) % 8] = 500
    both = np.array([taxel.features(touch, pressed=12) for touch in (still, moving)], float)
    mean, scale = both.mean(axis=0), both.std(axis=0) + 1
    apart = np.clip((both[1] - mean) / scale, -2.5, 2.5) / 127
    model = taxel.TouchModel.linear(
        ["still", "moving"], mean=mean, scale=scale, weights=np.array([-apart, apart]), offsets=np.zeros(2), pressed=12
    )
    assert (model.classes, model.pressed) == (["still", "moving"], 12)
    model.save(tmp_path / "own.model")
    again = taxel.TouchModel.load(tmp_path / "own.model")
    for touch, name in ((still, "still"), (moving, "moving")):
        decision = again.decide(touch)
        assert (decision.name, decision.confidence) == (name, None)
        features = np.clip((taxel.features(touch, pressed=12) - mean) / scale, -2.5, 2.5)
        assert decision.scores == pytest.approx([-(features @ apart), features @ apart], abs=0.1)
    with pytest.raises(taxel.Error):
        model.save(tmp_path / "own.model")
    with pytest.raises(taxel.UsageError, match="127"):
        taxel.TouchModel.linear(["a", "b"], mean=mean[:5], scale=scale, weights=np.array([apart, apart]), offsets=np.zeros(2))
    with pytest.raises(taxel.Error, match="longer than 16 bytes"):
        taxel.TouchModel.linear(["a" * 17, "b"], mean=mean, scale=scale, weights=np.array([apart, apart]), offsets=np.zeros(2))


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
