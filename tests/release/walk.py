"""Walks through a program that is given away, as a user would: it starts, simulates, records, ends by Ctrl-C, survives a
kill, repairs, shows, exports, and refuses in sentences. `walk.py [RUNNER...] PROGRAM`; RUNNER is wine or an emulator.

Prints what it took. The first step that does not hold ends it with an error."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path

# Longest time of a step, s: an emulator is slow.
PATIENCE_S = 120.0
# Words of the programming language, or of a crash, that must not reach the user.
FOREIGN = ("panicked", "os error", "Err(", "RUST_BACKTRACE", "unwrap()")


class Walk:
    def __init__(self, command: list[str], folder: Path) -> None:
        self.command = command
        self.folder = folder

    def run(self, *words: str, status: int = 0, says: str = "") -> str:
        """Runs the program; returns all that it said."""
        start = time.monotonic()
        done = subprocess.run(
            [*self.command, *words], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE_S
        )
        said = (done.stdout + done.stderr).decode(errors="replace")
        shown = f"taxel {' '.join(words)}"
        check(done.returncode == status, f"{shown}: status {done.returncode}, not {status}: {said[-2000:]}")
        check(says in said, f"{shown}: it does not say {says!r}: {said[-2000:]}")
        foreign = [word for word in FOREIGN if word in said]
        check(not foreign, f"{shown}: {foreign}: {said[-2000:]}")
        print(f"{time.monotonic() - start:6.2f} s  {shown}")
        return said

    def start(self, *words: str, terminal: int = subprocess.DEVNULL) -> "subprocess.Popen[str]":
        own = [] if terminal == subprocess.DEVNULL else ["setsid", "--ctty"]
        return subprocess.Popen(
            [*own, *self.command, *words],
            cwd=self.folder,
            stdin=terminal,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            errors="replace",
            # On Windows a group of its own is what can be interrupted alone.
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )

    def first_contact(self) -> None:
        """Seconds from the command to the first contact and to the first picture."""
        start = time.monotonic()
        seen: dict[str, float] = {}
        with self.start("live", "sim:pat", "--json") as live:
            for line in live.stdout or []:
                for kind in ("frame", "contacts"):
                    if f'"type":"{kind}"' in line and kind not in seen:
                        seen[kind] = time.monotonic() - start
                if len(seen) == 2:
                    break
            live.kill()
        check(len(seen) == 2, f"live --json: only {seen} came")
        print(", ".join(f"first {kind} after {at:.2f} s" for kind, at in seen.items()))

    def recording(self, name: str, terminal: int = subprocess.DEVNULL) -> "subprocess.Popen[str]":
        """Begins a recording of an hour; returns once some of it is written."""
        record = self.start("record", "sim:pat", "-o", name, "--for", "1h", "--realtime", terminal=terminal)
        file = self.folder / name
        wait(lambda: file.exists() and file.stat().st_size > 50_000, f"{name} grows")
        return record

    def interrupted(self) -> None:
        """Ctrl-C ends a recording that is whole."""
        if sys.platform != "win32" and self.command[0] == "wine":
            # Wine hands it on from a terminal alone.
            keyboard, terminal = os.openpty()
            record = self.recording("interrupted.mcap", terminal)
            os.write(keyboard, b"\x03")
        else:
            record = self.recording("interrupted.mcap")
            record.send_signal(getattr(signal, "CTRL_BREAK_EVENT", signal.SIGINT))
        said = record.communicate(timeout=PATIENCE_S)[0]
        check(record.returncode == 0, f"Ctrl-C: status {record.returncode}: {said}")
        self.run("info", "interrupted.mcap", "--check")

    def killed(self) -> None:
        """A recording that is killed loses nothing that was written."""
        record = self.recording("killed.mcap")
        record.kill()
        record.wait()
        self.run("info", "killed.mcap", says="repair")
        self.run("info", "killed.mcap", "--repair")
        self.run("info", "killed.repaired.mcap", "--check")

    def page(self, recording: str) -> None:
        """The page answers, by the address that the command prints."""
        start = time.monotonic()
        with self.start("view", recording, "--port", "0") as view:
            address = ""
            for line in view.stdout or []:
                words = [word for word in line.split() if word.startswith("http://")]
                if words:
                    address = words[0].rstrip(".,;")
                    break
            check(bool(address), "view: it names no address")
            wait(lambda: "<html" in fetched(address).lower(), f"{address} answers")
            print(f"{time.monotonic() - start:6.2f} s  taxel view {recording}: {address.split('?')[0]} answers")
            view.kill()

    def all(self) -> None:
        self.run("--version", says="taxel ")
        self.first_contact()
        self.run("record", "sim:pat", "-o", "pat.mcap", "--for", "2s")
        self.run("record", "sim:pat", "-o", "pat.mcap", "--for", "2s", status=1, says="--force")
        self.run("record", "sim:pat", "-o", "pat.mcap", "--for", "2s", "--force")
        self.run("info", "pat.mcap", "--check")
        self.interrupted()
        self.killed()
        self.page("pat.mcap")
        self.run("export", "pat.mcap", "--to", "csv", "-o", "pat.csv", "--contacts")
        self.run("export", "pat.mcap", "--to", "npz", "-o", "pat.npz")
        # A folder is begun, and replaced as a whole.
        self.run("export", "pat.mcap", "--to", "png", "-o", "images", "--every", "100")
        self.run("export", "pat.mcap", "--to", "png", "-o", "images", "--every", "50", "--force")
        self.run("report", "pat.mcap", "-o", "pat.html")
        self.run("live", "pat.mcap", "--json")
        self.run("ports")
        self.run("live", "serial:COM99", status=3, says="no such port")
        self.run("live", "absent.mcap", status=1, says="absent.mcap cannot be read: no such file or directory")
        self.run("record", "sim:pat", "-o", "none/pat.mcap", status=1, says="none")
        left = sorted(path.name for path in self.folder.iterdir() if path.name.endswith(".part"))
        check(not left, f"left behind: {left}")


def fetched(address: str) -> str:
    try:
        with urllib.request.urlopen(address, timeout=5) as answer:
            text: str = answer.read().decode()
            return text
    except (urllib.error.URLError, OSError):
        return ""


def wait(holds: Callable[[], bool], what: str) -> None:
    end = time.monotonic() + PATIENCE_S
    while not holds():
        check(time.monotonic() < end, f"waited in vain: {what}")
        time.sleep(0.05)


def check(holds: bool, why: str) -> None:
    if not holds:
        sys.exit(why)


def main(words: list[str]) -> None:
    command = [*words[:-1], str(Path(words[-1]).absolute())]
    with tempfile.TemporaryDirectory() as folder:
        Walk(command, Path(folder)).all()
    print("the walk is done")


if __name__ == "__main__":
    main(sys.argv[1:])
