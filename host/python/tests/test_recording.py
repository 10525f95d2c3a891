"""`taxel.read`, beside Python's own reader of the format."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import taxel
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
    told = {kind: [json.loads(one.data) for one in mine.messages(f"/taxel/{kind}")]
            for kind in ("frames", "contacts", "intent", "symbols")}
    frames = list(mine.frames())
    assert len(frames) == len(told["frames"]) > 300
    for frame, line in zip(frames, told["frames"], strict=True):
        assert (frame.frame, frame.time_us, frame.host_ns) == (
            line["frame"], line["time_us"], line["host_time_us"] * 1000)
        for panel in line["panels"]:
            assert frame.panels[panel["name"]].tolist() == panel["rows"]
    for kind in ("contacts", "intent", "symbols"):
        events = [event.to_dict() for event in mine if event.type == kind]
        lines = [{key: line[key] for key in event} for event, line in zip(events, told[kind], strict=True)]
        assert events == lines, kind


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


def test_a_replay_is_the_recording(recording: Path) -> None:
    with taxel.open(f"replay:{recording}") as board:
        replayed = [event.json() for event in board]
        with pytest.raises(taxel.UsageError, match="does not listen"):
            board.tare()
    assert replayed == [event.json() for event in taxel.read(recording)]


def test_what_is_no_recording_is_told(tmp_path: Path) -> None:
    file = tmp_path / "a.mcap"
    with pytest.raises(taxel.Error, match="a.mcap"):
        taxel.read(file)
    file.write_bytes(b"nothing of the kind")
    with pytest.raises(taxel.Error, match="not an MCAP file"):
        taxel.read(file)
