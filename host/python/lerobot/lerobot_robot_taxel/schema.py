"""LeRobot's schema, of which no other file knows.

A robot describes its observations by name: ``float`` for a number, a tuple for the shape of a camera's image.
LeRobot puts the numbers into ``observation.state``. A data set describes its features as dicts of ``dtype``,
``shape`` and ``names``, and takes rows of arrays by the features' names.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from .touch import INTENTIONS, Seen

#: Names of the features of a window.
VALUES, COUNT, TIMES = "observation.touch", "observation.touch_count", "observation.touch_time_us"


def _word(name: str) -> str:
    """A panel's name as part of a feature's name."""
    return "".join(one if one.isalnum() else "_" for one in name)


def observation_features(panels: Iterable[str]) -> dict[str, type]:
    """The numbers of an observation, for ``Robot.observation_features``."""
    names = [f"touch.{_word(panel)}.{what}" for panel in panels for what in ("total", "peak")]
    return dict.fromkeys(names + [f"touch.{name}" for name in INTENTIONS], float)


def observation(seen: Seen) -> dict[str, Any]:
    """The numbers, and the window under the names of its features without ``observation.``."""
    numbers: dict[str, Any] = {}
    for panel, image in seen.panels.items():
        numbers[f"touch.{_word(panel)}.total"] = float(image.sum(dtype=np.int64))
        numbers[f"touch.{_word(panel)}.peak"] = float(image.max())
    numbers.update({f"touch.{name}": value for name, value in seen.felt.items()})
    return numbers | {name.removeprefix("observation."): value for name, value in dataset_frame(seen).items()}


def dataset_features(rows: int, taxels: int) -> dict[str, dict[str, Any]]:
    """The features of a window, to be added to those of a data set."""
    return {
        VALUES: {"dtype": "float32", "shape": (rows, taxels), "names": ["sample", "taxel"]},
        COUNT: {"dtype": "int64", "shape": (1,), "names": None},
        TIMES: {"dtype": "int64", "shape": (rows,), "names": None},
    }


def dataset_frame(seen: Seen) -> dict[str, npt.NDArray[Any]]:
    """The row of a window, to be added to a data set's row. Counts of 16 bits are exact in ``float32``."""
    window = seen.window
    return {
        VALUES: window.values.astype(np.float32),
        COUNT: np.array([window.images], np.int64),
        TIMES: window.time_us,
    }
