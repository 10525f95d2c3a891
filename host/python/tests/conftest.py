"""What the tests share."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest


def program(*words: str) -> str:
    """Returns what the command prints."""
    done = subprocess.run([sys.executable, "-m", "taxel", *words], check=True, capture_output=True, text=True)
    return done.stdout


@pytest.fixture(scope="session")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Four seconds of a pat, with raw codes in the second half."""
    folder = tmp_path_factory.mktemp("recording")
    file = folder / "pat.mcap"
    program("record", "--source", "sim:pat", "--for", "4s", "-o", str(file))
    return file
