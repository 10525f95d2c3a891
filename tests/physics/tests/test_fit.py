"""How a garment sits, found by ``taxel body fit`` from presses whose points the solver knows."""

from __future__ import annotations

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import taxel
from conftest import Dressed, table

from taxel_physics.fabric import FRAME_US, Fabric
from taxel_physics.places import BODIES, Array, Places, places
from taxel_physics.presses import press, random_presses
from taxel_physics.spread import spread

REFERENCE = Path(__file__).parents[3] / "host" / "taxel" / "bodies" / "reference.toml"
"""The body of that name, as a file."""

PRESSES = 100
"""Presses by which a garment is found."""

TIMES = 3
"""Times that a garment is put on, shifted and turned at random."""

SHIFT_M, TURN_DEG = 0.014, 5.0
"""How far it may be shifted to the right and down, and turned."""

BAR_MM = 2.0
"""How far a taxel may be from where it is said to be."""

SMALL = ("ball", "finger", "box")
"""Objects that touch; larger ones say less of a place."""

SETTLE, FRAMES = 4, 4
"""Frames in which the board's filter may wait, and frames of which the centroid is the mean."""


def put_on(text: str, rng: np.random.Generator) -> str:
    """The text of a body file whose panels are displaced."""
    lines = []
    for line in text.splitlines():
        lines.append(line)
        if line.startswith("[[patches]]"):
            right, down = rng.uniform(-SHIFT_M, SHIFT_M, 2)
            turn = rng.uniform(-TURN_DEG, TURN_DEG)
            lines.append(f"offset = {{ right = {right:.6f}, down = {down:.6f}, turn = {turn:.4f} }}")
    return "\n".join(lines)


class Feeling:
    """A board with the reference garment, and the fabric that it reads."""

    def __init__(self, seed: int) -> None:
        self._fabric = Fabric(2048, seed)
        self._board = taxel.VirtualBoard("reference")
        self._board.tare(frames=64)
        self._time_us = 0
        self._panels: list[str] = []
        self._hold(np.zeros(2048), 80)

    def feel(self, newtons: Array) -> tuple[str, float, float] | None:
        """Panel, column and row of the strongest contact under these forces (taxels,), N; none if there is none."""
        self._hold(np.zeros(2048), 12)
        found = [row for row in self._hold(newtons, SETTLE + FRAMES)[SETTLE:] if row is not None]
        if not found:
            return None
        panel = int(found[0][0])
        column, row = np.mean([each[1:] for each in found if each[0] == panel], axis=0)
        return self._panels[panel], float(column), float(row)

    def _hold(self, newtons: Array, frames: int) -> list[Array | None]:
        """Panel, x and y of the strongest contact of each frame."""
        seen: list[Array | None] = []
        for _ in range(frames):
            self._time_us += FRAME_US
            strongest = None
            for event in self._board.step(self._fabric.codes(newtons), self._time_us):
                if isinstance(event, taxel.Hello):
                    self._panels = [panel.name for panel in event.panels]
                elif isinstance(event, taxel.Contacts) and len(event.contacts) > 0:
                    best = event.contacts[np.argmax(event.contacts["total"])]
                    strongest = np.array([best["panel"], best["x"], best["y"]], np.float64)
            seen.append(strongest)
        return seen


def known_touches(dressed: Dressed, truly: Places, seed: int, file: Path) -> int:
    """Writes what the board feels of presses on a garment that lies at these places. Returns their number."""
    feeling = Feeling(seed)
    rows: list[tuple[str, float, float, str, float, float, float]] = []
    for each in random_presses(dressed.places, dressed.world, seed):
        if len(rows) == PRESSES:
            break
        if each.by not in SMALL or each.moves:
            continue
        for touch in press(dressed.world, each) or []:
            if touch.by != each.by:
                continue
            carried = spread(dressed.world, truly, touch)
            newtons = np.zeros(truly.taxels)
            newtons[carried.taxels] = carried.newtons
            felt = feeling.feel(newtons)
            # Beside the garment, nothing is felt.
            if felt is not None:
                panel, column, row = felt
                x, y, z = touch.point.tolist()
                rows.append((panel, column, row, touch.link, x, y, z))
    with file.open("w", newline="") as opened:
        writer = csv.writer(opened)
        writer.writerow(("panel", "column", "row", "link", "x", "y", "z"))
        writer.writerows(rows)
    return len(rows)


def test_a_displaced_garment_is_found_by_a_hundred_presses(dressed: Dressed, tmp_path: Path) -> None:
    body = REFERENCE if dressed.name == "reference" else BODIES / f"{dressed.name}.toml"
    rng = np.random.default_rng(5)
    before, after = [], []
    for time in range(TIMES):
        put = tmp_path / f"truly-{time}.toml"
        put.write_text(put_on(body.read_text(), rng))
        truly = places(put)
        touches, fitted = tmp_path / f"touches-{time}.csv", tmp_path / f"fitted-{time}.toml"
        assert known_touches(dressed, truly, 31 + time, touches) == PRESSES
        words = ["-m", "taxel", "body", "fit", str(body), "--touches", str(touches), "-o", str(fitted)]
        done = subprocess.run([sys.executable, *words], check=False, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        found = places(fitted)
        apart = [np.linalg.norm(each.at - truly.at, axis=1).max() * 1e3 for each in (dressed.places, found)]
        before.append(apart[0])
        after.append(apart[1])
    columns = {"as its file says, mm": before, "as fitted, mm": after}
    title = f"The taxel farthest from its place, body {dressed.name}, displaced at random {TIMES} times, {PRESSES} presses"
    table(title, columns, {"as fitted, mm": BAR_MM})
    assert max(after) < BAR_MM < min(before)
