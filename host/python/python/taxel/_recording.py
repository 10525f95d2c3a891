"""Recordings as arrays, by channel and time range."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any, NamedTuple, cast

import numpy as np
import numpy.typing as npt

from . import _taxel
from ._events import Contacts, Frame, Raw
from ._taxel import Event

_LAST = 2**64 - 1


class Message(NamedTuple):
    """A message as it was written."""

    topic: str
    #: the host's time, nanoseconds since 1970
    log_time: int
    #: the board's time, nanoseconds
    publish_time: int
    data: bytes


class Images(NamedTuple):
    """Images of a stretch of time."""

    #: the board's time of each, microseconds
    time_us: npt.NDArray[np.uint64]
    #: the host's time of each, nanoseconds since 1970
    host_ns: npt.NDArray[np.uint64]
    #: values by image and taxel
    values: npt.NDArray[np.uint16]


class Recording:
    """A recording: an MCAP file, read as it is iterated, however long it is.

    Of the recording of a robot, ``FILE#BOARD`` has the events of a board; messages, topics and attachments are
    those of the whole file.

    ``start`` and ``end`` of its methods are seconds from the beginning of the recording, both included.

    >>> import os, subprocess, sys, tempfile, taxel
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = os.path.join(folder.name, "pat.mcap")
    >>> record = ["record", "--source", "sim:pat", "--for", "2s", "-o", file]
    >>> _ = subprocess.run([sys.executable, "-m", "taxel", *record], check=True, capture_output=True)
    >>> pat = taxel.read(file)
    >>> pat.images(start=1.0, end=1.5).values.shape[1]
    2048
    >>> peak = max(int(event.contacts["total"].max()) for event in pat.contacts() if len(event.contacts))
    >>> peak > 5000
    True
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        found = _taxel.overview(self.path)
        #: Messages by topic.
        self.topics: dict[str, int] = {topic: one["count"] for topic, one in found["topics"].items()}
        #: The host's time of the first message, nanoseconds since 1970.
        self.start_ns: int = found["start_ns"]
        #: The host's time of the last message.
        self.end_ns: int = found["end_ns"]
        #: Names of the attachments.
        self.attachments: list[str] = found["attachments"]
        #: Versions, host, board, source.
        self.metadata: dict[str, dict[str, str]] = found["metadata"]
        #: False for a file without its end: ``taxel info --repair`` gives it one.
        self.is_whole: bool = found["is_whole"]

    @property
    def duration_s(self) -> float:
        """Seconds from the first message to the last."""
        return (self.end_ns - self.start_ns) / 1e9

    def _range(self, start: float | None, end: float | None) -> tuple[int, int]:
        first = self.start_ns + round(start * 1e9) if start is not None else 0
        last = self.start_ns + round(end * 1e9) if end is not None else _LAST
        return max(first, 0), max(last, 0)

    def _events(self, kinds: list[str], start: float | None, end: float | None) -> Iterator[Event]:
        return _taxel.RecordedEvents(self.path, kinds, *self._range(start, end))

    def __iter__(self) -> Iterator[Event]:
        return self._events([], None, None)

    def events(self, *, start: float | None = None, end: float | None = None) -> Iterator[Event]:
        """All events, in written order; ``host_ns`` is the log time."""
        return self._events([], start, end)

    def frames(self, *, start: float | None = None, end: float | None = None) -> Iterator[Frame]:
        """Images, and what touches."""
        return cast(Iterator[Frame], self._events(["frame"], start, end))

    def contacts(self, *, start: float | None = None, end: float | None = None) -> Iterator[Contacts]:
        """Lists of contacts."""
        return cast(Iterator[Contacts], self._events(["contacts"], start, end))

    def raw(self, *, start: float | None = None, end: float | None = None) -> Iterator[Raw]:
        """Raw codes, if they were recorded."""
        return cast(Iterator[Raw], self._events(["raw"], start, end))

    def images(self, *, start: float | None = None, end: float | None = None, raw: bool = False) -> Images:
        """The images of a stretch of time as one array, or the raw codes."""
        return Images(*_taxel.images(self.path, raw, *self._range(start, end)))

    def messages(
        self, topic: str | None = None, *, start: float | None = None, end: float | None = None
    ) -> Iterator[Message]:
        """Messages of a topic, or of all, as they were written."""
        found = _taxel.RecordedMessages(self.path, topic, *self._range(start, end))
        return (Message(*one) for one in found)

    def attachment(self, name: str) -> bytes | None:
        """An attachment; None if there is none of this name."""
        return _taxel.attachment(self.path, name)

    def __repr__(self) -> str:
        return f"Recording({self.path!r}, {self.duration_s:.3f} s, {sum(self.topics.values())} messages)"


def read(path: str | os.PathLike[str]) -> Recording:
    """Opens a recording, and reads what it holds but not its messages."""
    return Recording(path)


def features(frames: npt.ArrayLike, *, pressed: int = 0) -> npt.NDArray[np.uint16]:
    """The 127 features of a touch by which gestures are recognised, as integers of the board.

    ``frames`` are images of one panel, [n, rows, columns] or [rows, columns], in whole counts; a cell above
    ``pressed`` counts as touched.

    >>> import numpy as np, taxel
    >>> taxel.features(np.full((20, 8, 8), 100)).shape
    (127,)
    """
    whole = _whole(frames)
    return _taxel.features(whole[np.newaxis] if whole.ndim == 2 else whole, pressed)


def moments(image: npt.ArrayLike) -> dict[str, Any]:
    """Moments, Normalized Moment of Inertia and axis of one image, [rows, columns], in whole counts.

    >>> import numpy as np, taxel
    >>> line = np.zeros((3, 5), int)
    >>> line[1] = 4
    >>> found = taxel.moments(line)
    >>> found["m"], found["Jm"], found["column"], found["azimuth_rad"]
    (20, 800, 2.0, 0.0)
    """
    return _taxel.moments(_whole(image))


def _whole(values: npt.ArrayLike) -> npt.NDArray[np.uint16]:
    """The values as ``uint16``; a TypeError for others than whole numbers, never a silent wrap."""
    found = np.asarray(values)
    if found.dtype.kind not in "iu":
        raise TypeError(f"counts must be whole numbers, not {found.dtype}")
    if found.size and (found.min() < 0 or found.max() > 65535):
        raise _taxel.UsageError("counts must be 0 to 65535")
    return np.ascontiguousarray(found, np.uint16)
