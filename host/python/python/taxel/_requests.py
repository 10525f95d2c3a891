"""Requests of a program to a board."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any


class Requests:
    """Requests to a board. They are sent when the events are read next; the board's answer is an ``Answer``.

    What is set lasts until the board restarts; it is set again when a lost board comes back.
    """

    def _request(self, name: str, values: dict[str, Any]) -> None:
        raise NotImplementedError

    def _ask(self, name: str, /, **values: Any) -> None:
        self._request(name, values)

    def tare(self, frames: int = 64) -> None:
        """Takes the mean of the next ``frames`` frames (1 to 4096) as the baseline. Nothing may touch."""
        self._ask("tare", frames=frames)

    def set_concept(
        self, name: str, value: float, *, age_ms: int = 0, timeout_ms: int = 0, default: float = 0.0
    ) -> None:
        """Sets a concept that the host feeds to the map, -1 to 1.

        ``age_ms`` is the value's age now. From an age of ``timeout_ms`` on (0: never) it no longer counts, and
        ``default`` does.
        """
        ages = {"age_ms": age_ms, "timeout_ms": timeout_ms}
        self._ask("set_concept", name=name, value=value, default=default, **ages)

    def set_posture(self, degrees: Mapping[str, float]) -> None:
        """Sends the angles of joints, by their names in the scene, so that folds are no touches."""
        self._ask("set_posture", degrees=dict(degrees))

    def set_scene(self, path_or_text: str | os.PathLike[str]) -> None:
        """Sends a scene: a TOML file, or its text. Missing keys have the shipped scene's values."""
        self._ask("set_scene", scene=os.fspath(path_or_text))

    def set_garment(self, name_or_path: str | os.PathLike[str]) -> None:
        """Sends a garment: the name of a preset, or a TOML file. It resets gains and tare."""
        self._ask("set_garment", garment=os.fspath(name_or_path))

    def set_gains(self, gains: Sequence[float]) -> None:
        """Sets the gain of each taxel, by number: 0 to 16, in steps of 1/4096. 1 leaves its counts as they are."""
        self._ask("set_gains", gains=[float(gain) for gain in gains])

    def set_body(self, name_or_path: str | os.PathLike[str], garment: str = "reference") -> None:
        """Stores on the board where its taxels lie on the robot: a body's name, or a TOML file.

        Before the board's ``Hello`` has been read, ``garment`` names its garment. The flash of a
        board takes twelve tables, then one in five minutes.
        """
        self._ask("set_body", body=os.fspath(name_or_path), garment=garment)

    def set_poses(self, poses: Mapping[str, tuple[Sequence[float], Sequence[float]]]) -> None:
        """Sends where links of the board's body are, for contacts in the robot's frame.

        By link: its origin (m), and its rotation as a quaternion (x, y, z, w).
        """
        self._ask("set_poses", poses={link: [list(at), list(turn)] for link, (at, turn) in poses.items()})

    def set_folds(self, path: str | os.PathLike[str]) -> None:
        """Stores on the board what the garment's folds press: a file of ``taxel.folds.learn``."""
        self._ask("set_folds", folds=os.fspath(path))

    def set_pressing(self, hz: int = 65535) -> None:
        """Sets the rate of ``Pressing`` events per second, of a board that has a body; 0 is never."""
        self._ask("set_pressing", hz=hz)

    def set_gestures(
        self, model: str | None, *, gain: float | None = None, certainty: float | None = None
    ) -> None:
        """Runs a gesture model of the firmware, ``"gestures"`` or ``"intent"``; None turns it off.

        ``gain`` is the factor from the garment's counts to those of the model's training. With ``certainty``
        (0 to 0.999) a class is announced as soon as its confidence suffices.
        """
        self._ask("set_gestures", model=model, gain=gain, certainty=certainty)

    def set_forms(self, in_frame: int, *, ages: bool = True) -> None:
        """Sets of how many contacts a frame measures the form: 1 to 254, 0 for all."""
        self._ask("set_forms", in_frame=in_frame, ages=ages)

    def set_raw(self, hz: int = 65535) -> None:
        """Sets the rate of raw codes per second: 0 is the scene's, 65535 is with every scan."""
        self._ask("set_raw", hz=hz)

    def budget(self, hz: int = 1) -> None:
        """Sets the rate of ``Budget`` events per second: 0 is never, 65535 is with each frame."""
        self._ask("budget", hz=hz)

    def key_frame(self) -> None:
        """Asks for an image that depends on no earlier one."""
        self._ask("key_frame")

    def self_test(self) -> None:
        """Examines lines and inputs, and judges all taxels anew."""
        self._ask("self_test")

    def save(self) -> None:
        """Keeps garment, scene, gains and baseline in the board's flash."""
        self._ask("save")

    def reset_settings(self, *, undo: bool = False) -> None:
        """Puts the saved settings aside, or back with ``undo``; the board restarts."""
        self._ask("reset_settings", undo=undo)
