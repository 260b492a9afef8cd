"""MAVSDK as a ground station flies the emulated PX4 vehicle.

    python3 mavsdk_client.py DEVICES

DEVICES is the example of that name, built.
"""

import math
import sys
import time

from emulator import Emulator
from mavsdk.component_type import ComponentType
from mavsdk.mavsdk import Configuration, Mavsdk
from mavsdk.plugins.action import Action
from mavsdk.plugins.offboard import Offboard, PositionNedYaw, VelocityBodyYawspeed

TARGET = (1.0, -0.8, -1.5)
YAW = 40.0


def until(test, seconds=20):
    end = time.time() + seconds
    while not test():
        assert time.time() < end, "the vehicle does not get there"
        time.sleep(0.1)


def fly(emulator):
    home = emulator.pose("px4")

    def place():
        """North, east and down from its home; north is x, east is -y."""
        x, y, z, _ = emulator.pose("px4")
        return (x - home[0], home[1] - y, -z)

    mavsdk = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
    assert mavsdk.add_any_connection(f"udpout://127.0.0.1:{emulator.where['px4']}") == 0
    system = mavsdk.first_autopilot(timeout_s=10.0)
    assert system, "MAVSDK sees no autopilot"
    action, offboard = Action(system), Offboard(system)
    action.arm()
    action.takeoff()
    until(lambda: place()[2] < -0.5)
    offboard.set_position_ned(PositionNedYaw(0.0, 0.0, -1.0, 0.0))
    offboard.start()
    offboard.set_position_ned(PositionNedYaw(*TARGET, YAW))
    until(lambda: math.dist(place(), TARGET) < 0.1)
    until(lambda: abs(math.remainder(emulator.pose("px4")[3] + math.radians(YAW), math.tau)) < 0.1)
    offboard.set_velocity_body(VelocityBodyYawspeed(0.4, 0.0, 0.0, 0.0))
    time.sleep(2.0)
    moved = math.dist(place(), TARGET)
    assert 0.4 < moved < 1.2, moved
    offboard.set_velocity_body(VelocityBodyYawspeed(0.0, 0.0, 0.0, 0.0))
    offboard.stop()
    action.land()
    until(lambda: emulator.pose("px4")[2] == 0.0)
    mavsdk.destroy()
    print("MAVSDK flies the emulated px4")


def main():
    with Emulator(sys.argv[1]) as emulator:
        fly(emulator)


main()
