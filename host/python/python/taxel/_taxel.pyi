"""The part of the package that is written in Rust."""

from collections.abc import Sequence
from os import PathLike
from typing import Any, TypeVar, final

import numpy as np
import numpy.typing as npt

from . import _events
from ._field import Field

_B = TypeVar("_B", bound=VirtualBoard)
_M = TypeVar("_M", bound=Motion)
_R = TypeVar("_R", bound=Robot)
_S = TypeVar("_S", bound=VirtualRobot)

__version__: str

CONTACT: np.dtype[np.void]
MOMENT: np.dtype[np.void]
"""One contact: a structured type whose fields are the keys of a contact's JSON."""

class Error(Exception):
    """Something failed: a file, the disk, a result that is not there."""

class UsageError(Error):
    """Wrong use: an unknown name, or a value that is out of range."""

class BoardError(Error):
    """The board, or the link to it, is at fault."""

class Event:
    """Something that a board has said. Its attributes are the keys of its message."""

    time_us: Field[int | None]
    """The board's time, microseconds since its start; None for events without one."""

    @property
    def type(self) -> str:
        """Type of the message, ``frame`` say."""
    @property
    def board(self) -> str | None:
        """Name of the board of a robot; None of a board that is opened alone, and of the whole robot."""
    @property
    def host_ns(self) -> int:
        """The host's time, nanoseconds since 1970: that of the event itself if the board's clock is known, else that
        of its arrival."""
    @property
    def host_time_uncertainty_us(self) -> int | None:
        """Bound of the error of ``host_ns``, microseconds; None if the board's clock is not known."""
    def to_dict(self) -> dict[str, Any]:
        """The message as a dict, as ``taxel live --json`` prints it."""
    def json(self) -> str:
        """The message as text."""
    def _value(self, name: str) -> Any: ...

class Frame(Event):
    """Arrays of a frame."""

    @property
    def image(self) -> npt.NDArray[np.uint16] | None:
        """Pressure by taxel number, counts: read-only; None if the image could not be decoded."""
    @property
    def panels(self) -> dict[str, npt.NDArray[np.uint16]]:
        """The image by panel: views of (rows, columns) by the panel's name."""
    @property
    def contacts(self) -> npt.NDArray[np.void]:
        """Present contacts, of dtype ``taxel.CONTACT``."""
    @property
    def released(self) -> list[int]:
        """Ids of the contacts that ended with this frame."""

class Raw(Event):
    """Arrays of a scan's raw codes."""

    @property
    def codes(self) -> npt.NDArray[np.uint16] | None:
        """Codes of the converter by taxel number: read-only; None if they could not be decoded."""
    @property
    def panels(self) -> dict[str, npt.NDArray[np.uint16]]:
        """The codes by panel: views of (rows, columns) by the panel's name."""

class Contacts(Event):
    """Arrays of contacts."""

    @property
    def contacts(self) -> npt.NDArray[np.void]:
        """Present contacts, of dtype ``taxel.CONTACT``."""
    @property
    def released(self) -> npt.NDArray[np.void]:
        """Contacts that have ended since the last list, with their last values."""

def _set_event_classes(classes: dict[str, type[Event]]) -> None: ...

@final
class Moment:
    """Contacts of a board at a time: `host_ns`, by the clock that all boards share, and `time_us`, by its own."""

    @property
    def host_ns(self) -> int:
        """Host time, ns since 1970: the time that was asked for, or that of the newest list."""
    @property
    def host_time_uncertainty_us(self) -> int | None:
        """The most by which that is off, us; None if the board has not answered yet."""
    @property
    def time_us(self) -> int:
        """The board's own time, us."""
    @property
    def contacts(self) -> npt.NDArray[np.void]:
        """Contacts, of dtype ``taxel.MOMENT``."""

class Robot:
    """An open robot: an iterator over the events of all its boards."""

    def __new__(
        cls: type[_R],
        path: str | PathLike[str],
        *,
        realtime: bool = False,
        seconds: float | None = None,
        keep: float = 0.0,
    ) -> _R: ...
    def __iter__(self: _R) -> _R: ...
    def __next__(self) -> Event: ...
    def close(self) -> None:
        """Closes all connections; then there are no more events."""
    @property
    def boards(self) -> list[str]:
        """Names of the boards, in the order of the file."""
    def tare(self, frames: int = 64, *, board: str | None = None) -> None:
        """Takes the mean of the next frames as the baseline: of this board, or of all."""
    def frames(self, host_ns: int | None = None) -> dict[str, _events.Frame | None]:
        """The newest image of each board, a ``Frame`` or None, until this time of the host, ns; by default until
        all boards have sent theirs.
        """
    def contacts(self, host_ns: int | None = None) -> dict[str, Moment | None]:
        """The contacts of each board, a ``Moment`` or None, at this time of the host, ns; by default the newest
        that all boards have reported.
        """
    def _set_scene(self, path_or_text: str, *, board: str | None = None) -> None: ...
    def set_input(self, name: str, value: float, *, age_ms: int = 0) -> None:
        """Sends the robot's map what others know: a value of -1 to 1 by its name, of this age."""
    def set_joints(self, positions: dict[str, float], *, age_ms: int = 0) -> None:
        """Sends positions of the robot's joints, rad or m, of this age."""
    def why(self, of: str | None = None) -> dict[str, Any]:
        """Returns why the robot's map has its activations now: of a concept, else of the intention that leads.

        It is what ``taxel fcm why --json`` prints: the causes in units that add up, what each input heard down to
        the contacts of each board, and why each board announced what it did.
        """
    def self_test(self, *, board: str | None = None) -> None:
        """Examines lines and inputs of this board, or of all."""

class Board:
    """An open board: an iterator over its events."""

    def __init__(
        self,
        source: str,
        keywords: dict[str, object],
        *,
        seed: int | None = None,
        robot: str | None = None,
        motion: str | None = None,
        poses_hz: float | None = None,
        realtime: bool = False,
        repeat: bool = False,
        frames: int | None = None,
        seconds: float | None = None,
        wait: bool = False,
        once: bool = False,
    ) -> None: ...
    def __iter__(self) -> Board: ...
    def __next__(self) -> Event: ...
    def close(self) -> None:
        """Closes the connection; then there are no more events."""
    @property
    def label(self) -> str | None:
        """Short name of the source; None once it is closed."""
    def _request(self, name: str, values: dict[str, Any]) -> None: ...
    def _set_joints(
        self, positions: dict[str, float], host_ns: int | None, time_us: int | None
    ) -> None: ...

@final
class Garment:
    """Panels of taxels, and their wiring if a board scans them."""

    @staticmethod
    def grid(
        rows: int, columns: int, *, pitch_mm: float | tuple[float, float] | None = None, name: str = "grid"
    ) -> Garment:
        """A garment of one panel without wiring, for an array of taxels that something else reads: ``rows`` x
        ``columns``, at most 2,048, their centres ``pitch_mm`` apart: a number, or (columns, rows); None if it is not
        known, and lengths are then in taxels alone.
        """
    @staticmethod
    def load(name_or_path: str | PathLike[str]) -> Garment:
        """A preset by its name (``reference``, ``mat-64x32``, ``block-4x16``), or a TOML file."""
    @property
    def name(self) -> str:
        """Its name."""
    @property
    def taxels(self) -> int:
        """Number of taxels: the length of a scan."""
    @property
    def panels(self) -> dict[str, tuple[int, int]]:
        """Rows and columns of each panel, by its name, in the order of their taxels."""

class VirtualBoard:
    """A board without pins and without a clock."""

    def __new__(
        cls: type[_B],
        garment: Garment | str | PathLike[str],
        scene: str | None,
        full_scale: int,
        counts_per_newton: float | None,
        record: tuple[str | PathLike[str], bool] | None,
        view: bool,
    ) -> _B: ...
    def _scene_for_noise(self, frames: npt.NDArray[np.uint16]) -> str | None:
        """Scene with limits for the noise of these frames, (n, taxels) codes; None if it cannot be told."""
    @property
    def shape(self) -> tuple[int, int] | None:
        """Rows and columns of a garment of one panel; None of one of several."""
    @property
    def page(self) -> str | None:
        """Address of the page that shows the board, in a browser of this machine; None without ``view``."""
    def close(self) -> None:
        """Completes the recording, if there is one."""
    @property
    def taxels(self) -> int:
        """Number of taxels: the length of a scan."""
    def step(self, codes: npt.NDArray[np.uint16], time_us: int) -> list[Event]:
        """Takes one scan: the codes of all taxels, ``uint16`` by their numbers, and the board's time in
        microseconds, which never goes back. Returns the events that it causes.
        """
    def _folds(self) -> list[npt.NDArray[np.uint16]]: ...
    def _request(self, name: str, values: dict[str, Any]) -> None: ...

class VirtualRobot:
    """The boards of a robot without pins and without a clock, and what touches mean to it."""

    def __new__(cls: type[_S], path: str | PathLike[str]) -> _S: ...
    @property
    def boards(self) -> list[str]:
        """Names of the boards, in the order of the file."""
    def taxels(self, board: str) -> int:
        """Number of a board's taxels: the length of a scan."""
    def step(self, board: str, codes: npt.NDArray[np.uint16], time_us: int) -> _events.RobotIntent | None:
        """Takes one scan of a board: the codes of all its taxels, ``uint16`` by their numbers, and the time in
        microseconds, which never goes back. Returns what touches mean then, if that is news.
        """
    def set_input(self, name: str, value: float, time_us: int, *, age_ms: int = 0) -> None:
        """Sends the robot's map what others know at a time: a value of -1 to 1 by its name, of this age."""
    def set_joints(self, positions: dict[str, float], time_us: int, *, age_ms: int = 0) -> None:
        """Sends positions of the robot's joints, rad or m, at a time, of this age."""
    def _touches(self) -> list[dict[str, Any]]: ...
    def why(self, of: str | None = None) -> dict[str, Any]:
        """Returns why the robot's map has its activations now: of a concept, else of the intention that leads.

        It is what ``taxel fcm why --json`` prints: the causes in units that add up, what each input heard down to
        the contacts of each board, and why each board announced what it did.
        """

@final
class MotionTouch:
    """A contact on a robot, for ``Motion``.

    ``at`` (m) and ``normal``, away from the robot and of any length, are in the frame of the link; ``newtons`` is what
    presses along the normal. ``touch`` is its number from onset to release, among all contacts of the robot.
    """

    def __new__(
        cls,
        link: str,
        at: Sequence[float] | npt.NDArray[np.float64],
        normal: Sequence[float] | npt.NDArray[np.float64],
        newtons: float,
        *,
        touch: int = 0,
        region: str = "",
        mover: str = "other",
    ) -> MotionTouch: ...
    @property
    def link(self) -> str:
        """Name of its link."""
    @property
    def at(self) -> list[float]:
        """Place in the frame of the link, m."""
    @property
    def normal(self) -> list[float]:
        """Direction away from the robot there."""
    @property
    def newtons(self) -> float:
        """Force along the normal, N."""
    @property
    def touch(self) -> int:
        """Number from onset to release."""
    @property
    def region(self) -> str:
        """Name of its region."""
    @property
    def mover(self) -> str:
        """Whose motion has caused it: ``own``, ``other`` or ``unsure``."""

@final
class MotionCommand:
    """Command of a robot at a cycle, and its causes."""

    @property
    def phase(self) -> str:
        """``disarmed``, ``armed``, or ``stopped`` by a fault until it is armed again."""
    @property
    def deed(self) -> str:
        """Name of the deed: ``nothing``, ``stop``, ``clamped``, ``retreat``, ``yield``, ``slow``, ``resume``, ``free``."""
    @property
    def fault(self) -> str | None:
        """The fault that has stopped it, such as ``stale_posture``; None if none has."""
    @property
    def speed(self) -> float | None:
        """Factor on the speed of the robot's own motion, 0 to 1; None while it is disarmed."""
    @property
    def velocities(self) -> npt.NDArray[np.float64]:
        """Velocities in the order of ``Motion.joints``, rad/s or m/s; 0 unless it is armed."""
    @property
    def tank_j(self) -> float:
        """Energy that is left in the tank, J."""
    @property
    def share(self) -> float:
        """Share to which the tank, or two links that are kept apart, have cut the velocities."""
    @property
    def causes(self) -> list[dict[str, Any]]:
        """Touches about which something is done: ``touch``, ``region``, ``link``, ``newtons``, ``do``, ``row``."""

class Motion:
    """From touch to motion: called with a posture and touches at each cycle, it returns velocities of the joints.

    ``robot`` is a URDF file, a robot's file that names one, or ``reference``; ``behaviour`` a file or ``people``
    (docs/guides/motion.md of the project). It begins disarmed, and commands nothing until ``arm``. It is no safety function.

    Positions are in rad or m, by name or in the order of ``joints``; joints that are left out rest. Times are
    microseconds of one clock: of the cycle, of the posture and of the newest scan (those of the cycle if left out).
    A posture of more than 50 ms, a scan of more than 20 ms, cycles more than 50 ms apart, times that jump, and numbers
    that are none stop it.

    >>> import taxel
    >>> motion = taxel.Motion("reference")
    >>> posture = {"left_shoulder_pitch": 0.8, "left_shoulder_roll": 0.7, "left_elbow": 1.2}
    >>> press = taxel.MotionTouch("left_forearm", (0.03, 0, -0.15), (1, 0, 0), 40.0, touch=1)
    >>> motion(posture, 5000, [press]).deed
    'nothing'
    >>> motion.arm(posture, 10_000)
    >>> command = motion(posture, 15_000, [press])
    >>> command.deed, command.speed, bool(command.velocities.any())
    ('retreat', 0.0, True)
    """

    def __new__(
        cls: type[_M], robot: str | PathLike[str], behaviour: str | PathLike[str] = "people"
    ) -> _M: ...
    @property
    def joints(self) -> list[str]:
        """Names of the joints that have a position of their own."""
    @property
    def phase(self) -> str:
        """``disarmed``, ``armed`` or ``stopped``."""
    @property
    def faults(self) -> dict[str, int]:
        """Times that each fault has stopped it."""
    def arm(
        self,
        positions: dict[str, float] | Sequence[float] | npt.NDArray[np.float64],
        time_us: int,
        *,
        posture_us: int | None = None,
        frame_us: int | None = None,
    ) -> None:
        """Arms it, from standstill and with a full tank. Raises ``Error`` while what is known would stop it."""
    def disarm(self) -> None:
        """Disarms it: it says nothing more."""
    def __call__(
        self,
        positions: dict[str, float] | Sequence[float] | npt.NDArray[np.float64],
        time_us: int,
        touches: Sequence[MotionTouch] = (),
        *,
        leading: str = "none",
        posture_us: int | None = None,
        frame_us: int | None = None,
    ) -> MotionCommand:
        """Advances to a cycle at a time. ``leading`` is what touches mean: none, kindness, threat or attack."""

def images(
    path: str, raw: bool, first: int, last: int
) -> tuple[npt.NDArray[np.uint64], npt.NDArray[np.uint64], npt.NDArray[np.uint16]]:
    """The images of a range, or the raw codes. They are read into the memory of the array that is returned."""

class RecordedEvents:
    """Iterator over the events of a recording."""

    def __init__(self, path: str, kinds: list[str], first: int, last: int) -> None: ...
    def __iter__(self) -> RecordedEvents: ...
    def __next__(self) -> Event: ...

class TouchDecision:
    """Decision of a model about a touch."""

    @property
    def name(self) -> str:
        """Name of the class with the greatest score."""
    @property
    def confidence(self) -> float | None:
        """Share of such touches that are classified correctly, 0 to 1; None if the model does not know."""
    @property
    def scores(self) -> npt.NDArray[np.float64]:
        """Score of each class, in the order of the model's ``classes``: fitted to 1 for a touch's own, -1 for others."""

class TouchModel:
    """A model of touches over time, in the integers of the board.

    It is linear over the 127 ``features`` of a touch. ``load`` has the models of the firmware, ``linear`` makes one of
    planes that your program has fitted; what it decides is what a board with it would.

    >>> import numpy as np, taxel
    >>> model = taxel.TouchModel.load("intent")
    >>> model.classes
    ['kindness', 'threat', 'attack']
    >>> model.decide(np.full((30, 8, 8), 900, np.uint16)).name in model.classes
    True
    """

    @staticmethod
    def linear(
        classes: Sequence[str],
        *,
        mean: npt.NDArray[np.float64],
        scale: npt.NDArray[np.float64],
        weights: npt.NDArray[np.float64],
        offsets: npt.NDArray[np.float64],
        pressed: int = 0,
        notes: str = "{}",
    ) -> TouchModel:
        """A model of one plane for each class. Score: offset + weights . clip((features - mean) / scale, -2.5, 2.5).

        ``classes`` are 2 to 8 names of at most 16 bytes; ``mean`` and ``scale`` (127,), ``weights`` (classes, 127),
        ``offsets`` (classes,); ``pressed`` as of ``features``; ``notes`` is JSON that the file keeps. Numbers are rounded
        to those of the board. ``UsageError`` for other shapes, ``Error`` for what does not fit a board.
        """
    @staticmethod
    def load(model: str | PathLike[str]) -> TouchModel:
        """A model of the firmware, ``"gestures"`` or ``"intent"``, or that of a file; ``Error`` if it is none."""
    def save(self, path: str | PathLike[str], overwrite: bool = False) -> None:
        """Saves the model as a file; an existing one is replaced with ``overwrite`` only."""
    @property
    def classes(self) -> list[str]:
        """Names of the classes."""
    @property
    def pressed(self) -> int:
        """Cells above this count as touched."""
    def decide(self, frames: npt.NDArray[np.uint16]) -> TouchDecision:
        """Classifies a whole touch by its frames of one panel, (n, rows, columns), whole counts."""

class RecordedMessages:
    """Iterator over the messages of a recording, as they were written."""

    def __init__(self, path: str, topic: str | None, first: int, last: int) -> None: ...
    def __iter__(self) -> RecordedMessages: ...
    def __next__(self) -> tuple[str, int, int, bytes]: ...

class Map:
    """A fuzzy cognitive map: concepts and causes."""

    @staticmethod
    def _from_dict(keys: dict[str, Any]) -> Map: ...
    @staticmethod
    def parse(text: str) -> Map:
        """A map from the text of its TOML file."""
    @staticmethod
    def load(name_or_path: str) -> Map:
        """A shipped map by name (``tactile``, ``shape``), or a TOML file."""
    @property
    def name(self) -> str:
        """Name of the map."""
    @property
    def concepts(self) -> list[str]:
        """Names of the concepts, in the order of every state."""
    def to_dict(self) -> dict[str, Any]:
        """The map as the keys of its TOML file."""
    def to_toml(self) -> str:
        """The text of its TOML file."""
    def run(self, inputs: dict[str, float] = ..., *, steps: int = 100) -> dict[str, Any]:
        """Runs the map from these activations in f64 and in the arithmetic of the board."""
    def explain(
        self, inputs: dict[str, float] = ..., *, of: str | None = None, set: dict[str, float] = ...
    ) -> dict[str, Any]:
        """Explains a concept's activation in numbers that add up, and what would change it."""
    def check(self) -> dict[str, Any]:
        """Returns what is to be said about the map: concepts that cannot be reached, whether it settles, whether it
        fits the board.
        """
    def draw(self) -> str:
        """The map in DOT."""

def overview(path: str) -> dict[str, Any]:
    """Contents of a recording: topics, times, attachments, metadata."""
def attachment(path: str, name: str) -> bytes | None:
    """An attachment of a recording; None if there is none of this name."""
def features(frames: npt.NDArray[np.uint16], pressed: int = 0) -> npt.NDArray[np.uint16]:
    """The 127 features of a touch, from its frames of one panel."""
def moments(image: npt.NDArray[np.uint16]) -> dict[str, Any]:
    """Moments, NMI and axis of one image."""
def learn_folds(
    garment: str,
    sweeps: list[tuple[list[str], npt.NDArray[np.float32], npt.NDArray[np.uint16]]],
    folds: list[list[str]],
    step_deg: float,
    shift_mm: float,
    shift_deg: float,
) -> tuple[bytes, list[dict[str, Any]]]:
    """The table of folds for a board, and what is reported of each."""
def run_program(words: Sequence[str]) -> int:
    """Runs the command line behind the program's name, and returns its exit status."""
