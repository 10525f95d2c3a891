#!/usr/bin/env python3
"""ROS 2 node: publishes images and intention. Start: python3 taxel_node.py --ros-args -p source:=usb"""
import json
import subprocess
import threading

import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Image
from std_msgs.msg import String


class Taxel(Node):
    def __init__(self):
        super().__init__("taxel")
        source = self.declare_parameter("source", "auto").value
        command = ["taxel", "live", "--source", source, "--json", "--pixels"]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.links = {}
        self.images = {}
        self.intention = self.create_publisher(String, "intention", 10)
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            message = json.loads(line)
            if message["type"] == "hello":
                self.links = {panel["name"]: panel["link"] for panel in message["panels"]}
            elif message["type"] == "frame":
                for panel in message["panels"]:
                    self.publish(panel)
                self.intention.publish(String(data=json.dumps(message["intent"])))
        self.get_logger().error("the stream has ended")

    def publish(self, panel):
        name, rows = panel["name"], panel["rows"]
        if name not in self.images:
            topic = "image/" + name.replace(" ", "_")
            self.images[name] = self.create_publisher(Image, topic, 10)
        image = Image(height=len(rows), width=len(rows[0]), encoding="mono16")
        image.header.stamp = self.get_clock().now().to_msg()
        image.header.frame_id = self.links.get(name, name)
        image.step = 2 * image.width
        image.data = b"".join(value.to_bytes(2, "little") for row in rows for value in row)
        self.images[name].publish(image)


def main():
    rclpy.init()
    node = Taxel()
    try:
        rclpy.spin(node)
    finally:
        node.process.terminate()


if __name__ == "__main__":
    main()
