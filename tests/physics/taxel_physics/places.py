"""Where the taxels lie, as the program ``taxel`` says it.

This package never computes a place: what it judges would otherwise be judged by its own twin.
"""

from __future__ import annotations

import csv
import io
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

BODIES, GARMENTS = (Path(__file__).parent / kind for kind in ("bodies", "garments"))
"""Files of bodies and of garments of this package."""


@dataclass(frozen=True)
class Places:
    """Places of a garment's taxels on the robot's links."""

    links: tuple[str, ...]
    """Names of the links that taxels lie on."""
    link: npt.NDArray[np.intp]
    """(taxels,) Index into ``links``; -1 for a taxel without a place."""
    at: Array
    """(taxels, 3) Centre in the link's frame, m."""
    normal: Array
    """(taxels, 3) Direction away from the robot there, of length 1."""

    def on(self, link: str) -> npt.NDArray[np.intp]:
        """Numbers of the taxels on a link, rising; none on a link that carries nothing."""
        if link not in self.links:
            return np.empty(0, np.intp)
        return np.flatnonzero(self.link == self.links.index(link))

    @property
    def taxels(self) -> int:
        """Number of taxels."""
        return len(self.link)


def places(
    body: str | Path = "reference", taxels: int = 2048, garment: str | Path = "reference"
) -> Places:
    """Places of a body and its garment, each a preset's name or a TOML file.

    ``taxels`` is the garment's number of taxels. Raises ``RuntimeError`` with the program's own words.
    """
    words = [sys.executable, "-m", "taxel", "body", "places", str(body), "--garment", str(garment)]
    words += ["-o", "-"]
    done = subprocess.run(words, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return parse(done.stdout, taxels)


def parse(text: str, taxels: int) -> Places:
    """Reads the table of ``taxel body places``."""
    links: list[str] = []
    link = np.full(taxels, -1, np.intp)
    at, normal = np.zeros((taxels, 3)), np.zeros((taxels, 3))
    for row in csv.DictReader(io.StringIO(text)):
        taxel = int(row["taxel"])
        if row["link"] not in links:
            links.append(row["link"])
        link[taxel] = links.index(row["link"])
        at[taxel] = [float(row[key]) for key in ("x", "y", "z")]
        normal[taxel] = [float(row[key]) for key in ("nx", "ny", "nz")]
    return Places(tuple(links), link, at, normal)
