"""Reads a recording with other people's readers and prints what was found as JSON.

usage: read.py mcap FILE | ros2 FILE | rerun FILE
"""

import array
import json
import sys
import zlib
from pathlib import Path

from mcap.reader import make_reader


def crc_of(values, before):
    """CRC-32 of 16-bit values, little-endian, carried on."""
    numbers = array.array("H", values)
    if sys.byteorder == "big":
        numbers.byteswap()
    return zlib.crc32(numbers.tobytes(), before)


def shapes_of(hello):
    """Name, rows and columns of each panel."""
    return [(panel["name"], panel["rows"], panel["columns"]) for panel in json.loads(hello)["panels"]]


def take_image(panels, shapes, data):
    """An image of the panels side by side: carries each panel's CRC-32 on."""
    step = 2 * sum(columns for _, _, columns in shapes)
    assert len(data) == step * max(rows for _, rows, _ in shapes)
    start = 0
    for name, rows, columns in shapes:
        values = b"".join(data[row * step + start :][: 2 * columns] for row in range(rows))
        panels[name] = zlib.crc32(values, panels.get(name, 0))
        start += 2 * columns


def read_mcap(path):
    from mcap_protobuf.decoder import DecoderFactory

    panels, wire, counts, shapes, factory = {}, 0, {}, [], DecoderFactory()
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        # In the order of the file: the board's messages are not in the order of the times that they report.
        for schema, channel, message in reader.iter_messages(log_time_order=False):
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
            if channel.topic == "/taxel/wire":
                wire = zlib.crc32(message.data, wire)
            if channel.topic == "/taxel/hello":
                shapes = shapes_of(message.data)
            if channel.topic == "/taxel/image":
                image = factory.decoder_for(channel.message_encoding, schema)(message.data)
                assert (image.encoding, image.step, image.frame_id) == ("mono16", 2 * image.width, "reference")
                assert image.timestamp.ToNanoseconds() == message.log_time
                assert len(image.data) == image.step * image.height
                take_image(panels, shapes, image.data)
        attachments = {found.name: len(found.data) for found in reader.iter_attachments()}
        metadata = {found.name: found.metadata for found in reader.iter_metadata()}
    printed = {summary.channels[id].topic: n for id, n in summary.statistics.channel_message_counts.items()}
    assert printed == counts, (printed, counts)
    return {"counts": counts, "wire": wire, "panels": panels, "attachments": attachments, "metadata": metadata}


def take(found, topic, message):
    """Images as they are, points by their pressure, forces by their sum."""
    found["counts"][topic] = found["counts"].get(topic, 0) + 1
    panel = topic.split("/")[-2]
    data = bytes(message.data) if hasattr(message, "data") else b""
    if topic.endswith("/image"):
        assert message.encoding == "mono16" and message.step == 2 * message.width
        found["images"][panel] = zlib.crc32(data, found["images"].get(panel, 0))
    elif topic.endswith("/points"):
        names = [field.name for field in message.fields]
        assert names == ["x", "y", "z", "pressure"] and message.point_step == 16
        points = array.array("f", data)
        # The taxel of row 1, column 1 lies one pitch from the first along each axis.
        corner = points[4 * (message.width + 1) :][:2]
        found["pitch_um"][panel] = [round(value * 1e6) for value in corner]
        values = [int(value) for value in points[3::4]]
        found["points"][panel] = crc_of(values, found["points"].get(panel, 0))
    elif topic.endswith("/wrench"):
        found["newtons"] += message.wrench.force.z


def empty():
    return {"counts": {}, "images": {}, "points": {}, "newtons": 0.0, "pitch_um": {}}


def read_ros2(path):
    from mcap_ros2.decoder import DecoderFactory
    from rosbags.highlevel import AnyReader

    decoded, bag = empty(), empty()
    with open(path, "rb") as file:
        for _, channel, _, message in make_reader(file, decoder_factories=[DecoderFactory()]).iter_decoded_messages():
            take(decoded, channel.topic, message)
    with AnyReader([Path(path)]) as reader:
        for connection, _, raw in reader.messages():
            take(bag, connection.topic, reader.deserialize(raw, connection.msgtype))
    return {"mcap_ros2": decoded, "rosbags": bag}


def depth(kind):
    """Lists in one another, and the type in them."""
    lists = 0
    while hasattr(kind, "value_type"):
        lists, kind = lists + 1, kind.value_type
    return lists, str(kind)


def read_rerun(path):
    """What Rerun makes of a recording or of ROS 2's: messages in the order of their times, images as (depth) images."""
    from rerun.chunk import McapReader

    rows, images = {}, {}
    for chunk in McapReader(path).stream():
        name, batch = str(chunk.entity_path), chunk.to_record_batch()
        for column in ("McapMessage:data", "Image:buffer", "DepthImage:buffer"):
            if column in batch.schema.names:
                times = batch["message_log_time"].cast("int64").to_pylist()
                values = [bytes(value[0]) for value in batch[column].to_pylist()]
                rows.setdefault((name, column), []).extend(zip(times, values))
    panels, counts = {}, {}
    for (name, column), messages in rows.items():
        messages.sort(key=lambda message: message[0])
        counts[name] = len(messages)
        if column == "DepthImage:buffer":
            images[name.split("/")[2]] = zlib.crc32(b"".join(data for _, data in messages))
        elif column == "Image:buffer":
            shapes = shapes_of(rows["/taxel/hello", "McapMessage:data"][0][1])
            for _, data in messages:
                take_image(panels, shapes, data)
    return {"counts": counts, "panels": panels, "images": images}


READERS = {"mcap": read_mcap, "ros2": read_ros2, "rerun": read_rerun}
print(json.dumps(READERS[sys.argv[1]](sys.argv[2])))
