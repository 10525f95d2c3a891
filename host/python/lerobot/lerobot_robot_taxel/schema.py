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
import taxel

from .touch import INTENTIONS, Seen

#: Names of the features of a window.
VALUES, COUNT = "observation.touch", "observation.touch_count"
FRAMES, TIMES = "observation.touch_frame", "observation.touch_time_us"
#: Name of the feature of what presses on links, and its parts: force (counts) and moment (counts times m) about the
#: link's origin, and the centre of pressure (m), in the link's frame. 0 where nothing presses.
LINKS = "observation.touch_links"
PARTS = ("fx", "fy", "fz", "mx", "my", "mz", "px", "py", "pz")


def _word(name: str) -> str:
    """A panel's name as part of a feature's name."""
    return "".join(one if one.isalnum() else "_" for one in name)


def _parts(presses: taxel.Wrench | None) -> list[float]:
    """Returns force and moment on a link, in the order of ``PARTS``."""
    if presses is None:
        return [0.0] * len(PARTS)
    return [float(part) for parts in (presses.force_counts, presses.moment_counts_m, presses.center_m) for part in parts]


def observation_features(panels: Iterable[str], links: Iterable[str] = ()) -> dict[str, type]:
    """The numbers of an observation, for ``Robot.observation_features``."""
    names = [f"touch.{_word(panel)}.{what}" for panel in panels for what in ("total", "peak")]
    names += [f"touch.{_word(link)}.{part}" for link in links for part in PARTS]
    return dict.fromkeys(names + [f"touch.{name}" for name in INTENTIONS], float)


def observation(seen: Seen) -> dict[str, Any]:
    """The numbers, and the window under the names of its features without ``observation.``."""
    numbers: dict[str, Any] = {}
    for panel, image in seen.panels.items():
        numbers[f"touch.{_word(panel)}.total"] = float(image.sum(dtype=np.int64))
        numbers[f"touch.{_word(panel)}.peak"] = float(image.max())
    for link, presses in seen.presses.items():
        parts = zip(PARTS, _parts(presses), strict=True)
        numbers.update({f"touch.{_word(link)}.{part}": value for part, value in parts})
    numbers.update({f"touch.{name}": value for name, value in seen.felt.items()})
    return numbers | {name.removeprefix("observation."): value for name, value in dataset_frame(seen).items()}


def dataset_features(rows: int, taxels: int, links: int = 0, *, simulated: bool) -> dict[str, dict[str, Any]]:
    """The features of a window and of the forces on so many links, to be added to those of a data set. Whether the
    touch is ``simulated``, as ``Touch.simulated`` knows, is reported with the images."""
    on_links = {"dtype": "float32", "shape": (links, len(PARTS)), "names": ["link", "part"]}
    return ({LINKS: on_links} if links else {}) | {
        VALUES: {
            "dtype": "float32",
            "shape": (rows, taxels),
            "names": ["sample", "taxel"],
            "info": {"simulated": simulated},
        },
        COUNT: {"dtype": "int64", "shape": (1,), "names": None},
        FRAMES: {"dtype": "int64", "shape": (rows,), "names": None},
        TIMES: {"dtype": "int64", "shape": (rows,), "names": None},
    }


def dataset_frame(seen: Seen) -> dict[str, npt.NDArray[Any]]:
    """The row of a window and of the forces on links, to be added to a data set's row. Counts of 16 bits are exact in
    ``float32``."""
    window = seen.window
    parts = [_parts(presses) for presses in seen.presses.values()]
    return ({LINKS: np.array(parts, np.float32)} if parts else {}) | {
        VALUES: window.values.astype(np.float32),
        COUNT: np.array([window.images], np.int64),
        FRAMES: window.frames,
        TIMES: window.time_us,
    }
