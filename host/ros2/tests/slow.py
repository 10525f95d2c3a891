"""A subscriber that takes a tenth of a second for each list of contacts, and prints its frame."""

import time

import rclpy
from rclpy.node import Node
from taxel_msgs.msg import Contacts


def take(message):
    print(message.frame, flush=True)
    time.sleep(0.1)


rclpy.init()
node = Node("slow")
node.create_subscription(Contacts, "/taxel/contacts", take, 100)
rclpy.spin(node)
