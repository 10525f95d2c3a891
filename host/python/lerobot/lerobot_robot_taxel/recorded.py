"""Observations of a recording, as a robot would have had them: for data sets of what was recorded before."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import taxel

from .touch import INTENTIONS, Seen
from .window import ROWS, Windows


def observations(
    recording: taxel.Recording, fps: int = 30, rows: int = ROWS, links: Iterable[str] = ()
) -> Iterator[Seen]:
    """``fps`` observations a second of the recording, each with all images since the one before.

    ``links`` are those whose forces are observed, of a board with a body. What comes after the last whole period is left
    out. While the board was lost, there is none.
    """
    windows, due_ns, names = Windows(rows), None, tuple(links)
    presses: dict[str, taxel.Wrench] = {}
    for event in recording:
        if isinstance(event, taxel.Pressing):
            presses = {one.link: one for one in event.links}
        if isinstance(event, taxel.Lost):
            windows, due_ns = Windows(rows), None
        if not isinstance(event, taxel.Frame) or event.image is None:
            continue
        period_ns = 1_000_000_000 // fps
        due_ns = event.host_ns + period_ns if due_ns is None else due_ns
        if event.host_ns >= due_ns and len(windows):
            concepts = event.intent.concepts
            felt = {name: float(concepts.get(name, 0.0)) for name in INTENTIONS}
            on_links = {link: presses.get(link) for link in names}
            yield Seen(windows.take(event.image.size), event.panels, felt, on_links)
            due_ns += period_ns
        windows.add(event.frame, event.time_us, event.image)
