"""zenoh-ros2-sdk drives the emulated ROS 2 robots, which so prove to be some; and it plays a robot for our driver.

    python3 ros2_client.py DEVICES [DRIVER]

DEVICES is the example of that name, DRIVER the example `ros2_driver`, both built with the feature `ros2`. The definitions
of messages, and so their hashes, are those of rosbags.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

from emulator import Emulator
from rosbags.typesys import Stores, get_typestore
from zenoh_ros2_sdk import ROS2Publisher, ROS2Subscriber, get_message_class
from zenoh_ros2_sdk.discovery import discover_topics
from zenoh_ros2_sdk.message_registry import get_registry
from zenoh_ros2_sdk.session import ZenohSession

NAMES = ["builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration", "std_msgs/msg/Header"]
