"""pycreate2 drives the emulated Create, which so proves to be one.

    python3 create.py DEVICES

DEVICES is the example of that name, built.
"""

import math
import sys
import time

from emulator import Emulator
from pycreate2 import Create2

METRES_PER_COUNT = math.pi * 0.072 / 508.8


def near(what, value, wanted, tolerance):
    print(f"{what}: {value:.3f}, expected {wanted:.3f}")
    assert abs(value - wanted) <= tolerance, f"{what} is {value}, not within {tolerance} of {wanted}"


def counted(after, before):
    """Counts of a wheel between two readings, whose counters wrap around."""
    return ((after - before + 0x8000) & 0xFFFF) - 0x8000


def reached(emulator, done, seconds=30):
    """Waits until the Create's pose is as expected; gives the pose and the time of the devices."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        answer = emulator.ask()
        if done(answer["create"]):
            return answer["create"], answer["seconds"]
        time.sleep(0.01)
    raise AssertionError(f"not within {seconds} s: {emulator.pose('create')}")


def rest(emulator):
    """Waits until the robot stands, which takes a moment where the machine is busy; gives its pose."""
    before = None
    while (pose := emulator.pose("create")) != before:
        before = pose
        time.sleep(0.2)
    return pose


def drive(emulator, robot, right, left, travelled, least):
    """Drives until this measure of the pose has grown by `least`, and stops; gives the pose, and the measure per second."""
    start = travelled(emulator.pose("create"))
    robot.drive_direct(right, left)
    # Not from the start: a busy machine may hold up what is written to a pseudo-terminal.
    first, begin = reached(emulator, lambda pose: travelled(pose) >= start + least / 8)
    last, end = reached(emulator, lambda pose: travelled(pose) >= start + least)
    robot.drive_direct(0, 0)
    return rest(emulator), (travelled(last) - travelled(first)) / (end - begin)


def main():
    with Emulator(sys.argv[1]) as emulator:
        robot = Create2(emulator.where["create"])
        robot.SCI.ser.timeout = 10  # The package waits for one second, in which a busy machine may not answer.
        x, y, _, yaw = emulator.pose("create")

        robot.start()
        assert robot.get_sensors().open_interface_mode == 1, "128 leads to passive mode"
        robot.drive_direct(300, 300)
        time.sleep(0.3)
        robot.drive_direct(0, 0)
        assert emulator.pose("create")[:2] == [x, y], "a robot in passive mode drives"

        robot.safe()
        first = robot.get_sensors()
        assert first.open_interface_mode == 2, "131 leads to safe mode"
        ahead, speed = drive(emulator, robot, 200, 200, lambda pose: math.dist(pose[:2], [x, y]), 0.4)
        way = math.hypot(ahead[0] - x, ahead[1] - y)
        near("metres per second", speed, 0.2, 0.01)
        near("direction, rad", math.atan2(ahead[1] - y, ahead[0] - x), yaw, 0.01)
        second = robot.get_sensors()
        near("packet 19, m", second.distance / 1000, way, 0.002)
        near("packet 20, degrees", second.angle, 0, 1)
        for wheel in ("encoder_counts_left", "encoder_counts_right"):
            counts = counted(getattr(second, wheel), getattr(first, wheel))
            near(f"{wheel}, m", counts * METRES_PER_COUNT, way, 0.002)

        pose, rate = drive(emulator, robot, 150, -150, lambda pose: pose[3], 1.0)
        turned = pose[3] - yaw
        near("rad per second to the left", rate, 0.3 / 0.235, 0.06)
        third = robot.get_sensors()
        near("packet 20, degrees", third.angle, math.degrees(turned), 1.01)
        near("packet 19, m", third.distance / 1000, 0, 0.002)
        right = counted(third.encoder_counts_right, second.encoder_counts_right)
        left = counted(third.encoder_counts_left, second.encoder_counts_left)
        near("rad by the encoders", (right - left) * METRES_PER_COUNT / 0.235, turned, 0.01)

        robot.drive_direct(-250, -100)
        sensors = robot.get_sensors()
        assert (sensors.velocity_right, sensors.velocity_left) == (-250, -100), "packets 41 and 42"
        assert 0 < sensors.battery_charge <= sensors.battery_capacity, "packets 25 and 26"
        assert not any(sensors.bumps_wheeldrops), "nothing touches the robot"

        robot.drive_direct(500, 500)
        until = time.monotonic() + 30
        while not any(robot.get_sensors().bumps_wheeldrops[:2]):
            assert time.monotonic() < until, "packet 7 at the wall"

        robot.drive_direct(-100, -100)
        robot.stop()
        stopped = rest(emulator)
        time.sleep(0.3)
        assert emulator.pose("create") == stopped, "173 stops the motors"
        # It stops the robot again as it is deleted, so while there is one.
        del robot
    print("pycreate2 drives the emulated Create")


def patiently(attempts):
    """A busy machine may hold up what is written to a pseudo-terminal for seconds: then the robot drives to the wall."""
    try:
        main()
    except Exception as error:  # pycreate2 raises no other
        if attempts == 1:
            raise
        print(f"again, after: {error}")
        patiently(attempts - 1)


patiently(3)
