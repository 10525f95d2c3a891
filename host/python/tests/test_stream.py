"""`taxel.open`: events, arrays, requests, the wait."""

from __future__ import annotations

import json
import os
import resource
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
import taxel
from conftest import program

SCENES = ["pat", "lash", "hold", "two-hands", "five"]


@pytest.mark.parametrize("scene", SCENES)
def test_events_are_the_lines_of_the_program(scene: str) -> None:
    lines = program("live", "--source", f"sim:{scene}", "--frames", "300", "--json").splitlines()
    with taxel.open(f"sim:{scene}", frames=300) as board:
        events = list(board)
    assert [event.json() for event in events] == lines
    assert [event.to_dict() for event in events] == [json.loads(line) for line in lines]
    assert len(lines) > 300


def test_images_are_the_pixels_of_the_program() -> None:
    lines = program("live", "--source", "sim:five", "--frames", "200", "--json", "--pixels").splitlines()
    reported = [line for line in map(json.loads, lines) if line["type"] == "frame"]
    with taxel.open("sim:five", frames=200) as board:
        frames = [event for event in board if isinstance(event, taxel.Frame)]
    assert len(frames) == len(reported) == 200
    for frame, line in zip(frames, reported, strict=True):
        assert list(frame.panels) == [panel["name"] for panel in line["panels"]]
        for panel in line["panels"]:
            assert frame.panels[panel["name"]].tolist() == panel["rows"]
        assert frame.image is not None and frame.image.size == sum(p.size for p in frame.panels.values())


def test_arrays_stay_as_they_were() -> None:
    kept: list[tuple[npt.NDArray[np.uint16], bytes]] = []
    with taxel.open("sim:five", frames=400) as board:
        for event in board:
            if isinstance(event, taxel.Frame) and event.image is not None:
                kept.append((event.image, event.image.tobytes()))
    assert all(image.tobytes() == before for image, before in kept)
    assert len({before for _, before in kept}) > 100
    for image, _ in (kept[0], kept[-1]):
        assert image.dtype == np.uint16 and image.flags.c_contiguous and not image.flags.writeable
        with pytest.raises(ValueError):
            image[0] = 1
        with pytest.raises(ValueError):
            image.flags.writeable = True


def test_an_image_is_not_copied() -> None:
    with taxel.open("sim:pat", frames=1) as board:
        frame = next(event for event in board if isinstance(event, taxel.Frame))
    assert frame.image is not None
    address = frame.image.__array_interface__["data"][0]
    assert frame.image.__array_interface__["data"][0] == address
    back = frame.panels["back"]
    assert np.shares_memory(back, frame.image) and back.shape == (32, 16) and not back.flags.writeable


def test_contacts_are_structured() -> None:
    assert set(taxel.CONTACT.names or ()) >= {"id", "phase", "panel_name", "column", "row", "x_mm", "y_mm", "nmi", "slip"}
    seen = 0
    with taxel.open("sim:five", frames=300) as board:
        for event in board:
            if not isinstance(event, (taxel.Contacts, taxel.Frame)):
                continue
            assert event.contacts.dtype == taxel.CONTACT and not event.contacts.flags.writeable
            for record, reported in zip(event.contacts, event.to_dict()["contacts"], strict=True):
                seen += 1
                for name in taxel.CONTACT.names or ():
                    value = record[name].item()
                    absent = -1 if name == "form_age" else None
                    want = reported.get(name, absent)
                    assert value == want or (want is None and np.isnan(value)), name
    assert seen > 500


def test_both_clocks() -> None:
    before = time.time_ns()
    with taxel.open("sim:pat", frames=50) as board:
        events = list(board)
    times = [event.time_us for event in events if isinstance(event, taxel.Frame)]
    assert times == sorted(set(times)) and events[0].host_time_uncertainty_us is None
    assert all(before - 10**9 <= event.host_ns <= time.time_ns() + 10**9 for event in events)


def test_requests_are_answered() -> None:
    with taxel.open("sim:pat", tare=0, seconds=3) as board:
        board.set_concept("cold", 0.5, timeout_ms=500)
        board.set_forms(0)
        board.set_scene("rate_hz = 0\nstream = { contacts_hz = 20 }")
        board.save()
        answers = {event.request: event.refusal for event in board if isinstance(event, taxel.Answer)}
    assert answers["set-scene"] is None and answers["save"] is None
    assert answers["feed"] is not None, "the shipped map has no concept of this name"


def test_postures_are_given_by_names() -> None:
    with taxel.open("sim:pat", tare=0, seconds=1) as board:
        answers: list[taxel.Answer] = []
        for event in board:
            if isinstance(event, taxel.Hello):
                with pytest.raises(taxel.UsageError, match="no joint knee; known: left_elbow"):
                    board.set_posture({"knee": 10})
                with pytest.raises(taxel.UsageError, match="left_elbow must be -180 to 180 degrees"):
                    board.set_posture({"left_elbow": 200})
                board.set_posture({"left_elbow": 12.5})
            elif isinstance(event, taxel.Answer):
                answers.append(event)
    assert ("posture", None) in [(answer.request, answer.refusal) for answer in answers]


BOARD = '[[port]]\nname = "/dev/ttyACM{0}"\nusb = [0x1209, 1]\nproduct = "taxel"\nserial = "N{0}"\nopens = "{1}"\n'


@pytest.mark.parametrize(
    ("opens", "why"),
    [
        ((), "no board is plugged in"),
        (("hung",), "usb:/dev/ttyACM0 is silent"),
        (("busy",), "/dev/ttyACM0 .* another program has it open"),
        (("not permitted",), r"/dev/ttyACM0 .* `sudo usermod -aG dialout \$USER`"),
        (("hung", "hung"), r"2 boards are plugged in: name one of usb:N0 \(/dev/ttyACM0\), usb:N1"),
    ],
)
def test_nothing_is_simulated_in_place_of_a_board(
    opens: tuple[str, ...], why: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    table = tmp_path / "ports.toml"
    table.write_text("".join(BOARD.format(number, kind) for number, kind in enumerate(opens)))
    monkeypatch.setenv("TAXEL_PORTS", str(table))
    if opens and "ttyACM0" not in program("ports"):
        pytest.skip("this wheel is as it is given away: it has the ports of this machine alone")
    began = time.monotonic()
    with pytest.raises(taxel.BoardError, match=why):
        taxel.open()
    print(f"python: {opens}: reported after {time.monotonic() - began:.1f} s")


def test_a_board_that_is_waited_for_is_opened_once_it_is_there(recording: os.PathLike[str]) -> None:
    server, source = silent_board()
    server.close()
    wire = b"".join(one.data for one in taxel.read(recording).messages("/taxel/wire"))

    def plug() -> None:
        time.sleep(1)
        with socket.create_server(server_address(source)) as again:
            relay(again, (wire, b""), 1)

    threading.Thread(target=plug, daemon=True).start()
    with pytest.warns(RuntimeWarning, match=r"cannot be reached.*; waiting for it"):
        board = taxel.open(source, wait=True, seconds=1)
    with board:
        assert any(isinstance(event, taxel.Frame) for event in board)
    with pytest.raises(taxel.UsageError):
        taxel.open("sim:nope", wait=True)


def test_what_is_simulated_says_so() -> None:
    with taxel.open("sim:pat", frames=1) as board:
        hello = next(event for event in board if isinstance(event, taxel.Hello))
    assert hello.simulated is True


def test_wrong_use_is_reported_in_a_sentence() -> None:
    with pytest.raises(taxel.UsageError, match='no script of touches "nope"'):
        taxel.open("sim:nope")
    with pytest.raises(taxel.UsageError, match=r"known are auto, usb\[:SERIAL\]"):
        taxel.open("radio")
    with pytest.raises(taxel.BoardError):
        taxel.open("tcp:127.0.0.1:1")
    with pytest.raises(TypeError):
        taxel.open(3)  # type: ignore[arg-type]
    with pytest.raises(OverflowError):
        taxel.open("sim:pat", frames=-1)
    assert issubclass(taxel.BoardError, taxel.Error) and issubclass(taxel.UsageError, taxel.Error)
    with taxel.open("sim:pat") as board:
        with pytest.raises(taxel.UsageError, match="frames must be a whole number from 1 to 4096"):
            board.tare(0)
        with pytest.raises(taxel.UsageError, match="value must be a number from -1 to 1"):
            board.set_concept("cold", 2.0)
        with pytest.raises(taxel.UsageError, match="joints are known once"):
            board.set_posture({"elbow": 10})
        with pytest.raises(taxel.Error, match="the scene, line 1"):
            board.set_scene("speed = 3")
    with pytest.raises(taxel.UsageError, match="closed"):
        board.tare()
    assert list(board) == []


def silent_board() -> tuple[socket.socket, str]:
    """A board on TCP that says nothing."""
    server = socket.create_server(("127.0.0.1", 0))
    return server, f"tcp:127.0.0.1:{server.getsockname()[1]}"


def server_address(source: str) -> tuple[str, int]:
    """The address of a source on TCP."""
    _, host, port = source.split(":")
    return host, int(port)


def test_the_wait_lets_other_threads_run_and_ctrl_c_through() -> None:
    # Ignored where the tests run in the background of a shell: then nobody could interrupt the wait.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    server, source = silent_board()
    counted = 0
    over = threading.Event()

    def count() -> None:
        nonlocal counted
        while not over.is_set():
            counted += 1

    other = threading.Thread(target=count)
    with server, taxel.open(source) as board:
        other.start()
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        began = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            next(board)
        assert time.monotonic() - began < 3
        over.set()
        other.join()
    assert counted > 10_000


def test_a_request_does_not_wait_for_the_reader() -> None:
    server, source = silent_board()
    with server, taxel.open(source) as board:
        reader = threading.Thread(target=lambda: list(board))
        reader.start()
        began = time.monotonic()
        for _ in range(10):
            board.key_frame()
        assert time.monotonic() - began < 12
        board.close()
        reader.join(5)
        assert not reader.is_alive()


def test_images_that_do_not_come_are_an_error() -> None:
    server, source = silent_board()
    with server, taxel.open(source, frames=3) as board, pytest.raises(taxel.BoardError, match="no image came for 10 s"):
        list(board)


def test_a_limited_time_ends_without_images() -> None:
    server, source = silent_board()
    with server, taxel.open(source, seconds=1) as board:
        assert any("no image came for 10 s" in str(event) for event in board)


def relay(server: socket.socket, parts: tuple[bytes, bytes], times: int) -> None:
    """Serves a recorded stream to some connections, one after the other: its beginning at once, its answers
    once the host has asked for something."""
    for _ in range(times):
        link, _ = server.accept()
        with link:
            link.sendall(parts[0])
            assert link.recv(4096)
            time.sleep(0.5)
            link.sendall(parts[1])
            time.sleep(0.5)


def test_a_lost_board_is_an_event_and_comes_back(recording: os.PathLike[str]) -> None:
    read = taxel.read(recording)
    frames = [message.data for message in read.messages("/taxel/wire")]
    answer = next(at for at, event in enumerate(read) if isinstance(event, taxel.Answer))
    parts = b"".join(frames[:answer]), b"".join(frames[answer:])
    server, source = silent_board()
    thread = threading.Thread(target=relay, args=(server, parts, 2), daemon=True)
    thread.start()
    notes: list[taxel.Lost | taxel.Back] = []
    with server, taxel.open(source) as board:
        end = threading.Timer(20, board.close)
        end.start()
        for event in board:
            if isinstance(event, (taxel.Lost, taxel.Back)):
                notes.append(event)
            if isinstance(event, taxel.Back):
                break
        end.cancel()
    lost, back = notes
    assert isinstance(lost, taxel.Lost) and isinstance(back, taxel.Back)
    assert "is gone" in lost.why and "is back after" in back.how and back.after_s > 0
    assert abs(lost.since_us / 1e6 - time.time()) < 30


def touched(recording: os.PathLike[str]) -> tuple[list[bytes], int]:
    """The frames of a recording's wire, and the number of those until something touches."""
    read = taxel.read(recording)
    wire = list(read.messages("/taxel/wire"))
    touch = next(event for event in read if isinstance(event, taxel.Contacts) and len(event.contacts))
    assert touch.time_us is not None
    return [one.data for one in wire], sum(one.publish_time <= touch.time_us * 1000 for one in wire)


def test_what_touches_a_lost_board_ends(recording: os.PathLike[str]) -> None:
    frames, count = touched(recording)
    server, source = silent_board()
    thread = threading.Thread(target=relay, args=(server, (b"".join(frames[:count]), b""), 1), daemon=True)
    thread.start()
    present, ended = set[int](), set[int]()
    with server, taxel.open(source) as board:
        for event in board:
            if isinstance(event, taxel.Contacts):
                present = set(event.contacts["id"].tolist()) or present
                ended |= set(event.released["id"].tolist())
                last = event.contacts
            if isinstance(event, taxel.Lost):
                break
    assert present and present <= ended and len(last) == 0


def test_what_touches_a_lost_board_ends_in_its_recording(recording: os.PathLike[str], tmp_path: Path) -> None:
    frames, count = touched(recording)
    server, source = silent_board()
    thread = threading.Thread(target=relay, args=(server, (b"".join(frames[:count]), b""), 1), daemon=True)
    thread.start()
    file = tmp_path / "lost.mcap"
    words = [sys.executable, "-m", "taxel", "record", "--source", source, "-o", str(file)]
    with server, subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as record:
        assert record.stderr
        assert any("is gone" in line for line in record.stderr)
        record.send_signal(signal.SIGINT)
        record.communicate(timeout=30)
    lists = [event.contacts for event in taxel.read(file).contacts()]
    lost = [event for event in taxel.read(file) if isinstance(event, taxel.Lost)]
    assert any(len(one) for one in lists) and len(lists[-1]) == 0 and len(lost) == 1


def test_another_board_is_an_error(recording: os.PathLike[str], tmp_path: Path) -> None:
    other = tmp_path / "other.mcap"
    program("record", "--source", "sim:press", "--garment", "block-4x16", "--for", "1s", "-o", str(other))
    server, source = silent_board()

    def boards() -> None:
        for file in (recording, other):
            wire = [one.data for one in taxel.read(file).messages("/taxel/wire")]
            relay(server, (b"".join(wire), b""), 1)

    threading.Thread(target=boards, daemon=True).start()
    sizes: set[int] = set()
    with server, taxel.open(source) as board, pytest.raises(taxel.BoardError, match="another board") as error:
        for event in board:
            if isinstance(event, taxel.Frame) and event.image is not None:
                sizes.add(event.image.size)
    assert str(error.value).endswith("it has the garment block-4x16, not reference") and sizes == {2048}


def megabytes() -> float:
    """Resident memory of this process."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 1e6


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_memory_does_not_grow() -> None:
    count = int(os.environ.get("TAXEL_FRAMES", "30000"))
    seen = touched = 0
    marks: list[float] = []
    with taxel.open("sim:five", repeat=True, frames=count) as board:
        for event in board:
            if isinstance(event, taxel.Frame):
                seen += 1
                touched += len(event.contacts) + len(event.panels)
                if seen % (count // 10) == 0:
                    marks.append(megabytes())
    print(f"{seen} frames, resident memory in tenths: {[round(mark, 1) for mark in marks]} MB")
    assert seen == count and touched > count
    assert marks[-1] - marks[1] < 4


def test_the_share_of_python() -> None:
    """Reported, not asserted: what machine this runs on is not known."""
    count = 2000
    with taxel.open("sim:five", repeat=True, frames=count) as board:
        began = time.thread_time()
        for event in board:
            if isinstance(event, taxel.Frame):
                assert event.image is not None
                event.image.max(), event.contacts["total"].sum()
        spent = time.thread_time() - began
    share = spent / (count / 195.3)
    print(f"{spent / count * 1e6:.0f} us of this thread for a frame: {share:.1%} of a core at 195.3 frames/s")
