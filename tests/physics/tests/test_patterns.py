"""Folds whose creases are recorded: single images of worn trousers, without an object, as patterns that grow with
an angle. Each is learned from one sweep, or from six of other days, and judged on further ones.

The recordings are in the folder ``smart_garment`` of those that ``TAXEL_DATA`` lists.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import taxel
from conftest import note
from judge import COLUMNS, Learned, Verdict, judged

from taxel_physics.pattern import Pattern
from taxel_physics.places import BODIES, Array, places

IMAGES = ("pose-1", "pose-2", "stand-1", "stand-2", "stair-0", "stair-1", "stair-2", "leg-1", "leg-2")
"""Images in which the wearer touches nothing but himself and the ground."""

LEG = slice(0, 16)
"""Columns of the left leg: a joint bends one leg."""

CREST, NEWTONS = 500.0, 0.9
"""The recordings' largest value, and what a taxel then bears, N: the strongest bulge of ``creases.toml``."""

PITCH_MM = 10.0
"""Of the garment mat-64x32. That of the trousers is not known."""

SWEEPS = {"one": (range(1), 90.0), "six": (range(6), 45.0)}
"""Days of the sweeps, and the length of each."""

SHIFTS_MM = (30.0, 20.0)
"""Most by which the garment is said to shift: the first one for which a board has room. The days of ``creases.toml``
have a standard deviation of 7.8 mm, so that less would not be true."""

DAYS, DAY_S, TOUCHED_S = range(200, 203), 600.0, 40.0
"""Days that are judged, and the length of the motion on each without touches and with them. On the second one the
creases press 1.4 times as strongly as on the day of the one sweep, and appear 12 degrees later."""

LEFT = 0.01
"""Most of the scans with a false contact that may be left."""

UNLIKE = 0.02
"""Most that the correlation of expected and measured pressure may lack of 1 over the ten minutes of a day. In the
first one it lacks more: creases a taxel wide lie on another taxel each day, and nobody knows which until it has been
pressed."""

MISSED, FORCE_OFF, UNCERTAIN = 0.05, 0.1, 0.05
"""Most touches inside folds that may be missed, share; error of a force that is small, share; and share of the
reports inside folds that may be off by more than that and by more than the doubt."""

FORCES_N = (2.0, 4.0)
"""Range of a fingertip's force."""


def recorded() -> Path:
    """The folder of the recordings."""
    for folder in os.environ.get("TAXEL_DATA", "").split(os.pathsep):
        if folder and (Path(folder) / "smart_garment").is_dir():
            return Path(folder) / "smart_garment"
    note("Recorded creases: not run: TAXEL_DATA lists no folder with smart_garment")
    pytest.skip("TAXEL_DATA lists no folder with smart_garment")


def learned(image: Array, file: Path, days: range, seconds: float) -> tuple[Learned, float]:
    """What a board learns of a pattern on these days, and the shift that it allows for, mm."""
    newtons = image / CREST * NEWTONS
    garment = Learned(
        file.stem,
        places(BODIES / "mat-flat.toml", image.size, "mat-64x32"),
        file,
        "mat-64x32",
        folds=lambda day: Pattern(newtons, PITCH_MM, day),
    )
    return garment, garment.learn(days, seconds, SHIFTS_MM)


@pytest.mark.parametrize("sweeps", SWEEPS)
def test_recorded_creases_are_no_touches(sweeps: str, tmp_path: Path) -> None:
    folder = recorded()
    lines, verdicts = [], list[Verdict]()
    for name in IMAGES:
        image = np.zeros((64, 32))
        image[:, LEG] = np.load(folder / f"{name}-pants.npy")[:, LEG]
        try:
            garment, shift_mm = learned(image, tmp_path / f"{name}.folds", *SWEEPS[sweeps])
        except taxel.Error as error:
            lines.append(f"  {name:8}{'':7}{error}")
            continue
        verdicts.append(judged(garment, DAYS, DAY_S, FORCES_N, TOUCHED_S))
        lines.append(f"  {name:8}{shift_mm:7.0f}{verdicts[-1].line(FORCE_OFF)}")
        print(lines[-1], flush=True)
    days = "one day" if sweeps == "one" else f"{sweeps} days"
    head = f"Creases of {len(IMAGES)} recorded trousers, learned from sweeps of {days}, on {len(DAYS)} other days each"
    note("\n".join([head, f"  {'':8}{'mm':>7}{COLUMNS}", *lines]))
    assert len(verdicts) >= len(IMAGES) - 1, "a board has no room for some of them"
    for verdict in verdicts:
        inside, elsewhere = verdict.missed
        assert verdict.left <= LEFT
        assert verdict.unlike <= UNLIKE
        assert (inside <= MISSED, elsewhere) == (True, 0)
        assert verdict.known(FORCE_OFF) >= 1.0 - UNCERTAIN
