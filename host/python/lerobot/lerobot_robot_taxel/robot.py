"""The plug-in: a robot of LeRobot that wraps another one."""

from __future__ import annotations

from dataclasses import dataclass, field

import taxel
from lerobot.robots import (  # type: ignore[import-not-found,unused-ignore]
    Robot,
    RobotConfig,
    make_robot_from_config,
)

from .touch import Touch
from .window import ROWS
from .wrap import Wrapped


@RobotConfig.register_subclass("taxel")
@dataclass(kw_only=True)
class TaxelRobotConfig(RobotConfig):  # type: ignore[misc,unused-ignore]
    """A robot, and its garment."""

    #: The robot.
    robot: RobotConfig
    #: Where the garment is: `usb`, `tcp:HOST:PORT`, `sim:pat` ...
    source: str = "auto"
    #: Frames of the baseline at the start; 0 for none.
    tare: int = 64
    #: Images of a window.
    rows: int = ROWS
    #: Where the garment lies on the robot, `reference` or a TOML file, and the links whose forces are observed.
    body: str | None = None
    links: list[str] = field(default_factory=list)


class TaxelRobot(Wrapped, Robot):  # type: ignore[misc,unused-ignore]
    """Any robot, with touch."""

    config_class = TaxelRobotConfig

    @property
    def name(self) -> str:
        """The type of the robot, which LeRobot writes into a data set: it says whether the touch is simulated."""
        touch = getattr(self, "touch", None)
        return "taxel_simulated" if touch and touch.simulated else "taxel"

    def __init__(self, config: TaxelRobotConfig) -> None:
        Robot.__init__(self, config)

        def open_garment() -> taxel.Board:
            return taxel.open(config.source, realtime=True, repeat=True, tare=config.tare, body=config.body)

        Wrapped.__init__(self, make_robot_from_config(config.robot), Touch(open_garment, config.rows, config.links))
