"""Prints what touches, and what is meant by it: `python touches.py usb`, or `sim:lash` without a board."""

from __future__ import annotations

import sys

import numpy as np
import taxel


def main(source: str) -> None:
    leading = "none"
    with taxel.open(source) as board:
        for event in board:
            if isinstance(event, taxel.Contacts) and len(event.contacts):
                hardest = event.contacts[np.argmax(event.contacts["total"])]
                place = f"{hardest['panel_name']} at ({hardest['column']:.1f}, {hardest['row']:.1f})"
                print(f"{event.time_us / 1e6:.3f} s: {hardest['total']} counts on {place}")
            elif isinstance(event, taxel.Intent) and event.leading != leading:
                leading = event.leading
                print(f"{event.time_us / 1e6:.3f} s: {leading}")
            elif isinstance(event, taxel.Lost):
                print(event.why, file=sys.stderr)
            elif isinstance(event, taxel.Back):
                print(event.how, file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "sim:pat")
