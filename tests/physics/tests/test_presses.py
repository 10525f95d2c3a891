"""The bars before noise: what the taxels feel is what the solver says."""

from __future__ import annotations

import numpy as np
from conftest import Pressed, Dressed, table

from taxel_physics.robot import OBJECTS
from taxel_physics.wrench import off_line, reach, wrench

PITCH_M = 0.01
"""The reference garment's smaller pitch."""

FORCE = "force, share of the solver's"
CENTER = "centre of pressure, pitches"
MOMENT = "moment, share of force x reach"


def test_forces_and_centres_are_the_solvers(dressed: Dressed, pressed: list[Pressed]) -> None:
    force: list[float] = []
    center, moment, sunk, carried = list(force), list(force), list(force), list(force)
    for each in pressed:
        newtons = np.zeros(dressed.places.taxels)
        newtons[each.spread.taxels] = each.spread.newtons
        assert newtons.min() >= 0.0
        felt, touch = wrench(dressed.places, newtons, each.touch.link), each.touch
        force.append(float(np.linalg.norm(felt.force - touch.force)) / touch.newtons)
        center.append(off_line(touch.force, touch.point, felt.center) / PITCH_M)
        true = touch.moment + np.cross(touch.point, touch.force)
        moment.append(
            float(np.linalg.norm(felt.moment - true)) / touch.newtons / reach(dressed.places, touch.link)
        )
        sunk.append(float(np.linalg.norm(felt.center - touch.point)) * 1e3)
        carried.append(float((each.spread.newtons > 0.01 * each.spread.newtons.max()).sum()))
    columns = {
        FORCE: force,
        CENTER: center,
        MOMENT: moment,
        "centre from solver's point, mm": sunk,
        "taxels that carry it": carried,
        "solver's force, N": [each.touch.newtons for each in pressed],
    }
    bars = {FORCE: 1e-3, CENTER: 0.1}
    still = sum(not each.press.moves for each in pressed)
    presses = f"{still} presses on a still robot, {len(pressed) - still} on a moving one"
    title = f"Before noise, body {dressed.name}: {presses}"
    table(title, columns, bars)
    assert len(pressed) >= 200
    assert {each.press.by for each in pressed} == set(OBJECTS)
    assert {each.touch.link for each in pressed} == set(dressed.places.links)
    assert max(force) < bars[FORCE]
    assert max(center) < bars[CENTER]


def test_robots_that_move_do_move(dressed: Dressed, pressed: list[Pressed]) -> None:
    """On a robot that is still, the solver's force is the push along the object's direction."""
    ratio: dict[bool, list[float]] = {True: [], False: []}
    for each in pressed:
        toward = each.press.toward / np.linalg.norm(each.press.toward)
        ratio[each.press.moves].append(abs(float(each.touch.force @ toward) / each.press.newtons - 1.0))
    assert np.median(ratio[False]) < 0.01
    assert np.median(ratio[True]) > 2 * np.median(ratio[False])
