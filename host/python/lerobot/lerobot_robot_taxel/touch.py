"""A garment that is read in the background, and asked once for each observation."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from types import TracebackType
from typing import Protocol

import numpy as np
import numpy.typing as npt
import taxel

from .window import ROWS, Window, Windows

#: Longest wait for the first image, s.
PATIENCE = 10.0
INTENTIONS = ("kindness", "threat", "attack")


class Stream(Iterable[taxel.Event], Protocol):
    """Events that can be closed, `taxel.open` say."""

    def close(self) -> None: ...


class Seen:
    """Content of an observation."""

    def __init__(
        self,
        window: Window,
        panels: dict[str, npt.NDArray[np.uint16]],
        felt: dict[str, float],
        presses: dict[str, taxel.Wrench | None],
    ) -> None:
        #: All images since the last observation.
        self.window = window
        #: The last image by panel.
        self.panels = panels
        #: Activations of the intentions.
        self.felt = felt
        #: What presses on each link, as `taxel.Pressing.links` have it; none where nothing does.
        self.presses = presses


class Touch:
    """Reads a garment in a thread of its own, which waits without holding up others."""

    def __init__(
        self, open_stream: Callable[[], Stream], rows: int = ROWS, links: Iterable[str] = ()
    ) -> None:
        self._open = open_stream
        #: Links of the robot whose forces are observed: of a board with a body.
        self.links = tuple(links)
        self._presses: dict[str, taxel.Wrench] = {}
        self._windows = Windows(rows)
        self._news = threading.Condition()
        self._frame: taxel.Frame | None = None
        self._panels: dict[str, tuple[int, int]] = {}
        #: True of a simulated garment, once it has sent its panels.
        self.simulated = False
        self._felt = dict.fromkeys(INTENTIONS, 0.0)
        self._error: BaseException | None = None
        #: Why the board is lost; None while it is there.
        self._lost: str | None = None
        self._stream: Stream | None = None
        self._thread: threading.Thread | None = None

    def connect(self) -> None:
        """Opens the garment, and waits for its first image."""
        self._stream = self._open()
        self._thread = threading.Thread(target=self._read, args=(self._stream,), daemon=True)
        self._thread.start()
        with self._news:
            came = self._news.wait_for(lambda: self._frame or self._error, PATIENCE)
        if self._error:
            raise self._error
        if not came:
            self.disconnect()
            raise taxel.BoardError(f"no image came within {PATIENCE:.0f} s")

    def disconnect(self) -> None:
        """Closes the garment."""
        if self._stream:
            self._stream.close()
        if self._thread:
            self._thread.join(5)
        self._stream = self._thread = None

    @property
    def is_connected(self) -> bool:
        """True while the garment is open."""
        return self._stream is not None

    def _read(self, stream: Stream) -> None:
        try:
            for event in stream:
                self._take(event)
        except BaseException as error:  # it is raised where it is noticed
            with self._news:
                self._error = error
                self._news.notify_all()

    def _take(self, event: taxel.Event) -> None:
        if isinstance(event, taxel.Hello):
            self._panels = {one.name: (one.rows, one.columns) for one in event.panels}
            self.simulated = event.simulated
        if isinstance(event, taxel.Lost):
            with self._news:
                # Images from before are not those of the next observation.
                self._lost, self._windows = event.why, Windows(self._windows.rows)
        if isinstance(event, taxel.Pressing):
            with self._news:
                self._presses = {one.link: one for one in event.links}
        if not isinstance(event, taxel.Frame) or event.image is None:
            return
        with self._news:
            self._windows.add(event.frame, event.time_us, event.image)
            self._frame, self._lost = event, None
            concepts = event.intent.concepts
            self._felt = {name: float(concepts.get(name, 0.0)) for name in INTENTIONS}
            self._news.notify_all()

    def observe(self) -> Seen:
        """All that has come since the last call. An error of the stream is raised here, and that the board is lost: a
        touch that nobody feels is no observation. From its first image on after it is back, there are observations
        again."""
        with self._news:
            if self._error:
                raise self._error
            if self._lost:
                raise taxel.BoardError(self._lost)
            frame = self._frame
            if frame is None or frame.image is None:
                raise taxel.BoardError("the garment is not connected")
            presses = {link: self._presses.get(link) for link in self.links}
            return Seen(self._windows.take(frame.image.size), frame.panels, dict(self._felt), presses)

    @property
    def panels(self) -> dict[str, tuple[int, int]]:
        """Rows and columns of each panel. Before it is connected, the garment is opened briefly to ask for
        them: LeRobot makes its data set before it connects."""
        if not self._panels:
            self._ask()
        return self._panels

    def _ask(self) -> None:
        stream = self._open()
        end = threading.Timer(PATIENCE, stream.close)
        end.start()
        for event in stream:
            if isinstance(event, taxel.Hello):
                self._take(event)
                break
        end.cancel()
        stream.close()
        if not self._panels:
            raise taxel.BoardError(f"the board did not report its garment within {PATIENCE:.0f} s")

    @property
    def waiting(self) -> int:
        """Images that wait for the next windows."""
        return len(self._windows)

    def __enter__(self) -> Touch:
        self.connect()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.disconnect()
