"""Events and their parts, typed. Made from the structs of the messages by host/taxel/tests/library/python_types.rs:
TAXEL_BLESS=1 updates it."""

from __future__ import annotations

from typing import Any, final

from . import _taxel
from ._field import Field, Part, each
from ._taxel import Event


@final
class Boot(Part):
    """Start of the board."""

    cause = Field[str]("``power``, ``pin``, ``watchdog``, ``panic``, ``request`` or ``other``.")
    resets = Field[int]("Resets by watchdog or panic up to this one, each less than a minute after the one before.")
    aside = Field[str](
        "Reason why the stored settings are not in use: ``no`` (they are), ``resets``, ``pin`` or ``request``."
    )


@final
class HelloPanel(Part):
    """A panel of the garment."""

    name = Field[str]("Name of the panel.")
    link = Field[str]("Link of the robot.")
    region = Field[str]("Region of the body.")
    rows = Field[int]("Number of rows.")
    columns = Field[int]("Number of columns.")
    pitch_um = Field[tuple[int, int]](tuple, "Distance of columns and of rows, um; 0 if unknown.")


@final
class Hello(Event):
    """Garment, scene and firmware of the board."""

    time_us = Field[int]("The board's time, us.")
    firmware = Field[str]("Name and version of the firmware.")
    chip = Field[str]("Unique id of the board's chip; empty if it has none, as a simulated board.")
    simulated = Field[bool]("True of a simulated board.")
    garment = Field[str]("Name of the garment.")
    scene = Field[str]("Name of the scene.")
    calibration = Field[str]("Id, date and fit of the calibration in force; empty without one: values are counts.")
    boot = Field[Boot | None](Boot, "Start of the board; None if it does not know it.")
    taxels = Field[int]("Number of taxels.")
    regions = Field[list[str]]("Names of the regions of the body.")
    panels = Field[list[HelloPanel]](each(HelloPanel), "The panels, in the order of their taxels.")


@final
class Unusable(Event):
    """The board cannot be used by this program."""

    why = Field[str]("The reason, for people.")


@final
class Meaning(Part):
    """The leading intention and the state of the map."""

    leading = Field[str]("The announced intention: ``none``, ``kindness``, ``threat`` or ``attack``.")
    concepts = Field[dict[str, float]]("Activation of each concept of the map, -1 to 1.")


@final
class Frame(_taxel.Frame):
    """A frame with the present contacts and the meaning of the touch."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    intent = Field[Meaning](Meaning, "Meaning of the touch.")
    key = Field[bool]("True for a key frame, which is decoded without the frames before it.")
    decoded = Field[bool]("True if the image could be decoded.")
    lost = Field[int]("Messages lost so far.")
    thinned = Field[int]("Images left out so far, because the link had no room.")
    force_n = Field[list[float | None] | None](
        "Force on each panel, N; None where a panel has none, absent if it is unknown."
    )
    force_basis = Field[str | None](
        "Basis of the forces: ``calibrated``, ``nominal`` or ``simulated``; absent if they are unknown."
    )


@final
class Contacts(_taxel.Contacts):
    """Contacts that are present, and those that have ended since the last such message."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    dropped = Field[int]("Number of contacts that did not fit.")
    force_basis = Field[str | None](
        "Basis of the forces: ``calibrated``, ``nominal`` or ``simulated``; absent if they are unknown."
    )


@final
class Words(Part):
    """The words for a contact."""

    strength = Field[str]("``faint``, ``light``, ``firm`` or ``hard``: the greatest strength so far.")
    extent = Field[str]("``point``, ``patch``, ``wide`` or ``sharp``: the largest extent so far.")
    span = Field[str]("``brief``, ``short`` or ``long``: the time so far.")
    moving = Field[bool]("True if it slides over the surface, or did within the last quarter of a second.")
    shape = Field[str]("Name of the shape, or ``unknown``.")


@final
class Symbol(Part):
    """The words of a contact at its onset, at a change, or at its release."""

    contact = Field[int]("Id of the contact.")
    phase = Field[str]("``onset``, ``released``, or ``held`` for a change of words.")
    region = Field[str]("Region of the body.")
    words = Field[Words](Words, "The words.")
    peak_total = Field[int]("Greatest total so far, counts.")
    duration_ms = Field[int]("Time since the onset, ms.")


@final
class Region(Part):
    """A region of the body."""

    region = Field[str]("Name of the region.")
    contacts = Field[int]("Number of contacts.")
    total = Field[int]("Sum of their totals, counts.")
    peak = Field[int]("Greatest pressure of a taxel, counts.")
    moving = Field[bool]("True if a contact slides.")
    since_us = Field[int]("Time since which the region has been touched, or untouched, us of the board.")


@final
class Symbols(Event):
    """Words for the contacts, and the state of the regions of the body."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    events = Field[list[Symbol]](each(Symbol), "Onsets, changes of words, releases.")
    regions = Field[list[Region]](each(Region), "Touched regions.")


@final
class Intent(Event):
    """The meaning of the touch has changed."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    leading = Field[str]("The announced intention: ``none``, ``kindness``, ``threat`` or ``attack``.")
    concepts = Field[dict[str, float]]("Activation of each concept of the map, -1 to 1.")
    outcome = Field[str]("End of the inference: ``fixed``, ``cycle`` or ``unsettled``.")
    steps = Field[int]("Steps of the inference.")


@final
class Gesture(Event):
    """A recognised gesture."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    touch = Field[int]("Number of the touch, from 1.")
    panel = Field[str]("Name of the touched panel.")
    name = Field[str]("Name of the gesture.")
    score = Field[float]("Score of the gesture: 1 for what the model was fitted to, -1 for all else.")
    lead = Field[float]("Lead over the score of the second gesture.")
    observed_ms = Field[int]("Time for which the touch was observed, ms.")
    ended = Field[bool]("True if the touch is over: the result is for all of it.")
    confidence = Field[float | None](
        "Share of touches of that age and lead that are of that gesture, 0 to 1; absent if the model gives none."
    )


@final
class Push(Part):
    """A force at a place."""

    at_m = Field[tuple[float, float, float]](tuple, "Place, m.")
    normal = Field[tuple[float, float, float]](tuple, "Direction away from the robot.")
    force_counts = Field[tuple[int, int, int]](tuple, "Force, counts.")
    force_n = Field[tuple[float, float, float] | None](tuple, "Force, N; absent if it is unknown.")


@final
class Uncertain(Part):
    """Uncertainty of a force and its place by saturated and faulty taxels."""

    saturated = Field[int]("Number of saturated taxels: with one or more, the force is the least that it may be.")
    faulty = Field[int]("Number of faulty taxels under the contact, or at its edge.")
    less_counts = Field[int]("The most by which the faulty ones press less than is counted for them, counts.")
    more_counts = Field[int]("The most by which they press more, counts.")
    off_m = Field[float]("The most by which they move the centre of pressure, m.")


@final
class PlacedContact(Part):
    """A contact on the robot."""

    id = Field[int]("Id of the contact.")
    link = Field[str]("Name of the link.")
    at_m = Field[tuple[float, float, float]](tuple, "Place, m.")
    normal = Field[tuple[float, float, float]](tuple, "Direction away from the robot.")
    force_counts = Field[tuple[int, int, int]](tuple, "Force, counts.")
    force_n = Field[tuple[float, float, float] | None](tuple, "Force, N; absent if it is unknown.")
    base = Field[Push | None](Push, "Place in the frame of the poses; None without a pose of the link.")
    uncertain = Field[Uncertain | None](Uncertain,
        "Uncertainty by saturated and faulty taxels; None if there is none."
    )


@final
class Wrench(Part):
    """Force and moment on a link, in its frame."""

    link = Field[str]("Name of the link.")
    force_counts = Field[tuple[int, int, int]](tuple, "Sum of the taxels' forces along their normals, counts.")
    moment_counts_m = Field[tuple[float, float, float]](tuple, "Their moment about the link's origin, counts times m.")
    pressed_counts = Field[int]("Sum of their magnitudes, counts.")
    force_n = Field[tuple[float, float, float] | None](tuple,
        "The force, N; absent if it is unknown, as are the two below."
    )
    moment_nm = Field[tuple[float, float, float] | None](tuple, "The moment, N m.")
    pressed_n = Field[float | None]("The sum of the magnitudes, N.")
    center_m = Field[tuple[float, float, float]](tuple, "Centre of pressure, m.")
    uncertain = Field[Uncertain | None](Uncertain,
        "Uncertainty by saturated and faulty taxels; None if there is none."
    )


@final
class Pressing(Event):
    """Contacts and forces on the robot."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    posed_us = Field[int | None](
        "Time of the poses in force, us of the board: of links that stand still, when it received them. Null without "
        "poses."
    )
    pose_age_us = Field[int | None](
        "Time from there to the start of the scan, us; below 0 if the poses came after it. Null without poses."
    )
    pose_error_m = Field[float | None](
        "The most by which a place in the frame of the poses is off, m, because joints are not known exactly and move "
        "on: by what the host that sends the poses knows of the joints. Null if it does not say it."
    )
    contacts = Field[list[PlacedContact]](each(PlacedContact), "The contacts that have a place.")
    links = Field[list[Wrench]](each(Wrench), "The links that something presses on.")
    force_basis = Field[str | None](
        "Basis of the forces in newtons: ``calibrated``, ``nominal`` or ``simulated``; absent if they are unknown."
    )


@final
class FoldDoubt(Part):
    """By how much the force of a contact may be off for the folds beneath it."""

    id = Field[int]("Id of the contact.")
    doubt = Field[int]("Sum of the doubts of its taxels, counts.")


@final
class Folds(Event):
    """Expected pressure of the garment's folds."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    posed_us = Field[int | None](
        "Time at which the board received the posture in force, us of the board; None without one."
    )
    followed = Field[bool](
        "True if the folds follow the posture. False without a posture, or if it is too old: taxels that fold are "
        "then touched only beyond the most that they feel at any posture."
    )
    taxels = Field[int]("Number of taxels of which something is expected, or that are in doubt.")
    expected = Field[int]("Sum of the expected pressures, counts.")
    doubt = Field[int]("Sum of the doubts, counts.")
    contacts = Field[list[FoldDoubt]](each(FoldDoubt), "Present contacts on such taxels.")


@final
class SurfaceRegion(Part):
    """Touch state of a region of the surface."""

    region = Field[str]("Name of the region.")
    phase = Field[str](
        "``free``; ``onset`` for the first 150 ms of a touch; ``held``; ``moving``; ``released`` for 0.5 s."
    )
    way = Field[str](
        "Direction in which the touch moves: ``forward``, ``back``, ``left``, ``right``, ``up``, ``down`` or "
        "``none``; x is forward, y to the left and z up, in the frame of the poses or, without a pose, of the link."
    )
    contacts = Field[int]("Number of contacts in it.")
    strength = Field[str](
        "``faint``, ``light``, ``firm`` or ``hard``: of the contact that presses most, or that pressed last."
    )
    extent = Field[str]("``point``, ``patch``, ``wide`` or ``sharp``.")
    shape = Field[str]("Name of the shape, or ``unknown``.")
    since_us = Field[int]("Time since which the region is in its phase, us of the board.")


@final
class Regions(Event):
    """Touch state of each region of the robot's surface: when one of them changes, and once a second."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    regions = Field[list[SurfaceRegion]](each(SurfaceRegion), "All regions, in the order of the body.")


@final
class Shapes(Event):
    """The base of shapes in force."""

    classes = Field[list[str]]("Names of the taught shapes; empty while the built-in base is in force.")
    prototypes = Field[int]("Number of prototypes.")


@final
class Reaction(Event):
    """A reaction of the garment has begun or ended."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    index = Field[int]("Row of the scene's table, from 0.")
    name = Field[str]("Name of the reaction.")
    active = Field[bool]("True if it began, false if it ended.")
    value = Field[int]("Value at that moment, in the unit of the cause.")


@final
class Reflex(Event):
    """A reaction has begun within a frame."""

    frame = Field[int]("Number of the scan.")
    other = Field[int | None]("The taxel that agrees, if two must; else None.")
    index = Field[int]("Row of the scene's table, from 0.")
    taxel = Field[int]("The taxel that decided.")
    value = Field[int]("Pressure of the taxel, counts.")
    time_us = Field[int]("Time at which the deciding part of the scan had been read, us of the board.")


@final
class Health(Event):
    """Counters of the board, from its start on."""

    process_us = Field[int]("Duration of the last perception, us.")
    scans = Field[int]("Finished scans.")
    failed = Field[int]("Scans that failed.")
    overruns = Field[int]("Complete frames that were never read.")
    thinned_frames = Field[int]("Images that were due and not sent, because the link had no room.")
    thinned_contacts = Field[int]("Contact updates that were due and not sent.")
    lost = Field[int]("Guaranteed messages that did not fit in the queue.")
    refused = Field[int]("Received frames that were refused.")
    scan_us = Field[int]("Duration of the last scan, us.")
    time_us = Field[int]("The board's time, us.")


@final
class Budget(Event):
    """Time spent on frames: of each part, the most that any of the frames took."""

    frame = Field[int]("Number of the last of these scans.")
    thinned_frames = Field[int]("Images that were due and not sent, because the link had no room.")
    frames = Field[int]("Number of frames: 1, or all since the last such message.")
    scan_us = Field[int]("Duration of the scan, us.")
    process_us = Field[int]("Time from the codes to the reactions, us.")
    encode_us = Field[int]("Time of encoding messages and handing them to the link, us.")
    send_us = Field[int]("Time for which a message waited for room on the link, us.")
    overruns = Field[int]("Complete frames that were never read.")
    time_us = Field[int]("Start of the last scan, us of the board.")


@final
class Temperature(Event):
    """Temperature of the converter."""

    time_us = Field[int]("Start of the scan in which it was measured, us of the board.")
    celsius = Field[float]("Temperature, degrees Celsius; may be several degrees off, but shows changes.")


@final
class FaultyTaxel(Part):
    """A faulty taxel."""

    taxel = Field[int]("Number of the taxel.")
    health = Field[str]("Fault, for people.")


@final
class HealthMap(Event):
    """Faulty taxels."""

    time_us = Field[int]("The board's time, us.")
    whole = Field[bool]("True if the list is complete; else more follows.")
    faulty = Field[list[FaultyTaxel]](each(FaultyTaxel), "The faulty taxels, ascending.")


@final
class PinFault(Part):
    """A faulty pin."""

    pin = Field[int]("GPIO number.")
    fault = Field[Any](
        "``stuck-high``, ``stuck-low``, ``open``, ``grounded``, ``supplied``, or ``{\"bridged\": pin}``."
    )


@final
class SelfTest(Event):
    """Result of a self-test of lines and inputs."""

    time_us = Field[int]("The board's time at the end of the self-test, us.")
    lines = Field[int]("Select lines that were examined.")
    inputs = Field[int]("Converter inputs that were examined.")
    faults = Field[list[PinFault]](each(PinFault), "The faults found.")


@final
class Log(Event):
    """A log message of the board, or a remark of the host about the link."""

    time_us = Field[int]("The board's time, us.")
    level = Field[str]("``info``, ``warn`` or ``error``.")
    text = Field[str]("The message.")


@final
class Sync(Event):
    """Answer to a ``Sync``."""

    token = Field[int]("The number sent along with the request.")
    received_us = Field[int]("Time at which the board received it, us of the board.")
    sent_us = Field[int]("Time at which the board answered, us of the board.")


@final
class StartOfFrame(Event):
    """Start of a frame of the USB."""

    number = Field[int]("Number of the frame, 0 to 2047.")
    noticed_us = Field[int]("Time at which the board noticed its start, us of the board.")
    late_us = Field[int]("Greatest time by which it may have begun before, us.")


@final
class Answer(Event):
    """Answer to another request."""

    request = Field[str]("Name of the request.")
    refusal = Field[str | None]("Reason why it was refused; None if it was done.")


@final
class Raw(_taxel.Raw):
    """Raw codes have come."""

    frame = Field[int]("Number of the scan.")
    time_us = Field[int]("Start of the scan, us of the board.")
    decoded = Field[bool]("True if the codes could be decoded.")


@final
class Refused(Event):
    """Bytes from the board that are not a message."""

    why = Field[str]("The reason, for people.")


@final
class Lost(Event):
    """The link to the board is lost, and waited for. What was present has ended just before."""

    since_us = Field[int]("Host time at which the board was last heard, us since 1970.")
    why = Field[str]("The reason, for people.")


@final
class Back(Event):
    """The lost board is back, and its settings are restored."""

    after_s = Field[float]("Time for which it was lost, s.")
    how = Field[str]("Words on whether it had restarted and what was set again, for people.")


@final
class Other(Event):
    """Another board answers in place of the one before."""

    why = Field[str]("Difference, for people.")


@final
class Approach(Part):
    """Motion of the robot's surface shortly before a contact."""

    normal_m_s = Field[float]("Speed along the normal, m/s; positive outwards.")
    speed_m_s = Field[float]("Whole speed, m/s.")


@final
class Probe(Part):
    """Properties of an object that a limb feels."""

    hardness = Field[int | None](
        "Greatest force over greatest depth, counts/mm, the depth of at least half a millimetre; none before that "
        "depth or 2,000 counts."
    )
    point = Field[int]("Share of the force on the taxel with the greatest pressure, at the greatest force, percent.")
    slide = Field[int]("Greatest speed of the contact along the surface, mm/s.")
    stir = Field[int]("Greatest change of the force while the limb was still, percent.")


@final
class RobotTouch(Part):
    """A contact of a board."""

    board = Field[int]("Number of the board, in the order of the robot's file.")
    contact = Field[int]("Id of the board's contact.")
    region = Field[str]("Region on which it lies.")
    link = Field[str]("Link on which it lies.")
    load = Field[int]("Pressure, counts; with a calibration in force the force, thousandths of a newton.")
    mover = Field[str](
        "``own`` if the robot's motion has caused it, ``other`` if that of what touches it, or ``unsure``."
    )
    approach = Field[Approach | None](Approach,
        "Motion of the robot's surface before the onset; absent if it is not known."
    )
    probe = Field[Probe | None](Probe,
        "Properties of the object that the robot has moved into; absent of what touches it."
    )


@final
class RobotIntent(Event):
    """Meaning of the touches of all boards together."""

    host_time_us = Field[int]("The host's time, us since 1970.")
    leading = Field[str]("The announced intention: ``none``, ``kindness``, ``threat`` or ``attack``.")
    holding = Field[list[str]]("Names of the concepts with causes that hold: of at least 0.5, and then down to 0.4.")
    concepts = Field[dict[str, float]]("Activation of each concept of the map, -1 to 1.")
    defaults = Field[list[str]](
        "Inputs of the map for which nothing is known that is young enough, so that its default counts: names of "
        "their concepts."
    )
    touches = Field[list[RobotTouch]](each(RobotTouch), "Contacts on the robot, and whose motion has caused them.")


@final
class BoardState(Event):
    """State of a board of a robot."""

    state = Field[str]("``absent``, ``met``, ``lost``, ``back``, ``other``, ``dropped``, ``over`` or ``failed``.")
    host_time_us = Field[int]("The host's time, us since 1970.")
    since_us = Field[int | None]("Host time at which a lost board was last heard, us since 1970.")
    after_s = Field[float | None]("Time for which a board was gone that is back, s.")
    images = Field[int | None]("Images dropped so far.")
    why = Field[str | None]("Reason of the state.")


#: The class of each type of message.
CLASSES: dict[str, type[Event]] = {
    "hello": Hello,
    "unusable": Unusable,
    "frame": Frame,
    "contacts": Contacts,
    "symbols": Symbols,
    "intent": Intent,
    "gesture": Gesture,
    "pressing": Pressing,
    "folds": Folds,
    "regions": Regions,
    "shapes": Shapes,
    "reaction": Reaction,
    "reflex": Reflex,
    "health": Health,
    "budget": Budget,
    "temperature": Temperature,
    "health_map": HealthMap,
    "self_test": SelfTest,
    "log": Log,
    "sync": Sync,
    "start_of_frame": StartOfFrame,
    "answer": Answer,
    "raw": Raw,
    "refused": Refused,
    "lost": Lost,
    "back": Back,
    "other": Other,
    "robot_intent": RobotIntent,
    "board": BoardState,
}

__all__ = [
    "Answer",
    "Approach",
    "Back",
    "BoardState",
    "Boot",
    "Budget",
    "Contacts",
    "FaultyTaxel",
    "FoldDoubt",
    "Folds",
    "Frame",
    "Gesture",
    "Health",
    "HealthMap",
    "Hello",
    "HelloPanel",
    "Intent",
    "Log",
    "Lost",
    "Meaning",
    "Other",
    "PinFault",
    "PlacedContact",
    "Pressing",
    "Probe",
    "Push",
    "Raw",
    "Reaction",
    "Reflex",
    "Refused",
    "Region",
    "Regions",
    "RobotIntent",
    "RobotTouch",
    "SelfTest",
    "Shapes",
    "StartOfFrame",
    "SurfaceRegion",
    "Symbol",
    "Symbols",
    "Sync",
    "Temperature",
    "Uncertain",
    "Unusable",
    "Words",
    "Wrench",
]
