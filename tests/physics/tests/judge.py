"""Judges what a board has learned of folds: false contacts while joints move, and touches meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import taxel
from taxel.folds import Sweep, learn

from taxel_physics.fabric import FRAME_US
from taxel_physics.folding import PRESSES_IN_S, Folding, Folds, Moment, fingertip, random_motion, scans_in
from taxel_physics.places import Array, Places

COMPARED_S = 0.2
"""Time from one comparison of expected and measured pressure to the next."""

TOUCH_S, APART_S = 0.6, 0.4
"""Length of a touch, and the time between two."""

SETTLES_S = 0.2
"""Time after the onset of a touch from which on its force counts."""

PRESSED = 50
"""Counts from which on a fold presses on a taxel."""


@dataclass(frozen=True)
class Learned:
    """A garment that folds, and the table of its folds."""

    name: str
    places: Places
    table: Path
    garment: str | Path = "reference"
    scan_us: int = FRAME_US
    folds: Callable[[int], Folds] | None = None
    """What folds on a day, if it is not the creases of the elbows."""

    def day(self, day: int, knows: bool = True) -> Folding:
        """A board on one of the days that are judged; one that knows of no folds, if it should not."""
        return self._folding(day, 1000 + day, self.table if knows else None)

    def motion(self, day: int, seconds: float) -> Array:
        """(scans, joints) Angles of the joints, another motion each day."""
        joints = len(self.folds(day).joints) if self.folds else 2
        return random_motion(joints, seconds, 2000 + day, self.scan_us)

    def sweep(self, day: int, seconds: float) -> Sweep:
        """What a board that knows of no folds feels on a day."""
        folding = self._folding(day, 50 + day, None)
        moments = [
            (moment.known, moment.frame.image) for moment in folding.run(self.motion(day, seconds))
        ]
        degrees = np.degrees([known for known, _ in moments])
        felt = np.array([image for _, image in moments], np.uint16)
        return Sweep(dict(zip(folding.joints, degrees.T, strict=True)), felt)

    def learn(self, days: Iterable[int], seconds: float, shifts_mm: Iterable[float] = (30.0,)) -> float:
        """Writes the table, of sweeps of so many seconds on these days.

        It is that of the first of these shifts, mm, which is returned, for which a board has room.
        """
        sweeps = [self.sweep(day, seconds) for day in days]
        refused: taxel.Error | None = None
        for shift_mm in shifts_mm:
            try:
                learn(sweeps, garment=str(self.garment), shift_mm=shift_mm).save(self.table)
            except taxel.Error as error:
                refused = error
            else:
                return shift_mm
        raise refused or ValueError("no shift")

    def _folding(self, day: int, seed: int, table: Path | None) -> Folding:
        return Folding(
            self.places,
            day=day,
            seed=seed,
            table=table,
            folds=self.folds(day) if self.folds else None,
            garment=self.garment,
            scan_us=self.scan_us,
        )


@dataclass
class Day:
    """What a board said while the joints moved and nothing touched."""

    scan_us: int = FRAME_US
    contacts: set[int] = field(default_factory=set)
    """Ids of false contacts."""
    false_scans: int = 0
    """Scans with a false contact."""
    scans: int = 0
    intentions: set[str] = field(default_factory=set)
    pairs: list[Array] = field(default_factory=list)
    """(5, n) Of taxels that fold at some moments: time, s; taxel; expected, measured, doubt, counts."""

    def note(self, moment: Moment) -> None:
        """Counts a scan."""
        self.contacts.update(moment.frame.contacts["id"].tolist())
        self.false_scans += len(moment.frame.contacts) > 0
        self.scans += 1
        self.intentions.add(moment.leading)

    def compare(self, folding: Folding, moment: Moment) -> None:
        """Notes what the board expects and what the folds press, wherever one of them is something."""
        taxels, expected, doubt = folding.board.folds()
        measured = folding.counts(moment.folds)
        # What presses on a taxel that the table has not is expected to be nothing.
        all_expected, all_doubts = np.zeros((2, len(measured)))
        all_expected[taxels], all_doubts[taxels] = expected, doubt
        on = np.flatnonzero((all_expected > 0.0) | (measured > 0.0))
        time = np.full(len(on), moment.time_s)
        self.pairs.append(np.array([time, on, all_expected[on], measured[on], all_doubts[on]]))

    @property
    def share(self) -> float:
        """Share of the scans with a false contact."""
        return self.false_scans / self.scans

    @property
    def per_minute(self) -> float:
        """False contacts a minute."""
        return len(self.contacts) / (self.scans / scans_in(60.0, self.scan_us))


def untouched(learned: Learned, day: int, knows: bool, seconds: float) -> Day:
    """A day on which nothing touches."""
    folding, seen = learned.day(day, knows), Day(learned.scan_us)
    compared = scans_in(COMPARED_S, learned.scan_us)
    for scan, moment in enumerate(folding.run(learned.motion(day, seconds))):
        seen.note(moment)
        if knows and scan % max(1, compared) == 0:
            seen.compare(folding, moment)
    return seen


@dataclass
class Felt:
    """A fingertip on the garment, and what the board said of it."""

    time_s: float
    """Of its onset."""
    newtons: float
    where: str
    """Of its taxels: ``pressed`` by a fold at its onset, ``folding`` but not pressed, or ``elsewhere``."""
    forces: Array
    """(taxels,) N."""
    found: bool = False
    full: bool = False
    """True if a taxel came to the end of its range."""
    said: list[tuple[float, float]] = field(default_factory=list)
    """Total of its contact as a share of the true one, and the doubt of it as a share; at each report."""


class Touching:
    """A board that is touched by a fingertip, again and again, while its joints move."""

    def __init__(self, learned: Learned, folding: Folding, seed: int, newtons: tuple[float, float]) -> None:
        self._places, self._folding, self._newtons = learned.places, folding, newtons
        self._rng = np.random.default_rng(seed)
        taxels = folding.board.folds()[0]
        self._folds = np.zeros(learned.places.taxels, bool)
        self._folds[taxels] = True
        self._kinds = ["pressed", "folding", "elsewhere"]
        # A small garment may have no taxel that is out of the folds' reach.
        apart = np.flatnonzero(~self._folds)
        if not any(self._is_apart(fingertip(self._places, int(taxel), 1.0)) for taxel in apart):
            self._kinds.remove("elsewhere")
        self._next_s = 2.0

    def run(self, angles: Array) -> Iterator[tuple[Moment, Felt | None]]:
        """Each moment, and the touch that ended with it."""
        touch: Felt | None = None
        for moment in self._folding.run(angles):
            ended = None
            if touch is None:
                if moment.time_s >= self._next_s:
                    touch = self._begin(moment)
            else:
                self._note(touch, moment)
                since = moment.time_s - touch.time_s
                if since >= TOUCH_S:
                    ended, touch, self._next_s = touch, None, moment.time_s + APART_S
                    self._folding.touch = np.zeros(len(self._folds))
                else:
                    self._folding.touch = min(since / PRESSES_IN_S, 1.0) * touch.forces
            yield moment, ended

    def _begin(self, moment: Moment) -> Felt:
        """A touch at random: where a fold presses, where one may, or elsewhere."""
        pressed = self._folding.counts(moment.folds) >= PRESSED
        kind = self._rng.choice(self._kinds)
        allowed = {
            "pressed": self._folds & pressed,
            "folding": self._folds & ~pressed,
            "elsewhere": ~self._folds,
        }
        newtons = self._rng.uniform(*self._newtons)
        while True:
            # Where no fold presses now, the next best.
            taxels = np.flatnonzero(allowed[kind] if allowed[kind].any() else allowed["folding"])
            center = int(self._rng.choice(taxels))
            forces = fingertip(self._places, center, newtons)
            if kind != "elsewhere" or self._is_apart(forces):
                break
        where = "elsewhere" if kind == "elsewhere" else "pressed" if pressed[center] else "folding"
        return Felt(moment.time_s, float(newtons), where, forces)

    def _is_apart(self, forces: Array) -> bool:
        """True for forces (taxels,) that reach into no fold: a fingertip beside a fold does."""
        return not self._folds[forces > 0.0].any()

    def _note(self, touch: Felt, moment: Moment) -> None:
        """Looks for the contact of a touch, and what is said of its force."""
        panels = list(moment.frame.panels.values())
        bases = np.cumsum([0] + [panel.size for panel in panels])
        touch.full |= bool(self._folding.fabric.is_full(moment.folds + self._folding.touch).any())
        for contact in moment.frame.contacts:
            panel = int(contact["panel"])
            peak = contact["peak_row"] * panels[panel].shape[1] + contact["peak_column"]
            if touch.forces[bases[panel] + int(peak)] == 0.0:
                continue
            touch.found = True
            if moment.said is None or moment.time_s - touch.time_s < SETTLES_S:
                continue
            doubts = {each["id"]: each["doubt"] for each in moment.said.contacts}
            true = self._folding.counts(touch.forces).sum()
            doubt = doubts.get(int(contact["id"]), 0)
            touch.said.append((float(contact["total"] / true), float(doubt / true)))


def r(pairs: Array) -> float:
    """Correlation of expected and measured pressure."""
    return float(np.corrcoef(pairs[2], pairs[3])[0, 1])


def touched(
    learned: Learned, newtons: tuple[float, float], days: Iterable[int], seconds: float, sent: bool = True
) -> list[Felt]:
    """Touches on these days; those that take a taxel to the end of its range do not count."""
    felt = []
    for day in days:
        folding = learned.day(day)
        folding.sent = sent
        touching = Touching(learned, folding, seed=3000 + day, newtons=newtons)
        felt += [touch for _, touch in touching.run(learned.motion(day, seconds)) if touch is not None]
    whole = [touch for touch in felt if not touch.full]
    assert len(whole) > 0.9 * len(felt)
    return whole


@dataclass(frozen=True)
class Verdict:
    """How well folds are distinguished from touches, over some days."""

    taxels: int
    """Taxels in the table."""
    without: float
    """Share of scans with a false contact without compensation."""
    left: float
    """Share of these that compensation leaves."""
    contacts: int
    """False contacts that it leaves."""
    intentions: int
    """Days on which one meant something."""
    unlike: float
    """What the correlation of expected and measured pressure lacks of 1."""
    inside: list[Felt]
    elsewhere: list[Felt]

    def found(self, touches: list[Felt]) -> str:
        """How many of them were found."""
        return f"{sum(touch.found for touch in touches)}/{len(touches)}"

    @property
    def missed(self) -> tuple[float, int]:
        """Share of the touches inside folds that were missed, and number of the missed ones elsewhere."""
        inside = np.mean([not touch.found for touch in self.inside])
        return float(inside), sum(not touch.found for touch in self.elsewhere)

    def known(self, off: float) -> float:
        """Share of the reports of touches inside folds whose force is off by no more than that or the doubt."""
        said = [each for touch in self.inside for each in touch.said]
        return float(np.mean([abs(share - 1.0) <= max(off, doubt) for share, doubt in said]))

    @property
    def doubt(self) -> float:
        """Median doubt of a touch inside folds, N."""
        return float(np.median([doubt * touch.newtons for touch in self.inside for _, doubt in touch.said]))

    def line(self, off: float) -> str:
        """A row of the table."""
        return (
            f"{self.taxels:7}{self.without:9.3f}{self.left:9.4f}{self.contacts:9}{self.intentions:7}"
            f"{self.unlike:9.4f}{self.found(self.inside):>9}{self.found(self.elsewhere):>9}"
            f"{self.known(off):9.3f}{self.doubt:9.2f}"
        )


COLUMNS = (
    f"{'taxels':>7}{'without':>9}{'left':>9}{'contacts':>9}{'meant':>7}{'1 - r':>9}{'inside':>9}{'else':>9}"
    f"{'force':>9}{'doubt N':>9}"
)
"""Heads of the columns of :meth:`Verdict.line`."""


def judged(
    learned: Learned, days: range, seconds: float, newtons: tuple[float, float], touched_s: float
) -> Verdict:
    """Judges a garment on these days: without touches for so many seconds each, then with touches."""
    before = [untouched(learned, day, False, seconds) for day in days]
    after = [untouched(learned, day, True, seconds) for day in days]
    felt = touched(learned, newtons, days, touched_s)
    shares = [np.mean([day.share for day in each]) for each in (before, after)]
    return Verdict(
        taxels=len(learned.day(days[0]).board.folds()[0]),
        without=float(shares[0]),
        left=float(shares[1] / shares[0]),
        contacts=sum(len(day.contacts) for day in after),
        intentions=sum(day.intentions != {"none"} for day in after),
        unlike=1.0 - r(np.hstack([np.concatenate(day.pairs, axis=1) for day in after])),
        inside=[touch for touch in felt if touch.where != "elsewhere"],
        elsewhere=[touch for touch in felt if touch.where == "elsewhere"],
    )
