"""From newtons on taxels to codes, and through the board back to newtons.

A fabric is what the simulated garment of ``taxel`` is by default, with a spread of gains: a code at rest with
its spread, so many counts a newton, noise on every sample, whole codes of 12 bits. The board is the very one,
with its tare, floor, filter and drift tracking. Gains are found from raw codes by known weights on whole
panels, as by ``taxel calibrate``, and used on the host: ``taxel.VirtualBoard`` takes no calibration.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
import taxel

Array = npt.NDArray[np.float64]

FRAME_US = 5_128
"""Time from scan to scan of the reference board."""

UNITY = 4096
"""A gain of 1 on the board: gains are whole multiples of 1/4096."""

FULL_SCALE = 4095
"""Highest code."""

WEIGHTS_N = (0.25, 0.5, 1.0, 1.5, 2.0)
"""Forces on each taxel by which the calibration is found."""

FORCES = Path(__file__).parent / "forces.toml"
"""A scene in which forces keep their sum."""

TOUCHED = 18
"""Counts from which on a taxel is touched: six times the noise."""


@dataclass(frozen=True)
class Sensor:
    """What taxels make of force, counts; the same keys and values as in a script of touches of ``taxel``."""

    base_code: float = 90.0
    spread_counts: float = 10.0
    noise_counts: float = 3.0
    gain_spread: float = 0.1
    counts_per_newton: float = 1000.0


class Fabric:
    """Taxels of a garment: each has a rest code and a gain of its own."""

    def __init__(self, taxels: int, seed: int, sensor: Sensor | None = None) -> None:
        self.sensor = sensor or Sensor()
        self._rng = np.random.default_rng(seed)
        self.rest = np.maximum(
            self._rng.normal(self.sensor.base_code, self.sensor.spread_counts, taxels), 0.0
        )
        self.gain = np.maximum(self._rng.normal(1.0, self.sensor.gain_spread, taxels), 0.0)

    def is_full(self, newtons: Array) -> npt.NDArray[np.bool_]:
        """(taxels,) True where a force (taxels,), N, is more than a code can say."""
        return self._signal(newtons) > FULL_SCALE - 3.0 * self.sensor.noise_counts

    def codes(self, newtons: Array) -> npt.NDArray[np.uint16]:
        """(taxels,) Codes of one scan at these forces (taxels,), N."""
        signal = self._signal(newtons)
        noisy = signal + self._rng.normal(0.0, self.sensor.noise_counts, len(signal))
        return np.clip(np.round(noisy), 0, FULL_SCALE).astype(np.uint16)

    def _signal(self, newtons: Array) -> Array:
        """(taxels,) Counts without noise and without an end."""
        return self.rest + self.sensor.counts_per_newton * self.gain * newtons


class Chain:
    """A fabric, the very board that reads it, and the calibration that makes newtons of its counts."""

    def __init__(self, fabric: Fabric, garment: str = "reference", scene: str | Path | None = FORCES) -> None:
        """Tares the board, which has the shipped scene if none is given, and calibrates."""
        self.fabric = fabric
        self._board = taxel.VirtualBoard(garment, scene)
        self._nothing = np.zeros(self._board.taxels)
        self._time_us = 0
        self._board.tare(frames=64)
        self._board.set_raw()
        self._hold(self._nothing, 80)
        self.gains, self.newtons_per_count = self._calibrate()

    def read(self, newtons: Array, frames: int, settle: int = 4) -> Array:
        """(frames, taxels) Forces that the board reports while the fabric bears ``newtons`` (taxels,), N.

        Only taxels that are touched count, and those beside them: noise that passes the floor elsewhere would
        add up over a link. The fabric is at rest before; the first ``settle`` frames, in which a filter may
        wait, are left out.
        """
        self._hold(self._nothing, 10)
        frames_seen, _ = self._hold(newtons, settle + frames)
        scale = self.gains / UNITY * self.newtons_per_count
        return np.array([touched(frame) * scale for frame in frames_seen[settle:]])

    def _hold(self, newtons: Array, frames: int) -> tuple[list[taxel.Frame], list[Array]]:
        """The board's images, and raw codes (taxels,) of each, while the fabric bears this."""
        seen: list[taxel.Frame] = []
        raw: list[Array] = []
        for _ in range(frames):
            self._time_us += FRAME_US
            for event in self._board.step(self.fabric.codes(newtons), self._time_us):
                if isinstance(event, taxel.Frame) and event.image is not None:
                    seen.append(event)
                elif isinstance(event, taxel.Raw) and event.codes is not None:
                    raw.append(event.codes.astype(np.float64))
        if len(seen) != frames:
            raise RuntimeError(f"{len(seen)} images of {frames} scans")
        return seen, raw

    def _calibrate(self, frames: int = 64) -> tuple[Array, float]:
        """Gain of each taxel (taxels,), in 1/4096 as the board has them, and newtons a count after the gains.

        The method is that of ``taxel calibrate``, whose curve is a straight line for these taxels: weights of
        which each taxel bears an even share, and least squares.
        """
        rest = np.mean(self._hold(self._nothing, 4 * frames)[1], axis=0)
        felt = []
        for weight in WEIGHTS_N:
            raw = self._hold(np.full(len(rest), weight), frames)[1]
            felt.append(np.mean(raw, axis=0) - rest)
        counts, weights = np.array(felt), np.array(WEIGHTS_N)[:, None]
        newtons_per_count: Array = (weights * counts).sum(axis=0) / (counts**2).sum(axis=0)
        scale = float(newtons_per_count.mean())
        return np.round(newtons_per_count / scale * UNITY), scale


def touched(frame: taxel.Frame) -> Array:
    """(taxels,) Counts of an image under touches and beside them; 0 elsewhere."""
    parts = []
    for image in frame.panels.values():
        above = np.pad(image >= TOUCHED, 1)
        rows, columns = image.shape
        near = np.zeros(image.shape, bool)
        for down in range(3):
            for right in range(3):
                near |= above[down : down + rows, right : right + columns]
        parts.append((image * near).ravel())
    return np.concatenate(parts).astype(np.float64)
