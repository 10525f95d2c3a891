"""`taxel.read`, beside Python's own reader of the format."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import taxel
from conftest import program
from mcap.reader import make_reader


def test_messages_are_those_of_mcap(recording: Path) -> None:
    with recording.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        theirs = [
            (channel.topic, message.log_time, message.publish_time, message.data)
            for _, channel, message in reader.iter_messages(log_time_order=False)
        ]
        summary = reader.get_summary()
        attached = {one.name: one.data for one in reader.iter_attachments()}
    mine = taxel.read(recording)
    assert [tuple(message) for message in mine.messages()] == theirs
    assert summary is not None and summary.statistics is not None
    assert mine.start_ns == summary.statistics.message_start_time
    assert mine.end_ns == summary.statistics.message_end_time
    counts = summary.statistics.channel_message_counts
    assert {topic: count for topic, count in mine.topics.items() if count} == {
        channel.topic: counts[number] for number, channel in summary.channels.items() if counts.get(number)
    }
    assert mine.is_whole and {name: mine.attachment(name) for name in mine.attachments} == attached
    assert mine.attachment("nothing") is None


def test_events_are_the_recorded_messages(recording: Path) -> None:
    mine = taxel.read(recording)
    reported = {kind: [json.loads(one.data) for one in mine.messages(f"/taxel/{kind}")]
            for kind in ("frames", "contacts", "intent", "symbols")}
    frames = list(mine.frames())
    assert len(frames) == len(reported["frames"]) > 300
    for frame, line in zip(frames, reported["frames"], strict=True):
        assert (frame.frame, frame.time_us, frame.host_ns) == (
            line["frame"], line["time_us"], line["host_time_us"] * 1000)
        assert frame.image is not None and line["total"] == frame.image.sum()
    for frame, image in zip(frames, mine.messages("/taxel/image"), strict=True):
        assert np.hstack(list(frame.panels.values())).astype("<u2").tobytes() in image.data
    for kind in ("intent", "symbols"):
        events = [event.to_dict() for event in mine if event.type == kind]
        lines = [{key: line[key] for key in event} for event, line in zip(events, reported[kind], strict=True)]
        assert events == lines, kind
    for touches, line in zip(mine.contacts(), reported["contacts"], strict=True):
        assert touches.frame == line["frame"] and len(touches.contacts) == len(line["contacts"])
        for contact, written in zip(touches.contacts, line["contacts"], strict=True):
            for key in written.keys() & contact.dtype.names:
                about = isinstance(written[key], float)
                assert contact[key] == (pytest.approx(written[key], abs=6e-4) if about else written[key]), key


def test_a_stretch_of_time_is_an_array(recording: Path) -> None:
    mine = taxel.read(recording)
    whole, part = mine.images(), mine.images(start=1.0, end=2.0)
    assert whole.values.shape == (len(whole.time_us), 2048) and whole.values.dtype == np.uint16
    inside = (whole.host_ns >= mine.start_ns + 10**9) & (whole.host_ns <= mine.start_ns + 2 * 10**9)
    assert np.array_equal(part.values, whole.values[inside]) and 150 < len(part.time_us) < 250
    assert mine.images(start=99).values.size == 0
    assert len(list(mine.contacts(start=1.0, end=2.0))) < len(list(mine.contacts()))
    assert mine.duration_s == pytest.approx(4.0, abs=0.1)
    assert next(iter(mine.events())).type == "hello"


MEMORY = """
import sys, taxel
def most():
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith("VmHWM"))
read = taxel.read(sys.argv[1])
next(iter(read.frames()))
before = most()
print(read.images().values.nbytes, most() - before)
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/status"), reason="needs /proc")
def test_images_take_the_memory_of_their_array(tmp_path: Path) -> None:
    file = tmp_path / "five.mcap"
    program("record", "--source", "sim:five", "--for", "60s", "-o", str(file))
    reported = subprocess.run([sys.executable, "-c", MEMORY, str(file)], check=True, capture_output=True, text=True)
    array, taken = map(int, reported.stdout.split())
    print(f"images of {array / 1e6:.0f} MB: resident memory grows by {taken / 1e6:.0f} MB")
    assert array > 40e6 and taken < 1.1 * array


def test_a_replay_is_the_recording(recording: Path) -> None:
    with taxel.open(f"replay:{recording}") as board:
        replayed = [event.json() for event in board]
        with pytest.raises(taxel.UsageError, match="does not listen"):
            board.tare()
    assert replayed == [event.json() for event in taxel.read(recording)]


def test_what_is_no_recording_is_reported(tmp_path: Path) -> None:
    file = tmp_path / "a.mcap"
    with pytest.raises(taxel.Error, match="a.mcap"):
        taxel.read(file)
    file.write_bytes(b"nothing of the kind")
    with pytest.raises(taxel.Error, match="not an MCAP file"):
        taxel.read(file)
