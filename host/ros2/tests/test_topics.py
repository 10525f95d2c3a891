"""The other topics, and what they say."""

import json
import math
import struct

import fields
from conftest import LATCHED, NEWEST, stamp_us, taxel
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import WrenchStamped
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Image, PointCloud2
from std_msgs.msg import String
from taxel_msgs.msg import Contacts, Health, Intent, Reaction, Symbols

#: Distance of the reference garment's taxels along x and y, m.
PITCH = (0.012, 0.010)


def by_type(said):
    """Lines of JSON by type and frame."""
    all_lines = {}
    for message in said.messages:
        line = json.loads(message.data)
        all_lines.setdefault((line["type"], line.get("frame", line.get("time_us"))), []).append(line)
    return all_lines


def test_words_reactions_and_intention_say_what_json_says(listener, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text('[[react]]\nname = "pressed"\ncause = "contacts"\nlevel = 1\n')
    said = listener.hear(String, "/taxel/json")
    heard = [
        (listener.hear(Symbols, "/taxel/symbols"), "symbols", fields.symbols),
        (listener.hear(Intent, "/taxel/intent"), "intent", fields.intent),
        (listener.hear(Reaction, "/taxel/reactions"), "reaction", fields.reaction),
    ]
    with taxel("--source", "sim:pat", "--scene", str(scene)):
        reactions = heard[2][0].messages
        listener.spin(lambda: {one.active for one in reactions} == {True, False}, 20)
        listener.rest(2)
    lines = by_type(said)
    for got, kind, same in heard:
        compared = 0
        for message in got.messages:
            for line in lines.get((kind, message.frame), [])[:1]:
                same(message, line)
                compared += 1
        assert compared >= min(len(got.messages), 2), kind
    assert heard[2][0].messages[0].name == "pressed"


def test_health_is_sent_to_who_comes_later(listener):
    with taxel("--source", "sim:pat"):
        listener.rest(3)
        health = listener.hear(Health, "/taxel/health", LATCHED)
        diagnostics = listener.hear(DiagnosticArray, "/diagnostics")
        said = listener.hear(String, "/taxel/json")
        listener.spin(lambda: len(diagnostics.messages) > 1 and len(health.messages) > 1)
    of_health = [all_lines for (kind, _), all_lines in by_type(said).items() if kind == "health"]
    lines = {line["scans"]: line for all_lines in of_health for line in all_lines}
    for message in health.messages:
        for line in filter(None, [lines.get(message.scans)]):
            fields.health(message, line)
    status = diagnostics.messages[0].status[0]
    assert status.level == b"\0" and status.name == "taxel: board"
    assert status.hardware_id.startswith("taxel-sim")
    assert {value.key for value in status.values} >= {"scans", "lost", "faulty_taxels"}


def test_images_points_and_forces_agree(listener):
    """Of one frame: they have the same stamp."""
    images = listener.hear(Image, "/tactile/back/image", NEWEST)
    points = listener.hear(PointCloud2, "/tactile/back/points", NEWEST)
    # As controllers subscribe: reliably.
    forces = listener.hear(WrenchStamped, "/tactile/back/wrench", 10)
    pressed = lambda: [one for one in images.messages if any(one.data)]
    with taxel("--source", "sim:pat", "--image-hz", "30"):
        listener.spin(lambda: len(pressed()) > 5 and len(points.messages) > 20, 20)
        listener.rest(0.5)
    of = lambda got: {stamp_us(one.header.stamp): one for one in got.messages}
    clouds, wrenches, compared = of(points), of(forces), 0
    for image in pressed():
        assert (image.height, image.width, image.encoding, image.step) == (32, 16, "mono16", 32)
        values = struct.unpack("<512H", bytes(image.data))
        stamp = stamp_us(image.header.stamp)
        if stamp in clouds and stamp in wrenches:
            cloud, wrench = clouds[stamp], wrenches[stamp]
            assert image.header.frame_id == cloud.header.frame_id == wrench.header.frame_id == "tactile/back"
            rows = struct.iter_unpack("<4f", bytes(cloud.data))
            assert [int(pressure) for *_, pressure in rows] == list(values)
            # Into the robot, at the centre of pressure.
            assert wrench.wrench.force.z == sum(values) / 1000
            by_rows = sum(value * (index // 16) for index, value in enumerate(values))
            by_columns = sum(value * (index % 16) for index, value in enumerate(values))
            torque = wrench.wrench.torque
            assert math.isclose(torque.x, by_rows * PITCH[1] / 1000, abs_tol=1e-9)
            assert math.isclose(torque.y, -by_columns * PITCH[0] / 1000, abs_tol=1e-9)
            compared += 1
    assert compared > 2


def test_with_clock_the_stamps_are_the_boards_time(listener):
    clock = listener.hear(Clock, "/clock")
    contacts = listener.hear(Contacts, "/taxel/contacts")
    said = listener.hear(String, "/taxel/json")
    with taxel("--source", "sim:five", "--clock"):
        listener.spin(lambda: len(contacts.messages) > 50 and len(clock.messages) > 200, 20)
    lines = by_type(said)
    frames = [one for one in contacts.messages if ("contacts", one.frame) in lines]
    assert len(frames) > 20
    for one in frames:
        assert stamp_us(one.header.stamp) == lines["contacts", one.frame][0]["time_us"]
    times = [stamp_us(one.clock) for one in clock.messages]
    assert times == sorted(times) and times[-1] < 60e6
