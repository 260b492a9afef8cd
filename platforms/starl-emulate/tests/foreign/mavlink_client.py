"""pymavlink flies the emulated PX4 and ArduPilot vehicles, which so prove to be such.

    python3 mavlink_client.py DEVICES

DEVICES is the example of that name, built.
"""

import math
import os
import sys
import threading
import time

os.environ["MAVLINK20"] = "1"

from emulator import Emulator
from pymavlink import mavutil

mavlink = mavutil.mavlink
# Which numbers of a set-point to ignore: all except position and yaw; all except velocity and rate of turn.
POSITION = 0b100111111000
VELOCITY = 0b010111000111


class Vehicle:
    """A vehicle of the emulator, seen as a ground station sees it."""

    def __init__(self, emulator, name):
        self.emulator, self.name = emulator, name
        self.link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{emulator.where[name]}")
        self.home = emulator.pose(name)
        self.alive = True
        threading.Thread(target=self.beat, daemon=True).start()
        assert self.link.wait_heartbeat(timeout=5), "no heartbeat"

    def beat(self):
        while self.alive:
            self.link.mav.heartbeat_send(mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 0)
            time.sleep(0.5)

    def command(self, command, *parameters, expect=mavlink.MAV_RESULT_ACCEPTED):
        # Unread messages could leave no room for the acknowledgement.
        while self.link.recv_match(blocking=False):
            pass
        parameters = (*parameters, *[0] * (7 - len(parameters)))
        # Datagrams get lost on a busy machine: MAVLink's command protocol sends a command again.
        for confirmation in range(6):
            self.link.mav.command_long_send(1, 1, command, confirmation, *parameters)
            end = time.time() + 3
            while time.time() < end:
                ack = self.link.recv_match(type="COMMAND_ACK", blocking=True, timeout=1)
                if ack and ack.command == command:
                    assert ack.result == expect, ack
                    return
        raise AssertionError(f"no acknowledgement of {command}")

    def target(self, mask, x, y, z, yaw=0.0, frame=mavlink.MAV_FRAME_LOCAL_NED):
        zeros = (0, 0, 0)
        places = ((x, y, z), zeros) if mask == POSITION else (zeros, (x, y, z))
        self.link.mav.set_position_target_local_ned_send(0, 1, 1, frame, mask, *places[0], *places[1], *zeros, yaw, 0)

    def hold(self, seconds, *target, **options):
        end = time.time() + seconds
        while time.time() < end:
            self.target(*target, **options)
            time.sleep(0.1)

    def wait(self, kind, test, seconds=10):
        end = time.time() + seconds
        while time.time() < end:
            message = self.link.recv_match(type=kind, blocking=True, timeout=1)
            if message and test(message):
                return message
        raise AssertionError(f"{kind} does not come to what is waited for; last: {message}")

    def mode(self):
        while self.link.recv_match(type="HEARTBEAT", blocking=False):
            pass
        return mavutil.mode_string_v10(self.link.wait_heartbeat(timeout=3))

    def agrees(self):
        """The vehicle's own position and attitude are the true ones; north is x, east is -y."""
        while self.link.recv_match(type=["LOCAL_POSITION_NED", "ATTITUDE"], blocking=False):
            pass
        here = self.link.recv_match(type="LOCAL_POSITION_NED", blocking=True, timeout=1)
        attitude = self.link.recv_match(type="ATTITUDE", blocking=True, timeout=1)
        x, y, z, yaw = self.emulator.pose(self.name)
        truth = (x - self.home[0], self.home[1] - y, -z)
        assert math.dist((here.x, here.y, here.z), truth) < 0.1, (here, truth)
        assert abs(math.remainder(attitude.yaw + yaw, math.tau)) < 0.1, (attitude, yaw)
        return here


def fly(emulator, name):
    vehicle = Vehicle(emulator, name)
    px4 = name == "px4"
    for message in (30, 32, 245):
        vehicle.command(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, message, 20000)
    external = (1, 6, 0) if px4 else (1, 4)
    if px4:
        rejected = mavlink.MAV_RESULT_TEMPORARILY_REJECTED
        vehicle.command(mavlink.MAV_CMD_DO_SET_MODE, *external, expect=rejected)
        vehicle.hold(0.3, VELOCITY, 0, 0, 0)
    vehicle.command(mavlink.MAV_CMD_DO_SET_MODE, *external)
    mode = vehicle.mode()
    assert mode == ("OFFBOARD" if px4 else "GUIDED"), mode

    vehicle.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1)
    vehicle.command(mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, math.nan, 0, 0, 1.5)
    vehicle.wait("LOCAL_POSITION_NED", lambda here: here.z < -1.4)
    vehicle.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0, expect=mavlink.MAV_RESULT_DENIED)
    if px4:
        vehicle.target(POSITION, 0, 0, -1.5)
        vehicle.command(mavlink.MAV_CMD_DO_SET_MODE, *external)

    vehicle.hold(6, POSITION, 1.5, -1.0, -2.0, yaw=1.0)
    here = vehicle.agrees()
    assert math.dist((here.x, here.y, here.z), (1.5, -1.0, -2.0)) < 0.1, here
    _, _, _, yaw = emulator.pose(name)
    assert abs(math.remainder(yaw + 1.0, math.tau)) < 0.05, yaw

    before = emulator.pose(name)
    vehicle.hold(2, VELOCITY, 0.5, 0, 0, frame=mavlink.MAV_FRAME_BODY_NED)
    after = vehicle.emulator.pose(name)
    way = (after[0] - before[0], after[1] - before[1])
    assert 0.5 < math.hypot(*way) < 1.3, way
    assert abs(math.remainder(math.atan2(way[1], way[0]) - yaw, math.tau)) < 0.1, (way, yaw)

    # There are no more set-points: it stops.
    time.sleep(4.5)
    stopped = emulator.pose(name)
    time.sleep(0.5)
    assert math.dist(stopped[:3], emulator.pose(name)[:3]) < 0.02, "it flies on without set-points"
    if px4:
        assert vehicle.mode() == "LOITER", vehicle.mode()

    vehicle.command(mavlink.MAV_CMD_NAV_LAND)
    on_ground = mavlink.MAV_LANDED_STATE_ON_GROUND
    vehicle.wait("EXTENDED_SYS_STATE", lambda state: state.landed_state == on_ground)
    vehicle.wait("HEARTBEAT", lambda beat: not beat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)
    assert emulator.pose(name)[2] == 0
    vehicle.alive = False
    print(f"pymavlink flies the emulated {name}")


def main():
    with Emulator(sys.argv[1]) as emulator:
        fly(emulator, "px4")
        fly(emulator, "ardupilot")


main()
