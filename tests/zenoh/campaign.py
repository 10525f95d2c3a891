"""Boards between machines: what arrives, how late, and what happens when something breaks.

`cargo xtask campaign --only zenoh` runs this as root with the program and with that of `tests/bench`; it prints one
line for each case, and fails if something wrong was delivered, a count was off, or contacts were late on a clean
cable."""

import json
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import machines
import wire

PROGRAM, TAP = sys.argv[1:3]
HERE = Path(__file__).parent
EXAMPLES = HERE.parent.parent / "examples/zenoh"
BOARD = "arm/left"
SCENE = "sim:five"
#: Most that contacts may be late on a clean cable, ms.
LATE_MS = 10.0
#: Addresses of the routers: for the board, for the viewers, and from one to the other by cable and by relay.
RA, RB, CABLE, RELAY = "10.77.1.2", "10.77.4.1", "10.77.2.2", "10.77.3.2"


@dataclass
class Process:
    """A program on a machine, and the lines that it has said, each with its time."""

    process: "subprocess.Popen[str]"
    lines: list[tuple[float, str]] = field(default_factory=list)
    reader: threading.Thread | None = None

    @staticmethod
    def start(machine: str, *words: str) -> "Process":
        pipe, out = subprocess.PIPE, subprocess.STDOUT
        process = subprocess.Popen(machines.on(machine, *words), stdout=pipe, stderr=out, text=True, bufsize=1)
        made = Process(process)
        made.reader = threading.Thread(target=made.read, daemon=True)
        made.reader.start()
        return made

    def read(self) -> None:
        assert self.process.stdout
        for line in self.process.stdout:
            self.lines.append((time.time(), line.rstrip("\n")))

    def said(self, words: str, since: float = 0.0) -> float | None:
        """When it has said these words first since a time."""
        return next((at for at, line in list(self.lines) if at >= since and words in line), None)

    def wait_for(self, words: str, longest: float = 15.0) -> float:
        until = time.time() + longest
        while time.time() < until:
            if (at := self.said(words)) is not None:
                return at
            time.sleep(0.02)
        raise SystemExit(f"{self.process.args!r}: has not said {words!r}: {self.lines[-5:]}")

    def end(self, how: signal.Signals = signal.SIGINT, longest: float = 20.0) -> int:
        if self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(longest)
        if self.reader:
            self.reader.join(5)
        return code


class Stage:
    """Routers, a board that is offered, and who follows it."""

    def __init__(self, folder: Path, between: str = CABLE) -> None:
        self.folder, self.between = folder, between
        self.all: list[Process] = []
        self.rb = self.router("rb")
        self.ra = self.router("ra")

    def file(self, name: str, settings: object) -> str:
        path = self.folder / f"{name}.json5"
        path.write_text(settings if isinstance(settings, str) else json.dumps(settings))
        return str(path)

    def start(self, machine: str, *words: str) -> Process:
        process = Process.start(machine, *words)
        self.all.append(process)
        return process

    def router(self, machine: str) -> Process:
        connect = [f"tcp/{self.between}:7447"] if machine == "ra" else []
        settings = {
            "mode": "router",
            "listen": {"endpoints": ["tcp/0.0.0.0:7447"]},
            "connect": {"endpoints": connect},
            "scouting": {"multicast": {"enabled": False}},
        }
        router = self.start(machine, sys.executable, str(HERE / "router.py"), self.file(machine, settings))
        router.wait_for("ready")
        return router

    def client(self, name: str, router: str) -> str:
        settings = {"mode": "client", "connect": {"endpoints": [f"tcp/{router}:7447"]}}
        return self.file(name, settings | {"timestamping": {"enabled": True}})

    def serve(self, machine: str, router: str, seed: int, truth: Path, *more: str) -> Process:
        config = self.client(f"serve-{machine}", router)
        tap = self.start(machine, TAP, "tap", SCENE, str(seed), str(truth))
        tap.wait_for("port ")
        source = f"tcp:127.0.0.1:{tap.lines[0][1].removeprefix('port ')}"
        words = ["serve", "--source", source, "--name", BOARD, "--zenoh", config]
        return self.start(machine, PROGRAM, *words, *more)

    def record(self, recording: Path) -> Process:
        source = f"zenoh:{BOARD}@{self.client('viewer', RB)}"
        return self.start("viewer", PROGRAM, "record", "--source", source, "-o", str(recording), "--force")

    def lines(self) -> Process:
        source = f"zenoh:{BOARD}@{self.client('viewer', RB)}"
        return self.start("viewer", PROGRAM, "live", "--source", source, "--json")

    def listen(self, machine: str, config: str, what: str) -> Process:
        return self.start(machine, sys.executable, str(HERE / "listen.py"), config, what)

    def end(self) -> None:
        for process in reversed(self.all):
            process.end(signal.SIGKILL)


@dataclass
class Judged:
    """What a viewer got, beside what the board has sent."""

    main: int
    images: int
    lost_main: int
    lost_images: int
    parts: int

    def __str__(self) -> str:
        got = f"{self.main:,} frames without and {self.images:,} with an image arrived"
        return f"{got}, {self.lost_main} and {self.lost_images} lost; none wrong, count exact"


def program(*words: str) -> str:
    """What the program prints."""
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout


def judged(recording: Path, truths: list[Path]) -> Judged:
    """Compares; fails if a frame was changed, out of order or twice, or the count of losses is off."""
    counted = json.loads(program("info", str(recording), "--json"))
    saved = recording.with_suffix(".saved")
    subprocess.run([TAP, "wire", str(recording), str(saved)], check=True)
    boards = [{frame.seq: frame for frame in wire.frames(truth)[0]} for truth in truths]
    got, damaged = wire.frames(saved)
    # A recording begins with a Hello of its own.
    if got and got[0].report == wire.HELLO:
        got = got[1:]
    if damaged:
        raise SystemExit(f"{damaged} damaged frames were delivered")
    is_image = [frame.report in wire.IMAGES for frame in got]
    lost_main = lost_images = parts = 0
    before: tuple[int, int] | None = None
    for frame in got:
        homes = [n for n, board in enumerate(boards) if board.get(frame.seq) == frame]
        # Two boards may say the same: it is of the one that goes on.
        home = before[0] if before and before[0] in homes and frame.seq > before[1] else next(iter(homes), None)
        if home is None:
            raise SystemExit(f"frame {frame.seq} was never sent")
        if before and before[0] == home:
            if frame.seq <= before[1]:
                raise SystemExit(f"frame {frame.seq} came after {before[1]}")
            missing = [boards[home][seq] for seq in range(before[1] + 1, frame.seq) if seq in boards[home]]
            images = sum(1 for gone in missing if gone.report in wire.IMAGES)
            lost_images += images
            lost_main += frame.seq - before[1] - 1 - images
        else:
            parts += 1
        before = (home, frame.seq)
    if counted["refused"] or counted["lost"] != lost_main + lost_images:
        raise SystemExit(f"the viewer counts {counted} of {lost_main + lost_images} lost")
    return Judged(len(got) - sum(is_image), sum(is_image), lost_main, lost_images, parts)


def spread(late: list[float]) -> str:
    """Median, 99th percentile and most, ms."""
    late = sorted(late)
    at = [late[len(late) // 2], late[min(len(late) - 1, len(late) * 99 // 100)], late[-1]]
    return "{:.1f}, {:.1f} and {:.1f} ms (median, p99, most)".format(*at)


def lateness(listener: Process, lines: Process) -> tuple[list[float], list[float]]:
    """Ms from the sending of contacts to Zenoh's client, and to the line of a viewer, on another machine."""
    reported = [json.loads(line) for _, line in listener.lines if line.startswith('{"scan"')]
    put = {contacts["scan"]: contacts["put"] for contacts in reported}
    to_line = []
    for at, line in lines.lines:
        # The last line may be cut off.
        contacts = json.loads(line) if line.startswith("{") and line.endswith("}") else {}
        if contacts.get("type") == "contacts" and contacts["frame"] in put:
            to_line.append((at - put[contacts["frame"]]) * 1000)
    return [(contacts["came"] - contacts["put"]) * 1000 for contacts in reported], to_line


def followed(
    folder: Path, seconds: float, trouble: Callable[[Stage], None], between: str = CABLE, timed: bool = True
) -> tuple[Judged, Process, str]:
    """Follows the board for a while, during which there is trouble. Returns what has come, and how late."""
    stage = Stage(folder, between)
    try:
        truth, recording = folder / "truth", folder / "recording.mcap"
        server = stage.serve("board", RA, 1, truth)
        server.wait_for("Ctrl-C")
        time.sleep(3)
        viewer = stage.record(recording)
        listener = lines = None
        if timed:
            listener = stage.listen("viewer", stage.client("listener", RB), "contacts")
            listener.wait_for("ready")
            lines = stage.lines()
        time.sleep(2)
        until = time.time() + seconds
        trouble(stage)
        time.sleep(max(0.0, until - time.time()))
        viewer.end()
        times = ""
        if listener and lines:
            lines.end(signal.SIGKILL)
            by_zenoh, to_line = lateness(listener, lines)
            times = f"; contacts at Zenoh's client after {spread(by_zenoh)}, at a viewer's line after {spread(to_line)}"
            late = sorted(to_line)[len(to_line) * 99 // 100]
            if trouble is calm and between == CABLE and late > LATE_MS:
                raise SystemExit(f"contacts are late on a clean cable{times}")
        server.end()
        return judged(recording, [truth]), viewer, times
    finally:
        stage.end()


def calm(_: Stage) -> None:
    """No trouble."""


def clean(folder: Path) -> str:
    result, _, times = followed(folder, 30, calm)
    if result.lost_main:
        raise SystemExit(f"something was lost on a clean cable: {result}")
    return f"clean cable, 30 s: {result}{times}"


def losses(folder: Path) -> str:
    def trouble(_: Stage) -> None:
        machines.lose(5)
        time.sleep(28)
        machines.lose(0)

    result, _, times = followed(folder, 34, trouble)
    return f"5 % of the packets lost each way, 28 of 34 s: {result}{times}"


def jitter(folder: Path) -> str:
    relay = machines.relay(50)
    try:
        result, _, times = followed(folder, 30, calm, RELAY)
    finally:
        relay.kill()
    return f"up to 50 ms of jitter each way, 30 s: {result}{times}"


def gone_and_back(viewer: Process, broken: float, mended: float) -> str:
    gone, back = viewer.said("is gone", broken), viewer.said("is back", mended)
    said_gone = f"gone after {gone - broken:.1f} s" if gone else "nothing, as it went on"
    said_back = f", back {back - mended:.1f} s after the repair" if back else ""
    return f"the viewer says {said_gone}{said_back}"


def router_killed(folder: Path) -> str:
    at = []

    def trouble(stage: Stage) -> None:
        time.sleep(5)
        stage.rb.end(signal.SIGKILL)
        at.append(time.time())
        time.sleep(5)
        stage.rb = stage.router("rb")
        at.append(time.time())

    result, viewer, _ = followed(folder, 40, trouble, timed=False)
    return f"the viewer's router killed, and another one 5 s later: {gone_and_back(viewer, *at)}; {result}"


def cable_cut(folder: Path) -> str:
    at = []

    def trouble(_: Stage) -> None:
        time.sleep(5)
        machines.cut()
        at.append(time.time())
        time.sleep(30)
        machines.mend()
        at.append(time.time())

    result, viewer, _ = followed(folder, 70, trouble, timed=False)
    return f"the cable between the routers cut for 30 s: {gone_and_back(viewer, *at)}; {result}"


def two_publishers(folder: Path) -> str:
    stage = Stage(folder)
    try:
        truths, recording = [folder / "truth", folder / "other"], folder / "recording.mcap"
        first = stage.serve("board", RA, 1, truths[0])
        first.wait_for("Ctrl-C")
        time.sleep(3)
        second = stage.serve("other", RB, 2, truths[1])
        second.wait_for("is offered by another program")
        refused = second.end()
        viewer = stage.record(recording)
        time.sleep(6)
        machines.cut()
        # The routers need their lease of 10 s to know that the cable is cut.
        time.sleep(15)
        second = stage.serve("other", RB, 2, truths[1])
        second.wait_for("Ctrl-C")
        time.sleep(12)
        machines.mend()
        viewer.wait_for("it is offered twice", 40)
        time.sleep(5)
        viewer.end()
        reported = [end.said("is offered by another program, too") is not None for end in (first, second)]
        second.end()
        first.end()
        result = judged(recording, truths)
    finally:
        stage.end()
    if refused != 2 or not all(reported) or result.parts != 2:
        raise SystemExit(f"two publishers: status {refused}, reported {reported}, {result}")
    return (
        "two publishers of one name: the second is refused at its start (status 2); begun while the cable is cut, both go "
        f"on and say so, and the viewer goes over to the one that it reaches and stays with it: {result}"
    )


def rights(folder: Path) -> str:
    """The rules of `examples/zenoh`, with addresses of these machines."""
    users = folder / "users.txt"
    users.write_text((EXAMPLES / "users.txt").read_text() + "guest:guest\n")
    rules = (EXAMPLES / "rules.json5").read_text().replace('"users.txt"', json.dumps(str(users)))
    by_user = (EXAMPLES / "user.json5").read_text().replace("192.0.2.1", RB)
    stage = Stage.__new__(Stage)
    stage.folder, stage.between, stage.all = folder, CABLE, []

    def config(name: str, user: str, password: str) -> str:
        text = by_user.replace('"viewer"', f'"{user}"').replace('"look"', f'"{password}"')
        return stage.file(name, text)

    try:
        stage.start("rb", sys.executable, str(HERE / "router.py"), stage.file("rules", rules)).wait_for("ready")
        words = ["serve", "--source", SCENE, "--name", BOARD, "--zenoh", config("board", "board", "serve")]
        stage.start("board", PROGRAM, *words).wait_for("Ctrl-C")
        time.sleep(3)
        source = f"zenoh:{BOARD}@{config('user', 'viewer', 'look')}"
        viewer = stage.start("viewer", PROGRAM, "live", "--source", source, "--for", "12s")
        plain = stage.client("stranger", RB)
        reported = {}
        for name, file in {"stranger": plain, "wrong": config("wrong", "viewer", "x"), "guest": config("guest", "guest", "guest")}.items():
            asked = stage.listen("other", file, "all")
            asked.process.wait(40)
            asked.end()
            reported[name] = json.loads([line for _, line in asked.lines if line.startswith("{")][-1])
        viewer.end(signal.SIGCONT, longest=60)
        end = next((line for _, line in viewer.lines if line.startswith("end: ")), None)
    finally:
        stage.end()
    if not end or " 0 refused" not in end:
        raise SystemExit(f"a viewer with rights gets nothing: {viewer.lines[-5:]}")
    if any("refused" not in reported[name] for name in ("stranger", "wrong")) or any(reported["guest"].values()):
        raise SystemExit(f"without rights: {reported}")
    return (
        "rules of examples/zenoh, tried with Zenoh's Python client: without a name or with a wrong password it is not let "
        "in; with a name that has no rule it gets 0 samples, replies and signs of life, and what it publishes reaches "
        f"nobody; a viewer with rights: {end.removeprefix('end: ')}"
    )


def certificates(folder: Path) -> None:
    """An authority, and what it has signed for the router, and for a board."""

    def openssl(*words: str) -> None:
        subprocess.run(["openssl", *words], cwd=folder, check=True, capture_output=True)

    key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    authority = ("-x509", "-days", "2", "-subj", "/CN=authority", "-keyout", "ca-key.pem", "-out", "ca.pem")
    openssl("req", *key, *authority)
    for name, ends in (("router", f"IP:{RB}"), ("board", "DNS:board")):
        openssl("req", *key, "-subj", f"/CN={name}", "-keyout", f"{name}-key.pem", "-out", f"{name}.csr")
        (folder / f"{name}.ext").write_text(f"subjectAltName={ends}\n")
        signed = ("-CA", "ca.pem", "-CAkey", "ca-key.pem", "-CAcreateserial", "-days", "2")
        openssl("x509", "-req", "-in", f"{name}.csr", *signed, "-extfile", f"{name}.ext", "-out", f"{name}.pem")


def tls(folder: Path) -> str:
    """The example of TLS, with certificates of this machine."""
    certificates(folder)
    example = (EXAMPLES / "tls.json5").read_text().replace("router.example", RB)
    for name in ("ca.pem", "board.pem", "board-key.pem"):
        example = example.replace(f'"{name}"', json.dumps(str(folder / name)))
    keys = {
        "root_ca_certificate": str(folder / "ca.pem"),
        "listen_certificate": str(folder / "router.pem"),
        "listen_private_key": str(folder / "router-key.pem"),
        "enable_mtls": True,
    }
    router = {
        "mode": "router",
        "listen": {"endpoints": ["tls/0.0.0.0:7447"]},
        "scouting": {"multicast": {"enabled": False}},
        "transport": {"link": {"tls": keys}},
    }
    stage = Stage.__new__(Stage)
    stage.folder, stage.between, stage.all = folder, CABLE, []
    try:
        stage.start("rb", sys.executable, str(HERE / "router.py"), stage.file("tls-router", router)).wait_for("ready")
        config = stage.file("tls", example)
        words = ["serve", "--source", SCENE, "--name", BOARD, "--zenoh", config]
        stage.start("board", PROGRAM, *words).wait_for("Ctrl-C")
        time.sleep(3)
        source = f"zenoh:{BOARD}@{config}"
        viewer = stage.start("viewer", PROGRAM, "live", "--source", source, "--for", "5s")
        viewer.process.wait(40)
        viewer.end()
        # Who has no certificate of the authority is not let in.
        bare = re.sub(r"enable_mtls.*\n.*\n.*\n", "", example)
        asked = stage.listen("other", stage.file("bare", bare), "all")
        asked.process.wait(40)
        asked.end()
    finally:
        stage.end()
    end = next((line for _, line in viewer.lines if line.startswith("end: ")), None)
    reported = [json.loads(line) for _, line in asked.lines if line.startswith("{")]
    if not end or " 0 refused" not in end or "refused" not in reported[-1]:
        raise SystemExit(f"TLS: {viewer.lines[-5:]}, {reported}")
    return f"TLS of examples/zenoh: who has no certificate is not let in; a viewer with one: {end.removeprefix('end: ')}"


CASES = (clean, losses, jitter, router_killed, cable_cut, two_publishers, rights, tls)


def main() -> None:
    wanted = sys.argv[3:]
    for case in CASES:
        if wanted and case.__name__ not in wanted:
            continue
        machines.make()
        try:
            with tempfile.TemporaryDirectory() as folder:
                print(case(Path(folder)), flush=True)
        finally:
            machines.remove()


main()
