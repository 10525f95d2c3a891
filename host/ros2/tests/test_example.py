"""The example, run."""

import os
import subprocess
import sys

from conftest import EXAMPLES, taxel


def test_the_example_prints_touches(listener):
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    example = subprocess.Popen(
        [sys.executable, EXAMPLES / "touches.py"], stdout=subprocess.PIPE, text=True, env=environment
    )
    wanted = ["m of tactile/back", " ends after ", "intention: kindness"]
    try:
        with taxel("--source", "sim:pat"):
            # Three rounds of the pat; a round ends with one intention.
            for _, line in zip(range(60), example.stdout):
                wanted = [words for words in wanted if words not in line]
                if not wanted:
                    break
    finally:
        example.kill()
    assert not wanted
