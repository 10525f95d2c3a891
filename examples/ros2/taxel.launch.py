"""Starts the node, and RViz with its layout: ros2 launch ./taxel.launch.py source:=sim:pat rviz:=true"""
from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration

LAYOUT = Path(__file__).with_name("taxel.rviz")


def generate_launch_description():
    arguments = {"source": "auto", "namespace": "/", "image_hz": "10", "rviz": "false"}
    given = {name: LaunchConfiguration(name) for name in arguments}
    node = ["taxel", "ros2", "--source", given["source"], "--namespace", given["namespace"]]
    return LaunchDescription(
        [
            *[DeclareLaunchArgument(name, default_value=value) for name, value in arguments.items()],
            # A program of its own: it needs no ROS. A lost board is waited for; the program is started again.
            ExecuteProcess(cmd=[*node, "--image-hz", given["image_hz"]], output="screen", respawn=True),
            ExecuteProcess(cmd=["rviz2", "-d", str(LAYOUT)], condition=IfCondition(given["rviz"])),
        ]
    )
