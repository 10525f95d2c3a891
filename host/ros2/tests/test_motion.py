"""A robot that is moved by touch: joint states in, commands out, armed and disarmed by services."""

import json
import subprocess
import time
from contextlib import contextmanager

from conftest import LONG, NEWEST, PROGRAM
from geometry_msgs.msg import TwistStamped, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, String
from std_srvs.srv import Trigger

ROBOT = """name = "one"
urdf = "reference"
[[boards]]
name = "skin"
source = "sim:five"
garment = "reference"
body = "reference"
"""
# Of a machine that has other work a second is in time.
BEHAVIOUR = """name = "patient"
[faults]
posture_ms = 1000
frame_ms = 1000
cycle_ms = 1000
[[when]]
newtons = 1
do = "retreat"
"""
PARTS = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow")
JOINTS = ["waist", *(f"{side}_{part}" for side in ("left", "right") for part in PARTS)]
# What controllers ask for by default: reliable, the last ten.
DEFAULT = 10


@contextmanager
def moved(folder):
    """Runs `taxel motion`, and ends it as Ctrl-C does."""
    (folder / "robot.toml").write_text(ROBOT)
    (folder / "b.toml").write_text(BEHAVIOUR)
    words = [PROGRAM, "motion", "robot.toml", "--behaviour", "b.toml", "--ros2", "--tip", "left_hand"]
    process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL)
    try:
        yield process
    finally:
        process.terminate()
        process.wait(20)


class Told:
    """The robot's controller: it tells its joints, until it stops."""

    def __init__(self, listener):
        self.publisher = listener.node.create_publisher(JointState, "/joint_states", NEWEST)
        self.clock = listener.node.get_clock()
        self.timer = listener.node.create_timer(0.01, self.tell)

    def tell(self):
        state = JointState(name=JOINTS, position=[0.0] * len(JOINTS))
        state.header.stamp = self.clock.now().to_msg()
        self.publisher.publish(state)


def test_a_robot_is_armed_moved_and_stopped(listener, tmp_path):
    wrenches = listener.hear(WrenchStamped, "/taxel/wrench", DEFAULT)
    velocities = listener.hear(Float64MultiArray, "/taxel/velocities", DEFAULT)
    twists = listener.hear(TwistStamped, "/taxel/twist", DEFAULT)
    heard = listener.hear(String, "/taxel/motion")
    lines = lambda: [json.loads(message.data) for message in heard.messages]
    told = Told(listener)
    with moved(tmp_path):
        listener.spin(lambda: len(wrenches.messages) > 50, 60)
        # Disarmed, it says nothing to controllers.
        assert not velocities.messages and not twists.messages
        assert {line["phase"] for line in lines()} == {"disarmed"}
        end = time.monotonic() + 30
        while not (answer := listener.call(Trigger, "/taxel/arm", Trigger.Request())).success:
            assert answer.message.startswith("not armed: ") and time.monotonic() < end, answer
        listener.spin(lambda: any(any(message.data) for message in velocities.messages), 30)
        moving = next(message for message in velocities.messages if any(message.data))
        assert len(moving.data) == len(JOINTS) and max(map(abs, moving.data)) < 3.0
        forces = [message.wrench.force for message in wrenches.messages]
        assert max(abs(force.x) + abs(force.y) + abs(force.z) for force in forces) > 1.0
        assert wrenches.messages[0].header.frame_id == "base_link"
        answer = listener.call(Trigger, "/taxel/disarm", Trigger.Request())
        assert answer.success
        listener.rest(0.3)
        count = len(velocities.messages)
        listener.rest(0.5)
        assert len(velocities.messages) == count
        # Armed again; then nobody tells the joints any longer.
        assert listener.call(Trigger, "/taxel/arm", Trigger.Request()).success
        listener.spin(lambda: len(velocities.messages) > count + 20, 30)
        listener.node.destroy_timer(told.timer)
        listener.spin(lambda: lines()[-1]["phase"] == "stopped", 30)
        assert lines()[-1]["fault"] == "stale_posture"
        listener.rest(0.5)
        assert not any(velocities.messages[-1].data) and not turns(twists.messages[-1])


def turns(twist):
    parts = (twist.twist.linear, twist.twist.angular)
    return any(part.x or part.y or part.z for part in parts)


def test_every_wrench_arrives(listener, tmp_path):
    wanted = 10_000 if LONG else 600
    wrenches = listener.hear(WrenchStamped, "/taxel/wrench")
    heard = listener.hear(String, "/taxel/motion")
    Told(listener)
    with moved(tmp_path):
        listener.spin(lambda: len(heard.messages) > 20, 60)
        first = json.loads(heard.messages[10].data)["host_time_us"]
        listener.spin(lambda: len(heard.messages) > wanted + 40, 120)
        listener.rest(0.5)
    stamp = lambda message: message.header.stamp.sec * 1_000_000 + message.header.stamp.nanosec // 1000
    times = {stamp(message) for message in wrenches.messages}
    said = [json.loads(message.data)["host_time_us"] for message in heard.messages]
    expected = [us for us in said if us >= first][:wanted]
    missing = [us for us in expected if us not in times]
    print(f"ros2: motion: {len(expected) - len(missing)} of {len(expected)} wrenches")
    assert len(expected) == wanted and not missing
