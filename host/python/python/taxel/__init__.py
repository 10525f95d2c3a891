"""Touch on a robot's tactile garment: live, recorded, simulated.

>>> import taxel
>>> with taxel.open("sim:pat", frames=3) as board:
...     frames = [event for event in board if isinstance(event, taxel.Frame)]
>>> frames[0].panels["back"].shape
(32, 16)

``taxel.open`` iterates over the events of a board, ``taxel.VirtualBoard`` is the board itself, ``taxel.Source`` an
array that a program reads, ``taxel.read`` reads recordings, ``taxel.features`` and ``taxel.fcm`` are what it
understands with. Documentation: docs/guides/python.md of the project.
"""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from types import TracebackType
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from . import _events, _taxel, fcm, folds
from ._events import *
from ._recording import Images, Message, Recording, _whole, features, moments, read
from ._requests import Requests
from ._taxel import (
    CONTACT,
    MOMENT,
    BoardError,
    Error,
    Event,
    Garment,
    Moment,
    Motion,
    MotionCommand,
    MotionTouch,
    TouchDecision,
    TouchModel,
    UsageError,
    __version__,
)

_taxel._set_event_classes(_events.CLASSES)

__all__ = [
    "CONTACT",
    "MOMENT",
    "Board",
    "BoardError",
    "Error",
    "Event",
    "Garment",
    "Images",
    "Message",
    "Moment",
    "Motion",
    "MotionCommand",
    "MotionTouch",
    "Recording",
    "Requests",
    "Robot",
    "Source",
    "TouchDecision",
    "TouchModel",
    "UsageError",
    "VirtualBoard",
    "VirtualRobot",
    "__version__",
    "fcm",
    "features",
    "folds",
    "moments",
    "open",
    "open_robot",
    "read",
    *_events.__all__,
]


def __dir__() -> list[str]:
    return sorted(__all__)


class Board(_taxel.Board, Requests):
    """An open board: an iterator over its events, to be used with ``with``."""

    def set_joints(
        self, positions: Mapping[str, float], host_ns: int | None = None, *, time_us: int | None = None
    ) -> None:
        """Sends positions of the robot's joints, rad or m, by name.

        They were read at ``host_ns``, the host's time (nanoseconds since 1970, as of ``time.time_ns()``), or at
        ``time_us``, the board's; without either, now. They may come late and joint by joint. The board gets poses of
        the links that carry the garment as long as they come. Before the board has sent its time they are passed over.
        """
        by_name = {joint: float(position) for joint, position in positions.items()}
        super()._set_joints(by_name, host_ns, time_us)

    def __enter__(self) -> Board:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class Robot(_taxel.Robot):
    """An open robot: an iterator over the events of all its boards, to be used with ``with``.

    Each event has the name of its ``board``. ``tare``, ``set_scene`` and ``self_test`` are for all boards, or for the
    one of this name; a board that is lost gets them once it is back. ``set_input`` and ``set_joints`` send the
    robot's map what others know, and how the robot moves.

    Opened with ``keep``, it has what its boards have said lately, by the name of the board: ``frames`` the newest image
    until a time, ``contacts`` the contacts at a time, interpolated between two scans. ``host_ns`` is the time that all
    boards share, as in events; without it, it is the newest that all boards have reported. They know what has been read.
    A board that is lost, or has said nothing until then, has None.

    >>> import taxel
    >>> with taxel.open_robot("robot.toml", keep=1.0) as robot:  # doctest: +SKIP
    ...     for event in robot:
    ...         images = {name: frame.image for name, frame in robot.frames().items() if frame}
    """

    def set_scene(self, path_or_text: str | os.PathLike[str], *, board: str | None = None) -> None:
        """Sends a scene: a TOML file, or its text. Missing keys have the shipped scene's values."""
        super()._set_scene(os.fspath(path_or_text), board=board)

    def __enter__(self) -> Robot:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class VirtualRobot(_taxel.VirtualRobot):
    """The very boards of a robot and its map, stepped by hand: the codes of a scan and a time in, meanings out.

    ``path`` is a robot's file; its boards need a ``garment``, and their sources are not opened. All go by the time of
    the steps. ``step`` gives a ``RobotIntent`` when touches mean something else than before.

    >>> import numpy as np, taxel
    >>> robot = taxel.VirtualRobot("robot.toml")  # doctest: +SKIP
    >>> robot.set_joints({"left_elbow": 0.5}, 0)  # doctest: +SKIP
    >>> robot.step("torso", np.full(robot.taxels("torso"), 100, np.uint16), 5000)  # doctest: +SKIP
    """

    def touches(self) -> list[RobotTouch]:
        """Contacts on the robot now: ``board`` (its number), ``contact``, ``region``, ``link``, ``load``.

        ``mover`` is ``own`` if the robot's own motion has caused the touch, ``other`` or ``unsure``; ``approach`` is how
        the robot's surface moved before the onset, if that is known: ``normal_m_s`` outwards, ``speed_m_s`` in all.
        """
        return [RobotTouch(touch) for touch in super()._touches()]


class VirtualBoard(_taxel.VirtualBoard, Requests):
    """The very board, stepped by hand: the codes of a scan and a time in, events out. Nothing waits.

    - ``garment``: a ``Garment``, the name of a preset, or a TOML file
    - ``scene``: a TOML file or its text; by default the one that ships
    - ``full_scale``: code of a full scan, 1 to 65535: 255 of an array of 8 bits. Counts are those of 12 bits, 0 to 4095
    - ``counts_per_newton``: gain of a taxel, if it is known: contacts then have a ``force_n``
    - ``record``: path of a recording, complete once the board is closed; ``overwrite`` replaces an existing file
    - ``view``: shows the board in the browser, at its ``page``

    Requests reach it with the next step.

    >>> import numpy as np, taxel
    >>> board = taxel.VirtualBoard(taxel.Garment.grid(12, 21, pitch_mm=10), full_scale=255)
    >>> board.tare(frames=8)
    >>> codes = np.full((12, 21), 8, np.uint8)
    >>> for frame in range(30):
    ...     if frame == 20:
    ...         codes[4:6, 9:12] = 120
    ...     events = board.step(codes, frame * 16_667)
    >>> [(int(contact["area"]), float(contact["x_mm"])) for event in events if isinstance(event, taxel.Frame)
    ...  for contact in event.contacts]
    [(6, 100.0)]
    """

    def __new__(
        cls,
        garment: Garment | str | os.PathLike[str] = "reference",
        scene: str | os.PathLike[str] | None = None,
        *,
        full_scale: int = 4095,
        counts_per_newton: float | None = None,
        record: str | os.PathLike[str] | None = None,
        overwrite: bool = False,
        view: bool = False,
    ) -> VirtualBoard:
        named = None if scene is None else os.fspath(scene)
        recorded = None if record is None else (record, overwrite)
        return super().__new__(cls, garment, named, full_scale, counts_per_newton, recorded, view)

    def __enter__(self) -> VirtualBoard:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def folds(self) -> tuple[npt.NDArray[np.uint16], npt.NDArray[np.uint16], npt.NDArray[np.uint16]]:
        """Numbers of the taxels that fold, what each is expected to feel now, and the doubt of it, counts."""
        taxels, expected, doubts = super()._folds()
        return taxels, expected, doubts

    def step(self, codes: npt.ArrayLike, time_us: int) -> list[Event]:
        """Takes one scan: the codes of all taxels by their numbers, or of a garment of one panel as (rows, columns),
        whole numbers from 0 to ``full_scale``, and the board's time in microseconds, which never goes back. Returns
        the events that it causes."""
        scan, shape = _whole(codes), self.shape
        if scan.ndim != 1 and scan.shape != shape:
            wanted = f"{shape} or ({self.taxels},)" if shape else f"({self.taxels},)"
            raise UsageError(f"codes of shape {scan.shape} for a garment that takes {wanted}")
        return super().step(scan.ravel(), time_us)


class Source(VirtualBoard):
    """A tactile array that a program of yours reads: frames in, events out, shown and recorded as a board's.

    - ``rows``, ``columns``, ``pitch_mm``, ``name``: as of ``Garment.grid``
    - ``range``: values of no pressure and of the greatest, which become 0 and 4095; others are clipped
    - ``falling``: pressure lowers the value
    - ``scene``, ``record``, ``overwrite``, ``view``: as of ``VirtualBoard``

    The first 32 frames are the baseline, and their noise sets the limits of contacts unless there is a ``scene``: nobody
    may touch it then.

    >>> import numpy as np, taxel
    >>> with taxel.Source(4, 6, range=(0, 5.0), pitch_mm=8) as source:
    ...     frame = np.full((4, 6), 0.1)
    ...     for number in range(50):
    ...         frame[1:3, 2:4] = 0.9 if number > 39 else 0.1
    ...         events = source.push(frame, number * 10_000)
    >>> [int(contact["area"]) for event in events if isinstance(event, taxel.Frame) for contact in event.contacts]
    [4]
    """

    _low: float
    _high: float
    _falling: bool
    _began: int | None
    _first: list[npt.NDArray[np.uint16]] | None

    def __new__(
        cls,
        rows: int,
        columns: int,
        *,
        range: tuple[float, float],
        falling: bool = False,
        pitch_mm: float | tuple[float, float] | None = None,
        name: str = "grid",
        scene: str | os.PathLike[str] | None = None,
        record: str | os.PathLike[str] | None = None,
        overwrite: bool = False,
        view: bool = False,
    ) -> Source:
        low, high = (float(limit) for limit in range)
        if not (np.isfinite([low, high]).all() and low < high):
            raise UsageError(f"range must be (low, high) with low < high, not ({low}, {high})")
        garment = Garment.grid(rows, columns, pitch_mm=pitch_mm, name=name)
        made = super().__new__(cls, garment, scene, record=record, overwrite=overwrite, view=view)
        source = cast(Source, made)
        source._low, source._high, source._falling, source._began = low, high, falling, None
        source._first = [] if scene is None else None
        source.tare(frames=32)
        return source

    def __enter__(self) -> Source:
        return self

    def push(self, frame: npt.ArrayLike, time_us: int | None = None) -> list[Event]:
        """Takes one frame, (rows, columns) of any numbers, and its time in microseconds, which never goes back; without
        it, the time since the first frame. Returns the events that it causes."""
        values = np.asarray(frame, np.float64)
        if not np.isfinite(values).all():
            place = ", ".join(str(at) for at in np.argwhere(~np.isfinite(values))[0])
            raise UsageError(f"the value at [{place}] is no number")
        if time_us is None:
            now = time.monotonic_ns() // 1000
            self._began = now if self._began is None else self._began
            time_us = now - self._began
        scaled = np.clip(4095.0 * (values - self._low) / (self._high - self._low), 0.0, 4095.0)
        whole = np.floor(scaled + 0.5).astype(np.uint16)
        codes = 4095 - whole if self._falling else whole
        events = self.step(codes, time_us)
        if self._first is not None:
            self._first.append(codes.ravel())
            if len(self._first) == 32:
                limits, self._first = self._scene_for_noise(np.array(self._first)), None
                if limits is not None:
                    self.set_scene(limits)
        return events


def open(
    source: str = "auto",
    *,
    garment: str | os.PathLike[str] | None = None,
    scene: str | os.PathLike[str] | None = None,
    calibration: str | os.PathLike[str] | None = None,
    tare: int | None = None,
    budget: int | None = None,
    raw: bool = False,
    gestures: str | None = None,
    gesture_gain: float | None = None,
    gesture_certainty: float | None = None,
    forms: int | str | None = None,
    feed: Mapping[str, float] | None = None,
    shapes: str | os.PathLike[str] | None = None,
    body: str | os.PathLike[str] | None = None,
    folds: str | os.PathLike[str] | None = None,
    pressing: int | None = None,
    robot: str | None = None,
    motion: Mapping[str, float] | None = None,
    poses_hz: float | None = None,
    seed: int | None = None,
    realtime: bool = False,
    repeat: bool = False,
    frames: int | None = None,
    seconds: float | None = None,
    wait: bool = False,
    once: bool = False,
) -> Board:
    """Opens a board, and iterates over its events.

    ``source`` is ``auto``, ``usb[:SERIAL]``, ``sim[:TOUCHES]``, ``serial:PATH[@BAUD]``, ``tcp:HOST:PORT``,
    ``zenoh:ROBOT/BOARD[@FILE]`` (if the package was built with it) or ``replay:FILE[@SPEED]``. ``auto``
    is the board that is plugged in, on USB or behind a probe. If there is none, or it hangs, another program has it or
    this user may not open it, or there are several, ``BoardError`` says so within 3 s; nothing is simulated instead.

    What the board is asked first, as the keys of ``robot.toml`` and the options of ``taxel live`` are named; a board that
    refuses one of these raises ``BoardError``:

    - ``garment``: a preset or a TOML file
    - ``scene``: a TOML file; missing keys have the shipped values
    - ``calibration``: a file of ``taxel calibrate``, for forces in newtons
    - ``tare``: frames of the baseline at the start; by default those that a simulated scene wants, else 0
    - ``budget``: timing reports per second
    - ``raw``: also the raw codes of every scan
    - ``gestures``: the model that the board runs, ``gestures`` or ``intent``; ``gesture_gain`` is the factor from the
      garment's counts to those of the training, ``gesture_certainty`` the confidence that an announcement needs
    - ``forms``: contacts per frame whose form is computed, 1 to 254 or ``all``; by default 1
    - ``feed``: values of concepts, -1 to 1
    - ``shapes``: a base of shapes, by its file or the name of a shipped one
    - ``body``: where the taxels lie on the robot, a preset or a TOML file: the board reports in ``Pressing`` events
      what presses on each link, ``pressing`` times per second, by default with each frame
    - ``folds``: what the garment's folds press, a file of ``taxel body learn``

    Who carries it, and how it is read:

    - ``robot``: that carries the body, ``reference`` or a URDF file: ``Board.set_joints`` sends its joints, and contacts
      of ``Pressing`` events have a place in its base
    - ``motion``: what bounds the joints' motion, for ``pose_error_m``: ``angular`` (rad/s2), ``linear`` (m/s2),
      ``angular_velocity`` (rad/s), ``angular_error`` (rad), ``linear_error`` (m)
    - ``poses_hz``: poses sent to the board per second, by default 50
    - ``realtime``: a simulation or a replay takes its time; else it is as fast as it is read
    - ``repeat``: a simulation repeats its script
    - ``frames``, ``seconds``: end after so many images, or so much of the board's time. If the board sends no image for
      10 s, ``frames`` is an error (``BoardError``), and ``seconds`` are over
    - ``seed``: of a simulation, instead of its script's
    - ``wait``: wait for a board that cannot be opened yet, instead of raising ``BoardError``; a ``RuntimeWarning`` says
      why it is waited for, and Ctrl-C ends the wait
    - ``once``: end with an error when the board is lost, instead of waiting for it

    >>> import taxel
    >>> with taxel.open("sim:pat", seconds=2) as board:
    ...     touched = {str(name) for event in board if isinstance(event, taxel.Contacts)
    ...                for name in event.contacts["panel_name"]}
    >>> touched
    {'back'}
    """
    keywords: dict[str, object] = {
        "garment": garment,
        "scene": scene,
        "calibration": calibration,
        "tare": tare,
        "budget": budget,
        "raw": raw,
        "gestures": gestures,
        "gesture_gain": gesture_gain,
        "gesture_certainty": gesture_certainty,
        "forms": None if forms is None else str(forms),
        "feed": dict(feed or {}),
        "shapes": shapes,
        "body": body,
        "folds": folds,
        "pressing": pressing,
    }
    return Board(
        source,
        keywords,
        seed=seed,
        robot=robot,
        motion=None if motion is None else ",".join(f"{name}={value}" for name, value in motion.items()),
        poses_hz=poses_hz,
        realtime=realtime,
        repeat=repeat,
        frames=frames,
        seconds=seconds,
        wait=wait,
        once=once,
    )


def open_robot(
    path: str | os.PathLike[str], *, realtime: bool = False, seconds: float | None = None, keep: float = 0.0
) -> Robot:
    """Opens all boards of a robot's file, ``robot.toml``, and iterates over their events.

    - ``realtime``: simulations take their time; else they are as fast as they are read
    - ``seconds``: end after so much of each board's time
    - ``keep``: seconds for which ``Robot.frames`` and ``Robot.contacts`` know what the boards have said

    A board that is lost does not hold up the others: ``BoardState`` events say how each board is, and
    ``RobotIntent`` events what the touches of all boards mean together. Of a program that is too slow for real
    boards, images are dropped and counted.
    """
    return Robot(path, realtime=realtime, seconds=seconds, keep=keep)
