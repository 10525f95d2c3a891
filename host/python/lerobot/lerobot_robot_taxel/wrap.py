"""A robot with touch: any robot's interface, with the garment's observations beside its own."""

from __future__ import annotations

from typing import Any

from . import schema
from .touch import Touch


class Wrapped:
    """Hands everything on to a robot, and adds touch to what it observes."""

    def __init__(self, robot: Any, touch: Touch) -> None:
        self.inner = robot
        self.touch = touch

    @property
    def observation_features(self) -> dict[str, Any]:
        """The robot's, and the numbers of touch."""
        return {**self.inner.observation_features, **schema.observation_features(self.touch.panels, self.touch.links)}

    @property
    def action_features(self) -> dict[str, Any]:
        """The robot's."""
        return dict(self.inner.action_features)

    @property
    def cameras(self) -> dict[str, Any]:
        """The robot's, which LeRobot's recorder counts."""
        return dict(getattr(self.inner, "cameras", {}))

    @property
    def is_connected(self) -> bool:
        """True if both are."""
        return bool(self.inner.is_connected) and self.touch.is_connected

    @property
    def is_calibrated(self) -> bool:
        """True if the robot is: a garment needs none."""
        return bool(self.inner.is_calibrated)

    def connect(self, calibrate: bool = True) -> None:
        """Connects both, the garment first: a robot that moves without its touch is of no use."""
        self.touch.connect()
        try:
            self.inner.connect(calibrate)
        except BaseException:
            self.touch.disconnect()
            raise

    def disconnect(self) -> None:
        """Disconnects both."""
        try:
            self.inner.disconnect()
        finally:
            self.touch.disconnect()

    def calibrate(self) -> None:
        """Calibrates the robot."""
        self.inner.calibrate()

    def configure(self) -> None:
        """Configures the robot."""
        self.inner.configure()

    def get_observation(self) -> dict[str, Any]:
        """The robot's observation, and the touch since the last one."""
        return {**self.inner.get_observation(), **schema.observation(self.touch.observe())}

    def send_action(self, action: dict[str, Any]) -> Any:
        """Sends an action to the robot."""
        return self.inner.send_action(action)
