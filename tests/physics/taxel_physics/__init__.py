"""A robot in MuJoCo that carries a taxel garment: contacts and folds as newtons on each taxel.

The solver of a simulator that nobody of this project wrote says what presses where.
:mod:`~taxel_physics.spread` spreads that over the taxels, whose places the program ``taxel`` gives, and
:mod:`~taxel_physics.fabric` makes codes of it for ``taxel.VirtualBoard``.
"""

from .crease import Creases
from .fabric import FORCES, Chain, Fabric, Sensor
from .pattern import Pattern
from .places import BODIES, GARMENTS, Places, places
from .presses import Press, press, random_presses
from .robot import OBJECTS, World, bent, reference
from .spread import Spread, spread
from .touch import Touch, touches
from .wrench import Wrench, wrench

__all__ = [
    "BODIES",
    "FORCES",
    "GARMENTS",
    "OBJECTS",
    "Chain",
    "Creases",
    "Fabric",
    "Pattern",
    "Places",
    "Press",
    "Sensor",
    "Spread",
    "Touch",
    "World",
    "Wrench",
    "bent",
    "places",
    "press",
    "random_presses",
    "reference",
    "spread",
    "touches",
    "wrench",
]
