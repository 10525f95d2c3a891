"""The command ``taxel``, also as ``python -m taxel``."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Runs the command line; returns the exit status."""
    try:
        from ._taxel import run_program
    except ImportError:
        print("error: this build of the package has no command", file=sys.stderr)
        return 1
    # Commands take Ctrl-C themselves, or end by it; Python would wait for them.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run_program(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
