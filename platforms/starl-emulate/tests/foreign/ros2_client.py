"""zenoh-ros2-sdk drives the emulated ROS 2 robots as it drives others, and plays a robot that our driver drives.

    python3 ros2_client.py DEVICES DRIVE

DEVICES is the example of that name, DRIVE the example of starl-ros2, built with the feature `ros2`. The definitions of
messages, and so their hashes, are those of rosbags.
"""

import math
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy
from emulator import Emulator
from rosbags.typesys import Stores, get_typestore
from zenoh_ros2_sdk import ROS2Publisher, ROS2Subscriber, ZenohSession, get_message_class, get_registry, get_topic_info
from zenoh_ros2_sdk.qos import QosProfile, QosReliability

TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"
ODOMETRY, TRANSFORMS, SCAN = "nav_msgs/msg/Odometry", "tf2_msgs/msg/TFMessage", "sensor_msgs/msg/LaserScan"
# Of the model `differential`, metres.
RADIUS = 0.085
ROUTER = {"router_ip": "127.0.0.1", "domain_id": 0}


def define(folder):
    """Writes the definitions of all messages where the library looks for them."""
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in (TWIST, STAMPED, ODOMETRY, TRANSFORMS, SCAN):
        text, _ = store.generate_msgdef(name, ros_version=2)
        first, *others = text.split("=" * 80 + "\nMSG: ")
        parts = [f"{name}\n{first}", *others]
        for part in parts:
            name, _, definition = part.partition("\n")
            package, message = name.split("/")[0], name.split("/")[-1]
            path = folder / package / "msg" / f"{message}.msg"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(definition)
    get_registry(str(folder))


def wait(test, what, seconds=10):
    end = time.time() + seconds
    while time.time() < end:
        if test():
            return
        time.sleep(0.02)
    raise AssertionError(f"{what}: not within {seconds} s")


def near(what, value, wanted, tolerance):
    print(f"{what}: {value:.3f}, expected {wanted:.3f}")
    assert abs(value - wanted) <= tolerance, f"{what} is {value}, not within {tolerance} of {wanted}"


def build(kind, **fields):
    return get_message_class(kind)(**fields)


def vector(x=0.0, y=0.0, z=0.0):
    return build("geometry_msgs/msg/Vector3", x=x, y=y, z=z)


def yaw_of(rotation):
    return 2 * math.atan2(rotation.z, rotation.w)


class Robot:
    """An emulated robot, as a ROS 2 node sees it."""

    def __init__(self, emulator, name, is_stamped):
        self.emulator, self.name, self.is_stamped = emulator, name, is_stamped
        self.odometry = self.scan = None
        self.frames = {}
        self.velocities = ROS2Publisher(f"/{name}/cmd_vel", STAMPED if is_stamped else TWIST, **ROUTER)
        hear = [("odom", ODOMETRY, self.hear_odometry), ("tf", TRANSFORMS, self.hear_transforms)]
        hear.append(("scan", SCAN, self.hear_scan))
        self.ears = [ROS2Subscriber(f"/{name}/{topic}", kind, take, **ROUTER) for topic, kind, take in hear]

    def hear_odometry(self, message):
        self.odometry = message

    def hear_scan(self, message):
        self.scan = message

    def hear_transforms(self, message):
        for transform in message.transforms:
            self.frames[transform.header.frame_id, transform.child_frame_id] = transform.transform

    def drive(self, ahead, turn, seconds):
        """Asks for a velocity 20 times a second."""
        fields = {"linear": vector(x=ahead), "angular": vector(z=turn)}
        end = time.time() + seconds
        while time.time() < end:
            if self.is_stamped:
                now = time.time()
                stamp = build("builtin_interfaces/msg/Time", sec=int(now), nanosec=int(now % 1 * 1e9))
                header = build("std_msgs/msg/Header", stamp=stamp, frame_id="base_link")
                self.velocities.publish(header=header, twist=build(TWIST, **fields))
            else:
                self.velocities.publish(**fields)
            time.sleep(0.05)

    def pose(self):
        return self.emulator.pose(self.name)


def appears(robot):
    """The library lists the robot's topics with their types and QoS."""
    topics = [("odom", ODOMETRY, ("RELIABLE", 10)), ("tf", TRANSFORMS, ("RELIABLE", 100))]
    topics.append(("scan", SCAN, ("BEST_EFFORT", 5)))
    for (topic, kind, (reliability, depth)), ear in zip(topics, robot.ears):
        info = get_topic_info(f"/{robot.name}/{topic}", verbose=True, **ROUTER)
        assert info.topic_types == [kind], info
        assert [node.node_name for node in info.publishers] == ["robot"], info
        qos = QosProfile.decode(info.publishers[0].qos)
        assert qos.reliability == QosReliability[reliability] and qos.history_depth == depth, qos
        assert info.publishers[0].type_hash == ear.type_hash, info
    info = get_topic_info(f"/{robot.name}/cmd_vel", verbose=True, **ROUTER)
    assert info.subscriber_count == 1 and info.subscribers[0].type_hash == robot.velocities.type_hash, info


def drives(robot):
    """The robot follows velocities, and tells where it is."""
    wait(lambda: robot.odometry and robot.scan and ("map", "odom") in robot.frames, "all topics are heard")
    appears(robot)
    assert (robot.odometry.header.frame_id, robot.odometry.child_frame_id) == ("odom", "base_link")
    assert abs(time.time() - robot.odometry.header.stamp.sec) < 5, robot.odometry.header
    x, y, _, yaw = robot.pose()
    before = robot.odometry.pose.pose.position.x
    robot.drive(0.15, 0.0, 2.0)
    near("m/s ahead", robot.odometry.twist.twist.linear.x, 0.15, 0.01)
    # It stops by itself.
    time.sleep(1.0)
    ahead = robot.pose()
    way = math.hypot(ahead[0] - x, ahead[1] - y)
    assert 0.2 < way < 0.6, way
    near("direction, rad", math.atan2(ahead[1] - y, ahead[0] - x), yaw, 0.01)
    near("m by odometry", robot.odometry.pose.pose.position.x - before, way, 0.005)
    near("m/s at rest", robot.odometry.twist.twist.linear.x, 0.0, 0.001)
    robot.drive(0.0, 0.5, 1.0)
    time.sleep(1.0)
    turned = math.remainder(robot.pose()[3] - yaw, math.tau)
    assert 0.3 < turned < 0.9, turned
    near("rad by odometry", yaw_of(robot.odometry.pose.pose.orientation), turned, 0.01)
    # From the map to the robot: first to the frame of odometry.
    origin, own = robot.frames["map", "odom"], robot.frames["odom", "base_link"]
    turn = yaw_of(origin.rotation)
    true = robot.pose()
    found_x = origin.translation.x + math.cos(turn) * own.translation.x - math.sin(turn) * own.translation.y
    found_y = origin.translation.y + math.sin(turn) * own.translation.x + math.cos(turn) * own.translation.y
    near("x on the map", found_x, true[0], 0.01)
    near("y on the map", found_y, true[1], 0.01)
    near("yaw on the map", math.remainder(turn + yaw_of(own.rotation), math.tau), true[3], 0.01)


def sees(robot, other):
    """The laser sees the other robot in its direction."""
    (x, y, _, yaw), there = robot.pose(), other.pose()
    bearing = math.remainder(math.atan2(there[1] - y, there[0] - x) - yaw, math.tau) % math.tau
    ray = round((bearing - robot.scan.angle_min) / robot.scan.angle_increment) % len(robot.scan.ranges)
    distance = math.hypot(there[0] - x, there[1] - y)
    near("m to the other robot", float(robot.scan.ranges[ray]), distance - RADIUS, 0.02)
    assert not numpy.isfinite(robot.scan.ranges[(ray + len(robot.scan.ranges) // 2) % len(robot.scan.ranges)])


class Toy:
    """A robot of this library's: velocities in, odometry and transforms out."""

    def __init__(self):
        self.asked = (0.0, 0.0)
        self.received, self.fastest = 0, 0.0
        self.x = self.y = self.yaw = 0.0
        self.odometry = ROS2Publisher("/toy/odom", ODOMETRY, **ROUTER)
        self.transforms = ROS2Publisher("/toy/tf", TRANSFORMS, **ROUTER)
        self.ear = ROS2Subscriber("/toy/cmd_vel", TWIST, self.hear, **ROUTER)

    def hear(self, message):
        self.asked = (message.linear.x, message.angular.z)
        self.fastest = max(self.fastest, message.linear.x)
        self.received += 1

    def live(self, seconds):
        ahead, turn = self.asked
        self.yaw += turn * seconds
        self.x += ahead * seconds * math.cos(self.yaw)
        self.y += ahead * seconds * math.sin(self.yaw)
        rotation = {"x": 0.0, "y": 0.0, "z": math.sin(self.yaw / 2), "w": math.cos(self.yaw / 2)}
        rotation = build("geometry_msgs/msg/Quaternion", **rotation)
        none = build("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=0.0, w=1.0)
        stamp = build("builtin_interfaces/msg/Time", sec=int(time.time()), nanosec=0)
        header = lambda frame: build("std_msgs/msg/Header", stamp=stamp, frame_id=frame)  # noqa: E731
        pose = build(
            "geometry_msgs/msg/Pose",
            position=build("geometry_msgs/msg/Point", x=self.x, y=self.y, z=0.0),
            orientation=rotation,
        )
        twist = build(TWIST, linear=vector(x=ahead), angular=vector(z=turn))
        self.odometry.publish(
            header=header("odom"),
            child_frame_id="base_footprint",
            pose=build("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=numpy.ones(36)),
            twist=build("geometry_msgs/msg/TwistWithCovariance", twist=twist, covariance=numpy.ones(36)),
        )
        moved = build("geometry_msgs/msg/Transform", translation=vector(x=5.0, y=-3.0), rotation=none)
        kind = "geometry_msgs/msg/TransformStamped"
        origin = build(kind, header=header("map"), child_frame_id="odom", transform=moved)
        self.transforms.publish(transforms=[origin])


def is_driven(router, program):
    """Our driver drives a robot of this library's."""
    toy = Toy()
    driver = subprocess.Popen([program, router, "/toy"], stdout=subprocess.PIPE, text=True)
    before = time.time()
    while driver.poll() is None and time.time() < before + 30:
        time.sleep(0.04)
        # As long as a period is really.
        now = time.time()
        toy.live(min(now - before, 0.1))
        before = now
    assert driver.returncode == 0, driver.returncode
    # The pose by odometry from its start, and the last position on the map.
    x, y, yaw, map_x, map_y, map_yaw = map(float, driver.stdout.read().split())
    assert toy.received > 20 and toy.asked == (0.0, 0.0), (toy.received, toy.asked)
    near("m/s asked for", toy.fastest, 0.2, 1e-9)
    assert toy.x > 0.3 and toy.yaw > 0.3, (toy.x, toy.yaw)
    for what, value, wanted in [("x", x, toy.x), ("y", y, toy.y), ("yaw", yaw, toy.yaw)]:
        near(f"{what} by odometry", value, wanted, 0.03)
    near("x on the map", map_x, 5 + toy.x, 0.03)
    near("y on the map", map_y, toy.y - 3, 0.03)
    near("yaw on the map", map_yaw, toy.yaw, 0.03)


def main():
    with Emulator(sys.argv[1]) as emulator, tempfile.TemporaryDirectory() as folder:
        ROUTER["router_port"] = emulator.where["ros2"]
        # The first to open the session says where the router is.
        session = ZenohSession.get_instance("127.0.0.1", ROUTER["router_port"])
        try:
            define(pathlib.Path(folder))
            robots = [Robot(emulator, "twist", False), Robot(emulator, "stamped", True)]
            for robot in robots:
                drives(robot)
            sees(robots[0], robots[1])
            is_driven(f"tcp/127.0.0.1:{ROUTER['router_port']}", sys.argv[2])
        finally:
            # Its threads keep the process from ending.
            session.close()
    print("zenoh-ros2-sdk drives the emulated ROS 2 robots, and is driven")


main()
