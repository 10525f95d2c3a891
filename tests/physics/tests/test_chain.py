"""The bars after the chain: noise, whole codes, the board's own conditioning, and a calibration."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import Pressed, Dressed, table

from taxel_physics.fabric import FORCES, Chain, Fabric
from taxel_physics.places import Array
from taxel_physics.wrench import Wrench, off_line, reach, wrench

PITCH_M = 0.01
"""The reference garment's smaller pitch."""

FRAMES = 32
"""Images whose mean is compared: a sixth of a second."""

FORCE = "force, share of the solver's"
CENTER = "centre of pressure, pitches"
MOMENT = "moment, share of force x reach"
BARS = {FORCE: 0.03, CENTER: 0.2, MOMENT: 0.03}


SHIPPED = {FORCE: 0.15, CENTER: 0.2, MOMENT: 0.12}
"""The shipped scene misses the bars: its filter cuts crests by up to 0.06 N, and its floor the edges. It is
held to what it does, so that it gets no worse."""


@pytest.fixture(scope="module", params=["forces", "shipped"])
def chain(request: pytest.FixtureRequest) -> tuple[str, Chain]:
    """A board with a scene for forces, and one with the shipped scene."""
    name = str(request.param)
    return name, Chain(Fabric(2048, 21), scene=FORCES if name == "forces" else None)


def errors(dressed: Dressed, each: Pressed, felt_newtons: Array) -> list[float]:
    """Errors of one reading (taxels,), N, against the solver: force, centre, moment."""
    return differences(dressed, each, wrench(dressed.places, felt_newtons, each.touch.link))


def differences(dressed: Dressed, each: Pressed, felt: Wrench) -> list[float]:
    """Differences of a wrench from the solver's: force, centre, moment."""
    touch = each.touch
    true = touch.moment + np.cross(touch.point, touch.force)
    return [
        float(np.linalg.norm(felt.force - touch.force)) / touch.newtons,
        off_line(touch.force, touch.point, felt.center) / PITCH_M,
        float(np.linalg.norm(felt.moment - true)) / touch.newtons / reach(dressed.places, touch.link),
    ]


def test_links_feel_what_the_solver_says(
    dressed: Dressed, pressed: list[Pressed], chain: tuple[str, Chain]
) -> None:
    kind, through = chain
    means, singles, forces, beyond = [], [], [], 0
    for each in pressed:
        newtons = np.zeros(dressed.places.taxels)
        newtons[each.spread.taxels] = each.spread.newtons
        if through.fabric.is_full(newtons).any():
            # The converter's range ends below the force: no chain can report more than "at least".
            beyond += 1
            continue
        readings = through.read(newtons, FRAMES)
        means.append(errors(dressed, each, readings.mean(axis=0)))
        singles.append(errors(dressed, each, readings[0]))
        forces.append(each.touch.newtons)
    columns = dict(zip(BARS, np.array(means).T, strict=True))
    title = f"After the chain, body {dressed.name}, scene {kind}, {len(means)} presses, mean of {FRAMES} images"
    table(f"{title} ({beyond} more press a taxel beyond the converter's range)", columns, BARS)
    table("  the same in one image", dict(zip(BARS, np.array(singles).T, strict=True)), {})
    for low, high in ((0.5, 1.0), (1.0, 2.0), (2.0, 5.0), (5.0, 40.0)):
        chosen = [at for at, newtons in enumerate(forces) if low <= newtons < high]
        if chosen:
            title = f"  mean of {FRAMES} images, {len(chosen)} presses of {low} to {high} N"
            table(title, dict(zip(BARS, np.array(means)[chosen].T, strict=True)), BARS)
    assert len(means) >= 100
    held = SHIPPED if kind == "shipped" else BARS
    for (name, bar), values in zip(held.items(), np.array(means).T, strict=True):
        assert values.max() < bar, name
