"""The node under test, and a node that listens to it."""

import gc
import json
import os
import subprocess
import time
from contextlib import contextmanager
from pathlib import Path

# Before ROS is loaded. A domain of its own: other nodes of this machine are not heard.
os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 200)

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

PROGRAM = os.environ["TAXEL_PROGRAM"]
LONG = "TAXEL_CAMPAIGN" in os.environ
FIVE = Path(__file__).parent / "five.toml"
EXAMPLES = Path(__file__).parents[3] / "examples/ros2"

# What waits for a callback is kept, up to five seconds of lists of contacts: a shared machine pauses.
RELIABLE = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
NEWEST = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def in_real_time():
    """A campaign runs before what else the machine does, where it may: it measures the node."""
    try:
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(1))
    except OSError:
        return False
    return True


REAL_TIME = LONG and in_real_time()


class Got:
    """What has come on a topic: messages, and the milliseconds from their publication to the callback."""

    def __init__(self):
        self.messages = []
        self.ms = []

    def __call__(self, message, info):
        self.ms.append((time.time_ns() - info["source_timestamp"]) / 1e6)
        self.messages.append(message)

    def table(self, what):
        """Prints the latency."""
        ms = sorted(self.ms)
        median, p99 = ms[len(ms) // 2], ms[int(len(ms) * 0.99)]
        how = "real-time priority" if REAL_TIME else f"load {os.getloadavg()[0]:.1f}"
        print(f"ros2: {what}; {how}; ms: median {median:.2f}, p99 {p99:.2f}, largest {ms[-1]:.2f}")
        return p99


class Listener:
    """A node of rclpy."""

    def __init__(self, name):
        self.node = Node(name)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)

    def hear(self, kind, topic, qos=RELIABLE):
        got = Got()
        # rclpy knows from its signature that a callback takes the information, too.
        self.node.create_subscription(kind, topic, lambda message, info: got(message, info), qos)
        return got

    def spin(self, until, seconds=10.0):
        """Runs until something is true; fails after some seconds."""
        end = time.monotonic() + seconds
        while not until():
            assert time.monotonic() < end, f"not within {seconds} s"
            self.executor.spin_once(timeout_sec=0.02)

    def rest(self, seconds):
        end = time.monotonic() + seconds
        self.spin(lambda: time.monotonic() >= end, seconds + 5)

    def call(self, kind, name, request):
        """Calls a service."""
        client = self.node.create_client(kind, name)
        assert client.wait_for_service(timeout_sec=10), name
        answer = client.call_async(request)
        self.spin(answer.done, 15)
        self.node.destroy_client(client)
        return answer.result()


@pytest.fixture(scope="session", autouse=True)
def ros():
    # Its pauses grow with the messages that a test keeps.
    gc.disable()
    rclpy.init()
    yield
    rclpy.shutdown()


@pytest.fixture
def listener(request):
    listener = Listener(request.node.name)
    yield listener
    listener.executor.shutdown()
    listener.node.destroy_node()


@contextmanager
def taxel(*words):
    """Runs `taxel ros2`, and ends it as Ctrl-C does."""
    process = subprocess.Popen([PROGRAM, "ros2", *words], stdout=subprocess.PIPE, text=True)
    try:
        line = process.stdout.readline()
        assert f"in domain {os.environ['ROS_DOMAIN_ID']} (Ctrl-C ends)" in line, line
        yield process
    finally:
        process.terminate()
        process.wait(20)


def lines(source, seconds):
    """What `taxel live --json` prints of a source."""
    words = [PROGRAM, "live", "--source", source, "--for", f"{seconds}s", "--json"]
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def stamp_us(stamp):
    """Time of a header, us."""
    return stamp.sec * 1_000_000 + stamp.nanosec // 1000
