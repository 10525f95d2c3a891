"""What the board itself says of forces, moments and centres of pressure by link: its `Pressing` events."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
import taxel

from .fabric import FRAME_US, UNITY, Chain, Fabric
from .wrench import Wrench

Array = npt.NDArray[np.float64]

STORED = 220
"""Scans in which a board stores a body: a piece of its table between two of them."""


class Felt:
    """A board that has a body and the gains of its fabric, with the scene that ships."""

    def __init__(self, fabric: Fabric, body: str | Path = "reference") -> None:
        """Stores the body on the board, sets its gains and tares it."""
        chain = Chain(fabric, scene=None)
        self.fabric = fabric
        self._newtons_per_count = chain.newtons_per_count
        self._nothing = np.zeros(fabric.rest.size)
        self._board = taxel.VirtualBoard("reference")
        self._time_us = 0
        self._board.set_body(str(body))
        self._board.set_pressing()
        self._board.set_gains((chain.gains / UNITY).tolist())
        self._hold(self._nothing, STORED)
        self._board.tare(frames=64)
        self._hold(self._nothing, 80)

    def read(self, newtons: Array, link: str, frames: int, settle: int = 4) -> Wrench | None:
        """Mean of what the board says of a link while the fabric bears ``newtons`` (taxels,), N.

        The fabric is at rest before; the first ``settle`` frames, in which the filter may wait, are left out.
        None if the board feels nothing there.
        """
        self._hold(self._nothing, 12)
        said = [event for event in self._hold(newtons, settle + frames)[settle:] if event is not None]
        on = [each for event in said for each in event.links if each.link == link]
        if not on:
            return None
        scale = self._newtons_per_count
        keys = ("force_counts", "moment_counts_m", "pressed_counts", "center_m")
        force, moment, pressed, center = (np.mean([getattr(each, key) for each in on], axis=0) for key in keys)
        return Wrench(force * scale, moment * scale, float(pressed) * scale, center)

    def _hold(self, newtons: Array, frames: int) -> list[taxel.Pressing | None]:
        """The board's last word on the links after each scan, while the fabric bears this."""
        seen: list[taxel.Pressing | None] = []
        for _ in range(frames):
            self._time_us += FRAME_US
            said = None
            for event in self._board.step(self.fabric.codes(newtons), self._time_us):
                if isinstance(event, taxel.Pressing):
                    said = event
                elif isinstance(event, taxel.Answer) and event.refusal is not None:
                    raise RuntimeError(event.refusal)
            seen.append(said)
        return seen
