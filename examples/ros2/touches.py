#!/usr/bin/env python3
"""Prints what touches the robot: python3 touches.py, beside `taxel ros2`."""
import rclpy
from rclpy.node import Node
from taxel_msgs.msg import Contacts, Intent


class Touches(Node):
    def __init__(self):
        super().__init__("touches")
        self.leading = "none"
        # 195 lists a second: none is lost as long as 100 of them wait at most.
        self.create_subscription(Contacts, "/taxel/contacts", self.contacts, 100)
        self.create_subscription(Intent, "/taxel/intent", self.intent, 100)

    def contacts(self, message):
        for contact in message.contacts:
            if contact.phase == contact.ONSET:
                place = contact.position
                print(f"contact {contact.id} at {place.x:.3f}, {place.y:.3f} m of {contact.header.frame_id}")
        for contact in message.released:
            print(f"contact {contact.id} ends after {contact.duration_ms / 1000:.2f} s: {contact.shape}")

    def intent(self, message):
        if message.leading != self.leading:
            self.leading = message.leading
            print("intention:", self.leading)


def main():
    rclpy.init()
    rclpy.spin(Touches())


if __name__ == "__main__":
    main()
