"""What the tests share: bodies with their worlds, and tables that pytest prints at its end."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
import pytest

from taxel_physics.places import BODIES, Places, places
from taxel_physics.presses import FORCES_N, Press, press, random_presses
from taxel_physics.robot import World, bent, reference
from taxel_physics.spread import Spread, spread
from taxel_physics.touch import Touch

PRESSES = 240
"""Presses at random on each body."""


@dataclass(frozen=True)
class Dressed:
    """A robot and its garment."""

    name: str
    world: World
    places: Places


@dataclass(frozen=True)
class Pressed:
    """A press, what the solver says of it, and what the taxels feel."""

    press: Press
    touch: Touch
    spread: Spread


@pytest.fixture(scope="session", params=["reference", "bent"])
def dressed(request: pytest.FixtureRequest) -> Dressed:
    """Both bodies, one after the other."""
    name = str(request.param)
    if name == "reference":
        return Dressed(name, World(reference()), places())
    return Dressed(name, World(bent()), places(BODIES / "bent.toml"))


@pytest.fixture(scope="session")
def pressed(dressed: Dressed) -> list[Pressed]:
    """What presses at random give on a body; those that slip past the link, or find no way, do not count."""
    found: list[Pressed] = []
    for attempt, each in enumerate(random_presses(dressed.places, dressed.world, seed=11)):
        assert attempt < 2 * PRESSES, "most presses must reach their link"
        if len(found) == PRESSES:
            break
        for touch in press(dressed.world, each) or []:
            # A robot that moves may press harder or more lightly than the object is pushed.
            if touch.by == each.by and FORCES_N[0] <= touch.newtons <= FORCES_N[1]:
                found.append(Pressed(each, touch, spread(dressed.world, dressed.places, touch)))
    return found


_tables: list[str] = []


def table(title: str, columns: Mapping[str, Iterable[float]], bars: Mapping[str, float]) -> None:
    """Adds a table of medians and worst values to pytest's summary; ``bars`` are what the worst may be."""
    lines = [title, f"  {'':34}{'median':>10}{'90 %':>10}{'worst':>10}{'bar':>10}"]
    for name, values in columns.items():
        each = np.asarray(list(values))
        numbers = [np.median(each), np.percentile(each, 90), each.max()]
        bar = f"{bars[name]:10.4g}" if name in bars else f"{'':>10}"
        lines.append(f"  {name:34}" + "".join(f"{number:10.4g}" for number in numbers) + bar)
    _tables.append("\n".join(lines))


def note(text: str) -> None:
    """Adds lines to pytest's summary."""
    _tables.append(text)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Prints the tables."""
    for text in _tables:
        terminalreporter.write_line("")
        terminalreporter.write_line(text)
