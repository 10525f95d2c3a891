"""Pressure of the garment's folds on it where a joint bends: learned from sweeps, subtracted by the board.

A sweep is what every taxel felt while joints moved and nothing touched the garment. Take one on each of several
days, put the garment on anew between them, and give the table to the board:

>>> import numpy as np, taxel
>>> from taxel.folds import Sweep, learn
>>> angles = 45 - 45 * np.cos(np.arange(600) / 30)            # degrees
>>> felt = np.zeros((600, 64), np.uint16)
>>> felt[:, 20:24] = np.where(angles > 20, 5 * (angles - 20), 0)[:, None]
>>> learned = learn([Sweep({"left_elbow": angles}, felt)], garment="block-4x16")
>>> [(fold["joints"], fold["pressed"]) for fold in learned.folds]
[(['left_elbow'], 4)]
>>> learned.save("elbow.folds")                                # for Board.set_folds, VirtualBoard.set_folds
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _taxel

__all__ = ["Learned", "Sweep", "learn"]


@dataclass(frozen=True)
class Sweep:
    """Pressure on every taxel on one day."""

    degrees: Mapping[str, npt.ArrayLike]
    """Angle of each joint, (n,) degrees, as the board knew it."""
    felt: npt.NDArray[np.uint16]
    """(n, taxels) Pressure, counts, of a board that knows of no folds: ``Frame.image``."""


@dataclass(frozen=True)
class Learned:
    """Result of learning."""

    table: bytes
    """The table, for a board."""
    folds: list[dict[str, Any]]
    """Result of each fold: ``joints``; ``pressed`` and ``beside``, the taxels that were pressed and those that a shift
    may bring there; ``knots``, ``step_deg``, ``play_deg``; ``strongest``, counts; ``explained``, share of the
    variance; ``flash_bytes``, ``ram_bytes``."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the table to a new file."""
        with Path(path).open("xb") as file:
            file.write(self.table)


def learn(
    sweeps: Iterable[Sweep],
    *,
    garment: str | os.PathLike[str] = "reference",
    folds: Sequence[Sequence[str]] = (),
    step_deg: float = 8.0,
    shift_mm: float = 30.0,
    shift_deg: float = 16.0,
) -> Learned:
    """Learns the table of folds.

    - ``folds``: one or two joints of each fold; by default each joint of the sweeps is one
    - ``step_deg``: angle between the knots of a joint
    - ``shift_mm``: most by which the garment shifts from day to day
    - ``shift_deg``: most by which the angle differs from day to day at which a fold appears
    """
    read = []
    for sweep in sweeps:
        angles = np.column_stack([np.asarray(angles, np.float32) for angles in sweep.degrees.values()])
        felt = np.ascontiguousarray(sweep.felt)
        if felt.dtype != np.uint16:
            raise TypeError(f"pressures are uint16, not {felt.dtype}")
        read.append((list(sweep.degrees), np.ascontiguousarray(angles), felt))
    table, about = _taxel.learn_folds(
        os.fspath(garment), read, [list(joints) for joints in folds], step_deg, shift_mm, shift_deg
    )
    return Learned(table, about)
