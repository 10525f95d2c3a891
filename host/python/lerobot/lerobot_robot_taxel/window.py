"""Windows: what has come since the last observation, in a fixed shape."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

#: Rows of a window: images at 195 per second between two observations at 30 per second, rounded up.
ROWS = 7


class Window(NamedTuple):
    """Images since the last observation, oldest first; rows beyond ``images`` are 0."""

    values: npt.NDArray[np.uint16]
    #: Numbers of the scans.
    frames: npt.NDArray[np.int64]
    time_us: npt.NDArray[np.int64]
    #: Number of images.
    images: int


class Windows:
    """Gathers images. Those that do not fit into a window wait for the next one: none is dropped."""

    def __init__(self, rows: int = ROWS) -> None:
        self.rows = rows
        self._waiting: deque[tuple[int, int, npt.NDArray[np.uint16]]] = deque()

    def add(self, frame: int, time_us: int, image: npt.NDArray[np.uint16]) -> None:
        """Takes the image of a scan, of all taxels. It is not copied, and must not change."""
        self._waiting.append((frame, time_us, image))

    def __len__(self) -> int:
        """Images that wait."""
        return len(self._waiting)

    def take(self, taxels: int) -> Window:
        """The window of the oldest images that wait; those of another garment are 0."""
        values = np.zeros((self.rows, taxels), np.uint16)
        frames, times = np.zeros(self.rows, np.int64), np.zeros(self.rows, np.int64)
        count = 0
        while count < self.rows and self._waiting:
            frames[count], times[count], image = self._waiting.popleft()
            if image.size == taxels:
                values[count] = image
            count += 1
        return Window(values, frames, times, count)
