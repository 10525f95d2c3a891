"""The features of every recording of a folder, on as many cores or machines as Ray has.

    python fleet.py recordings features.parquet                     # every core of this machine
    python fleet.py recordings features.parquet --address auto      # a cluster that sees that folder
    python fleet.py recordings features.parquet --one               # this process, without Ray

Needs polars and ray. A row a recording: its file, the panel that was pressed hardest, the pressure there (counts), and
the 127 features of the second around that moment, by which gestures are recognised; or the error that came instead.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import taxel

#: Recordings of a task: enough that handing it out costs nothing beside it.
PIECE = 16
#: Seconds before and after the hardest press.
AROUND = 0.5
COLUMNS = {"file": pl.String, "panel": pl.String, "total": pl.Int64, "features": pl.List(pl.UInt16), "error": pl.String}


def hardest(recording: taxel.Recording) -> tuple[float, str, int] | None:
    """Returns when, where and how hard a contact pressed most; None if nothing touched."""
    most: tuple[float, str, int] | None = None
    for event in recording.contacts():
        if len(event.contacts):
            contact = event.contacts[np.argmax(event.contacts["total"])]
            if most is None or contact["total"] > most[2]:
                when = (event.host_ns - recording.start_ns) / 1e9
                most = (when, str(contact["panel_name"]), int(contact["total"]))
    return most


def row(folder: str, file: str) -> dict[str, Any]:
    """Returns the report of a recording."""
    try:
        recording = taxel.read(Path(folder) / file)
        found = hardest(recording)
        if found is None:
            return {"file": file}
        when, panel, total = found
        frames = recording.frames(start=when - AROUND, end=when + AROUND)
        images = [frame.panels[panel] for frame in frames if frame.decoded]
        features = taxel.features(np.stack(images)).tolist()
        return {"file": file, "panel": panel, "total": total, "features": features}
    except (OSError, taxel.Error) as error:
        return {"file": file, "error": str(error)}


def rows(folder: str, files: list[str]) -> list[dict[str, Any]]:
    """Returns the reports of some recordings."""
    return [row(folder, file) for file in files]


def by_ray(folder: str, pieces: list[list[str]], address: str | None, workers: int | None) -> list[list[dict[str, Any]]]:
    """Returns the reports of all pieces, in their order."""
    import ray

    ray.init(address=address, num_cpus=workers)
    task = ray.remote(rows)
    of_pieces: list[list[dict[str, Any]]] = ray.get([task.remote(folder, piece) for piece in pieces])
    ray.shutdown()
    return of_pieces


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="folder of the recordings; each machine sees it by this path")
    parser.add_argument("output", help="table to write (.parquet)")
    parser.add_argument("--address", help="a Ray cluster: auto, HOST:PORT, ray://HOST:PORT")
    parser.add_argument("--workers", type=int, help="cores of this machine to use, without a cluster")
    parser.add_argument("--one", action="store_true", help="no Ray: this process alone")
    args = parser.parse_args()
    folder = str(Path(args.folder).resolve())
    files = sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*.mcap"))
    pieces = [files[at : at + PIECE] for at in range(0, len(files), PIECE)]
    if args.one:
        found = [rows(folder, piece) for piece in pieces]
    else:
        found = by_ray(folder, pieces, args.address, args.workers)
    table = pl.DataFrame([row for piece in found for row in piece], schema=COLUMNS)
    table.write_parquet(args.output)
    print(f"{args.output}: {len(table)} recordings, {table['error'].count()} of them not read")


if __name__ == "__main__":
    main()
