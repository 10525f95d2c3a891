"""Services, parameters, joint states and concepts."""

import json
import math
import time

from conftest import FIVE, LATCHED, NEWEST, Listener, taxel
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.parameter import Parameter
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger
from taxel_msgs.msg import Intent
from taxel_msgs.srv import SetScene

WARM = """
name = "warm"
lambda = 1
[[concept]]
name = "warmth"
[[concept]]
name = "kindness"
[[input]]
concept = "warmth"
source = { host = 3 }
rise = [-32768, 32768]
at = [-1, 1]
[[edge]]
from = "warmth"
to = "kindness"
weight = 1
"""


def said(heard, kind):
    lines = [json.loads(message.data) for message in heard.messages]
    return [line for line in lines if line["type"] == kind]


def test_services_pass_on_what_the_board_says(listener):
    heard = listener.hear(String, "/taxel/json")
    with taxel("--source", "sim:idle"):
        assert listener.call(Trigger, "/taxel/tare", Trigger.Request()).success
        assert listener.call(Trigger, "/taxel/save", Trigger.Request()).success
        scene = lambda text: listener.call(SetScene, "/taxel/set_scene", SetScene.Request(scene=text))
        assert scene('joints = ["elbow"]\n').success
        missing = scene("nowhere.toml")
        assert not missing.success and missing.message.startswith("nowhere.toml cannot be read")
        moon = scene('[[react]]\nname = "x"\ncause = "pressure"\nregion = "moon"\nlevel = 3\n')
        assert not moon.success
        assert moon.message.startswith("the board refuses: scene: react[0].region must be")
    asked = [line["request"] for line in said(heard, "answer")]
    assert {"tare", "save", "set-scene"} <= set(asked), asked


def test_the_first_call_of_a_client_is_answered(listener):
    """At once, while the node is still finding the client; the answer is no longer than a sentence."""
    with taxel("--source", "sim:idle"):
        for number in range(10):
            first = Listener(f"first_{number}")
            answer = first.call(SetScene, "/taxel/set_scene", SetScene.Request(scene=70_000 * "x"))
            assert not answer.success and answer.message.endswith("x cannot be read: file name too long")
            first.node.destroy_node()


def test_a_refusal_is_the_boards_own(listener):
    with taxel("--source", f"sim:{FIVE}"):
        listener.rest(6)
        tare = listener.call(Trigger, "/taxel/tare", Trigger.Request())
    assert not tare.success and tare.message == "the board refuses: something touches the garment"


def test_parameters_are_checked_and_work(listener):
    images = listener.hear(Image, "/tactile/back/image", NEWEST)
    with taxel("--source", "sim:pat", "--image-hz", "50"):
        names = ["source", "image_hz", "tare_frames", "concept_timeout_ms", "use_sim_time"]
        asked = GetParameters.Request(names=names)
        values = listener.call(GetParameters, "/taxel/get_parameters", asked).values
        assert [values[0].string_value, values[1].double_value] == ["sim:pat", 50.0]
        assert [values[2].integer_value, values[3].integer_value, values[4].bool_value] == [64, 2000, False]
        listener.spin(lambda: len(images.messages) > 20)
        wanted = {"image_hz": 0.0, "source": "usb", "tare_frames": 0, "concept_timeout_ms": 500}
        wanted = [Parameter(name, value=value).to_parameter_msg() for name, value in wanted.items()]
        asked = SetParameters.Request(parameters=wanted)
        results = listener.call(SetParameters, "/taxel/set_parameters", asked).results
        assert [one.successful for one in results] == [True, False, False, True]
        assert results[2].reason == "tare_frames must be 1 to 4096"
        listener.rest(0.2)
        before = len(images.messages)
        listener.rest(0.5)
        assert len(images.messages) == before


def test_joint_states_arrive_as_posture_with_their_stamp(listener):
    joints = listener.node.create_publisher(JointState, "/joint_states", 10)
    posture = listener.hear(JointState, "/taxel/posture", LATCHED)
    heard = listener.hear(String, "/taxel/json")
    sent = {}
    with taxel("--source", "sim:pat"):
        scene = 'joints = ["elbow", "left_shoulder_p"]\n'
        assert listener.call(SetScene, "/taxel/set_scene", SetScene.Request(scene=scene)).success
        listener.spin(lambda: joints.get_subscription_count() > 0)

        def publish():
            state = JointState(name=["knee", "left_shoulder_p", "elbow"])
            state.position = [9.0, math.radians(-12.34), math.radians(len(sent) % 90)]
            ns = time.time_ns()
            state.header.stamp.sec, state.header.stamp.nanosec = divmod(ns, 10**9)
            sent[ns] = list(state.position)
            joints.publish(state)

        timer = listener.node.create_timer(0.01, publish)
        listener.spin(lambda: len(posture.messages) > 30, 20)
        listener.node.destroy_timer(timer)
    for message in posture.messages:
        stamp = message.header.stamp
        position = sent[stamp.sec * 10**9 + stamp.nanosec]
        assert list(message.name) == ["left_shoulder_p", "elbow"]
        # The wire has hundredths of a degree.
        for own, other in zip(message.position, position[1:]):
            assert abs(math.degrees(own) - math.degrees(other)) <= 0.005 + 1e-9
    assert len([line for line in said(heard, "answer") if line["request"] == "posture"]) >= 30


def test_concepts_are_topics(listener, tmp_path):
    (tmp_path / "warm.toml").write_text(WARM)
    scene = tmp_path / "scene.toml"
    scene.write_text('[intent]\nmap = "warm.toml"\n')
    intent = listener.hear(Intent, "/taxel/intent")
    warmth = listener.node.create_publisher(Float64, "/taxel/concepts/warmth", 10)
    with taxel("--source", "sim:pat", "--scene", str(scene)):
        listener.spin(lambda: warmth.get_subscription_count() > 0)
        timer = listener.node.create_timer(0.1, lambda: warmth.publish(Float64(data=0.75)))

        def activation():
            last = intent.messages[-1] if intent.messages else Intent()
            return dict(zip(last.concepts, last.activations)).get("warmth")

        listener.spin(lambda: activation() == 0.75, 20)
        listener.node.destroy_timer(timer)
        # It counts for two seconds.
        listener.spin(lambda: activation() == 0, 20)
