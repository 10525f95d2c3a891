"""Fuzzy cognitive maps: built, run and explained, in f64 and in the arithmetic of the board.

>>> from taxel import fcm
>>> calm = fcm.build(
...     "calm",
...     concepts=["stroke", "blow", "ease"],
...     edges=[("stroke", "ease", 0.8), ("blow", "ease", "very strong -")],
... )
>>> run = calm.run({"stroke": 1.0})
>>> run["q15"]["outcome"], round(run["f64"]["final"][2], 2)
('fixed', 0.66)
>>> why = calm.explain({"stroke": 1.0, "blow": 0.5}, of="ease")
>>> sum(part["units"] for part in why["parts"]) == why["sum_units"]
True
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from . import _taxel

__all__ = ["Map", "build", "load", "parse", "save"]

Map = _taxel.Map


def load(name_or_path: str | os.PathLike[str]) -> Map:
    """A shipped map by name (``tactile``, ``shape``), or a TOML file."""
    return Map.load(os.fspath(name_or_path))


def parse(text: str) -> Map:
    """A map from the text of its TOML file."""
    return Map.parse(text)


def build(
    name: str,
    *,
    concepts: Iterable[str | Mapping[str, Any]],
    edges: Iterable[tuple[str, str, float | str]],
    inputs: Iterable[Mapping[str, Any]] = (),
    **settings: Any,
) -> Map:
    """A map of concepts and of edges (cause, effect, weight).

    A weight is a number from -1 to 1 of at most four decimals, or a term such as ``"strong -"``. ``inputs``
    and ``settings`` are keys of a map's TOML file (``rule``, ``transfer``, ``threshold``; ``lambda`` as
    ``**{"lambda": 2}``), see docs/guides/maps.md of the project.
    """
    named = [{"name": one} if isinstance(one, str) else dict(one) for one in concepts]
    drawn = [{"from": cause, "to": effect, "weight": weight} for cause, effect, weight in edges]
    whole = {"name": name, **settings, "concept": named, "edge": drawn, "input": [dict(one) for one in inputs]}
    return Map._from_dict(whole)


def save(a_map: Map, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
    """Writes a map's TOML file."""
    with Path(path).open("w" if overwrite else "x", encoding="utf-8") as file:
        file.write(a_map.to_toml())
