"""The board's own words on forces by link, against the solver: the shipped scene, noise, codes, gains."""

from __future__ import annotations

import numpy as np
from conftest import Pressed, Dressed, table
from test_chain import BARS, FRAMES, differences

from taxel_physics.fabric import Fabric
from taxel_physics.felt import Felt
from taxel_physics.places import BODIES


def test_the_board_says_what_the_solver_says(dressed: Dressed, pressed: list[Pressed]) -> None:
    body = "reference" if dressed.name == "reference" else BODIES / f"{dressed.name}.toml"
    felt = Felt(Fabric(2048, 21), body)
    rows, missed, beyond = [], 0, 0
    for each in pressed:
        newtons = np.zeros(dressed.places.taxels)
        newtons[each.spread.taxels] = each.spread.newtons
        if felt.fabric.is_full(newtons).any():
            beyond += 1
            continue
        said = felt.read(newtons, each.touch.link, FRAMES)
        if said is None:
            missed += 1
        else:
            rows.append(differences(dressed, each, said))
    columns = dict(zip(BARS, np.array(rows).T, strict=True))
    left = f"{beyond} beyond the converter's range, {missed} not felt"
    title = f"The board's words, body {dressed.name}, scene shipped, {len(rows)} presses"
    table(f"{title}, mean of {FRAMES} frames ({left})", columns, BARS)
    assert missed == 0 and len(rows) >= 100
    # Nine of ten: the scene that ships drops the faint edge of a small press.
    for name, bar in BARS.items():
        assert np.percentile(columns[name], 90) < bar, name
