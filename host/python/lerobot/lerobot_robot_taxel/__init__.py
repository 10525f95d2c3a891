"""Touch for LeRobot: importing this registers the robot `taxel`, if LeRobot is installed."""

from __future__ import annotations

import importlib.util

from .recorded import observations
from .touch import Seen, Touch
from .window import ROWS, Window, Windows
from .wrap import Wrapped

__all__ = ["ROWS", "Seen", "Touch", "Window", "Windows", "Wrapped", "observations"]


def _has_lerobot() -> bool:
    try:
        return importlib.util.find_spec("lerobot.robots") is not None
    except ModuleNotFoundError:
        return False


if _has_lerobot():
    from .robot import TaxelRobot, TaxelRobotConfig

    __all__ += ["TaxelRobot", "TaxelRobotConfig"]
