"""Sends the joints of the reference robot, 100 times a second, each position of 15 ms before: the waist swings. In a
process of its own, which is not held up by what another one hears."""

import math
import sys
import time

#: Waist of the robot: amplitude, rad, and angular frequency, rad/s.
SWING, FASTNESS = 0.5, 3.0
ARMS = [f"{side}_shoulder_{way}" for side in ("left", "right") for way in ("pitch", "roll", "yaw")]


def waist(us):
    """Position of the waist at a time of the host, us: the torso turns about the base's z axis."""
    return SWING * math.sin(FASTNESS * (us % 1_000_000_000_000) * 1e-6)


def main(wrong):
    """With `wrong`, the waist is where it cannot be."""
    import rclpy
    from sensor_msgs.msg import JointState

    rclpy.init()
    node = rclpy.create_node("joints")
    publisher = node.create_publisher(JointState, "/joint_states", 10)
    while True:
        ns = time.time_ns() - 15_000_000
        # A joint of another robot, and one that nothing of the garment hangs on, are no mistake.
        state = JointState(name=["waist", *ARMS, "gripper", "left_elbow"])
        state.position = [9.0 if wrong else waist(ns // 1000), *[0.0] * 6, 7.0, 0.1]
        state.header.stamp.sec, state.header.stamp.nanosec = divmod(ns, 10**9)
        publisher.publish(state)
        time.sleep(0.01)


if __name__ == "__main__":
    main("wrong" in sys.argv)
