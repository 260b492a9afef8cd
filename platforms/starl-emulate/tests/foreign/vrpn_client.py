"""The PyPI package motioncapture, which has the VRPN library in it, reads the emulated VRPN server.

    python3 vrpn_client.py DEVICES

DEVICES is the example of that name, built.
"""

import math
import sys
import time

import motioncapture
from emulator import Emulator


def main():
    with Emulator(sys.argv[1]) as emulator:
        cameras = motioncapture.connect("vrpn", {"hostname": f"127.0.0.1:{emulator.where['vrpn']}"})
        bodies = {}
        end = time.time() + 10
        while len(bodies) < 4 and time.time() < end:
            cameras.waitForNextFrame()
            bodies = dict(cameras.rigidBodies)
        assert set(bodies) == {"create", "drone", "px4", "ardupilot", "crazyflie", "twist", "stamped"}, bodies
        for name, body in bodies.items():
            x, y, z, yaw = emulator.pose(name)
            assert math.dist(body.position, (x, y, z)) < 1e-5, (name, body.position, (x, y, z))
            rotation = body.rotation
            seen = 2 * math.atan2(rotation.z, rotation.w)
            assert abs(seen - yaw) < 1e-5 and rotation.x == rotation.y == 0, (name, seen, yaw)
        frames, start = 0, time.time()
        while time.time() < start + 1:
            cameras.waitForNextFrame()
            frames += 1
        print(f"the package motioncapture reads the emulated VRPN server; {frames} frames in a second")


main()
