"""Places, forces and the posture of a robot that carries the garment."""

import json
import math
import struct
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import fields
from conftest import LONG, NEWEST, stamp_us, taxel
from geometry_msgs.msg import WrenchStamped
from joints import FASTNESS, SWING, waist
from rcl_interfaces.msg import Log
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import String
from taxel_msgs.msg import BodyRegion, BodyRegions, Contacts, Pressing

BODY = ("--body", "reference")
ROBOT = (*BODY, "--robot", "reference")


def by_frame(heard, kind):
    lines = [json.loads(message.data) for message in heard.messages]
    return {line["frame"]: line for line in lines if line["type"] == kind}


@contextmanager
def joints(*words):
    """Sends joint states."""
    process = subprocess.Popen([sys.executable, Path(__file__).parent / "joints.py", *words])
    yield
    process.kill()
    process.wait()


def test_what_presses_on_a_robot_that_moves(listener):
    pressing = listener.hear(Pressing, "/taxel/pressing")
    contacts = listener.hear(Contacts, "/taxel/contacts")
    heard = listener.hear(String, "/taxel/json")
    posed = lambda: [one for one in pressing.messages if not math.isnan(one.pose_error_m)]
    motion = f"angular={SWING * FASTNESS**2}"
    # More than are compared: on a busy machine one of the topics may lack what the other has.
    with joints(), taxel("sim:five", *ROBOT, "--motion", motion):
        listener.spin(lambda: len(posed()) > 450, 60)
        listener.rest(0.5)
    lines = by_frame(heard, "pressing")
    compared = [one for one in pressing.messages if one.frame in lines]
    assert len(compared) > 300
    for one in compared:
        assert one.header.frame_id == "base_link"
        fields.pressing(one, lines[one.frame])
    # By the stamp of the scan it is known where the torso was.
    worst, widest, judged = 0.0, 0.0, 0
    ages = sorted(one.pose_age_us for one in posed())
    age = ages[len(ages) // 2] / 1e6
    # A busy machine sends poses late. That they are old is then true, and what follows judges the bound for
    # it.
    assert age > -0.02 and (age < 0.1 or not LONG), ages
    for one in posed():
        angle = waist(stamp_us(one.header.stamp))
        for contact in [contact for contact in one.contacts if contact.link == "torso"]:
            at, base = contact.position, contact.base_position
            x, y = at.x * math.cos(angle) - at.y * math.sin(angle), at.x * math.sin(angle) + at.y * math.cos(angle)
            off = math.dist((x, y, at.z), (base.x, base.y, base.z))
            # The board rounds.
            assert off <= one.pose_error_m + 1e-4, (off, one)
            worst, widest, judged = max(worst, off), max(widest, one.pose_error_m), judged + 1
    assert judged > 200
    print(f"ros2: {judged} contacts on a torso that turns: off by {1e3 * worst:.2f} mm at most, and the messages say "
          f"{1e3 * widest:.2f} mm at most; poses were {1e3 * age:.0f} ms old (median)")
    # Contacts lie where the board says.
    landed = {(one.frame, contact.id): contact for one in compared for contact in one.contacts}
    seen = 0
    for one in contacts.messages:
        for contact in one.contacts:
            other = landed.get((one.frame, contact.id))
            if other:
                assert contact.body_link == other.link
                place = lambda point: (point.x, point.y, point.z)
                assert math.dist(place(contact.link_position), place(other.position)) < 1e-4
                assert math.isclose(math.hypot(*place(contact.link_force)), contact.force, rel_tol=1e-9)
                seen += 1
    assert seen > 300


def test_regions_of_the_body_say_what_json_says(listener, tmp_path):
    body = tmp_path / "body.toml"
    region = '\n[[regions]]\nname = "torso"\nlink = "torso"\nwithin.box = { from = [-1, -1, -1], to = [1, 1, 1] }\n'
    reference = Path(__file__).parents[2] / "taxel/bodies/reference.toml"
    body.write_text(reference.read_text() + region)
    regions = listener.hear(BodyRegions, "/taxel/regions")
    heard = listener.hear(String, "/taxel/json")
    phases = lambda: {one.regions[0].phase for one in regions.messages}
    with taxel("--source", "sim:pat", "--body", str(body)):
        listener.spin(lambda: phases() >= {BodyRegion.ONSET, BodyRegion.RELEASED}, 30)
        listener.rest(0.5)
    lines = by_frame(heard, "regions")
    compared = [one for one in regions.messages if one.frame in lines]
    assert len(compared) > 3
    for one in compared:
        fields.body_regions(one, lines[one.frame])


def test_forces_by_link_and_points_in_its_frame(listener):
    forces = listener.hear(WrenchStamped, "/tactile/links/torso/wrench", 10)
    points = listener.hear(PointCloud2, "/tactile/back/points", NEWEST)
    heard = listener.hear(String, "/taxel/json")
    pressed = lambda: [one for one in forces.messages if one.wrench.force.x]
    with taxel("--source", "sim:pat", *BODY, "--image-hz", "30"):
        listener.spin(lambda: len(pressed()) > 30 and len(points.messages) > 5, 30)
        # Nothing presses any more: that is reported, too.
        listener.spin(lambda: forces.messages[-1].wrench.force.x == 0, 20)
        listener.rest(0.5)
    # Messages of one scan have the same stamp.
    all_lines = [json.loads(message.data) for message in heard.messages]
    lines = {line["host_time_us"]: line for line in all_lines if line["type"] == "pressing"}
    compared = 0
    for one in pressed():
        assert one.header.frame_id == "torso"
        line = lines.get(stamp_us(one.header.stamp))
        if line:
            (link,) = [link for link in line["links"] if link["link"] == "torso"]
            fields.vector(one.wrench.force, link["force_n"])
            fields.vector(one.wrench.torque, link["moment_nm"])
            compared += 1
    assert compared > 20
    cloud = points.messages[-1]
    assert cloud.header.frame_id == "torso"
    names = ["x", "y", "z", "normal_x", "normal_y", "normal_z", "pressure"]
    assert [field.name for field in cloud.fields] == names and cloud.is_dense
    for x, y, z, nx, ny, nz, _ in struct.iter_unpack("<7f", bytes(cloud.data)):
        # The back: a half cylinder of 61.12 mm, from 1.5 cm to 38.5 cm.
        assert math.isclose(math.hypot(x, y), 0.06112, abs_tol=1e-6) and x < 0.004 and 0.01 < z < 0.39
        assert math.isclose(x * nx + y * ny, 0.06112, abs_tol=1e-5) and abs(nz) < 1e-6


def test_without_a_robot_joint_states_are_what_they_were(listener):
    pressing = listener.hear(Pressing, "/taxel/pressing")
    with joints(), taxel("--source", "sim:five", *BODY):
        listener.spin(lambda: len(pressing.messages) > 50, 20)
    for one in pressing.messages:
        assert one.header.frame_id == "" and math.isnan(one.pose_age_us) and math.isnan(one.pose_error_m)


def test_wrong_joint_states_are_reported_and_do_no_harm(listener):
    pressing = listener.hear(Pressing, "/taxel/pressing")
    rosout = listener.hear(Log, "/rosout")
    said = lambda: [one.msg for one in rosout.messages if one.msg.startswith("joint_states: ")]
    with joints("wrong"), taxel("--source", "sim:five", *ROBOT):
        listener.spin(lambda: len(pressing.messages) > 100 and said(), 20)
    assert 'joint "waist": 515.662' in said()[0] and "is out of its range" in said()[0], said()
    assert all(math.isnan(one.pose_age_us) for one in pressing.messages)
