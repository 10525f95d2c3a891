"""A robot of several boards: a node for each, and one for the robot."""

import json
import math
from pathlib import Path

import fields
import pytest
from conftest import NEWEST, stamp_us, taxel
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger
from taxel_msgs.msg import Contacts, RobotIntent, RobotTouch

ROBOT = """name = "three"
[[boards]]
name = "torso"
source = "sim:five"
garment = "reference"
[[boards]]
name = "left-hand"
source = "sim:press"
garment = "block-4x16"
[[boards]]
name = "foot"
source = "tcp:127.0.0.1:1"
garment = "block-4x16"
"""


@pytest.fixture
def robot(tmp_path):
    file = tmp_path / "robot.toml"
    file.write_text(ROBOT)
    return str(file)


def test_each_board_says_below_its_name_what_it_says_alone(listener, robot):
    boards = {}
    for board in ["torso", "left_hand"]:
        heard = listener.hear(String, f"/{board}/taxel/json")
        boards[board] = heard, listener.hear(Contacts, f"/{board}/taxel/contacts")
    images = listener.hear(Image, "/left_hand/tactile/mat/image", NEWEST)
    with taxel(robot):
        # On a busy machine ROS finds one topic of a node seconds before another.
        listener.spin(lambda: all(got.messages for of in boards.values() for got in of), 40)
        for _, contacts in boards.values():
            contacts.messages.clear()
        for wanted in range(300, 3000, 100):
            listener.spin(lambda: all(len(contacts.messages) > wanted for _, contacts in boards.values()), 40)
            # There, one topic also falls behind another.
            if all(len(compared(*of)) > 200 for of in boards.values()):
                break
        listener.spin(lambda: images.messages)
        # Joint states are those of the robot.
        listener.spin(lambda: listener.node.count_subscribers("/joint_states") == 2)
        assert listener.node.count_subscribers("/torso/joint_states") == 0
        assert listener.call(Trigger, "/left_hand/taxel/tare", Trigger.Request()).message in ["done", REFUSED]
    for board, of in boards.items():
        pairs = compared(*of)
        assert len(pairs) > 200
        for message, line in pairs:
            fields.contacts(message, line, frames=f"tactile/{board}/")
            assert stamp_us(message.header.stamp) == line["host_time_us"]
    assert images.messages[0].header.frame_id == "tactile/left_hand/mat"


def compared(heard, contacts):
    """Lists of contacts with the line of JSON of the same frame: a scene that is repeated counts its frames on."""
    lines = [json.loads(message.data) for message in heard.messages]
    lines = {line["frame"]: line for line in lines if line["type"] == "contacts"}
    return [(message, lines[message.frame]) for message in contacts.messages if message.frame in lines]


#: A garment that is touched is not tared.
REFUSED = "the board refuses: something touches the garment"


def test_the_robot_says_who_is_missing(listener, robot):
    diagnostics = listener.hear(DiagnosticArray, "/diagnostics")
    statuses = lambda: {one.name: one for message in diagnostics.messages for one in message.status}
    with taxel(robot):
        listener.spin(lambda: {"taxel: torso", "taxel: left-hand", "taxel: foot"} <= {*statuses()}, 20)
    assert statuses()["taxel: foot"].level == b"\3" and "cannot be reached" in statuses()["taxel: foot"].message
    assert statuses()["taxel: torso"].level == b"\0"


def test_the_robot_says_what_touches_mean_and_takes_host_input(listener, robot):
    # Both boards are let go at a time, so that the meaning changes.
    Path(robot).write_text(ROBOT.replace("sim:five", "sim:press"))
    meant = listener.hear(RobotIntent, "/robot_intent")
    vision = listener.node.create_publisher(Float64, "/taxel/host_input/vision", 10)

    def is_reported():
        vision.publish(Float64(data=-0.5))
        return any("vision" not in message.defaults for message in meant.messages)

    with taxel(robot):
        listener.spin(lambda: {touch.board for one in meant.messages for touch in one.touches} == BOARDS, 30)
        listener.spin(is_reported, 30)
        # Without a description the robot has no joints.
        listener.spin(lambda: listener.node.count_subscribers("/joint_states") == 2)
    for message in meant.messages:
        assert len(message.concepts) == len(message.activations) > 10
        known = dict(zip(message.concepts, message.activations))
        assert message.leading == "none" or known[message.leading] > 0
        assert {*message.holding} | {*message.defaults} <= {*known}
        for touch in message.touches:
            assert touch.board in BOARDS and touch.region and touch.mover == RobotTouch.UNSURE
            assert math.isnan(touch.approach_normal) and math.isnan(touch.hardness)
    heard = [(message.leading, [*message.holding]) for message in meant.messages]
    assert all(one != other for one, other in zip(heard, heard[1:]))
    assert any("vision" in message.defaults for message in meant.messages)


def test_joint_states_say_how_the_robot_moves(listener, robot):
    with open(robot) as file:
        text = file.read()
    with open(robot, "w") as file:
        file.write(text.replace('"three"\n', '"three"\nurdf = "reference"\n'))
    meant = listener.hear(RobotIntent, "/robot_intent")
    states = listener.node.create_publisher(JointState, "/joint_states", 10)

    def moves():
        states.publish(JointState(name=["waist", "nobody_s"], position=[0.1, 7.0]))
        return any("in motion" not in message.defaults for message in meant.messages)

    with taxel(robot):
        listener.spin(moves, 30)


BOARDS = {"torso", "left-hand"}
