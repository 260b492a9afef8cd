"""cflib, Bitcraze's own library, flies the emulated Crazyflie, which so proves to be one.

    python3 crazyflie_client.py DEVICES

DEVICES is the example of that name, built.
"""

import math
import sys
import tempfile
import time

import cflib.crtp
from cflib.crazyflie import Crazyflie
from cflib.crazyflie.log import LogConfig
from cflib.crazyflie.syncCrazyflie import SyncCrazyflie
from cflib.positioning.motion_commander import MotionCommander
from emulator import Emulator

NAME = "crazyflie"


class Flight:
    """What the Crazyflie says, beside the truth."""

    def __init__(self, emulator, crazyflie):
        self.emulator, self.crazyflie = emulator, crazyflie
        self.home = emulator.pose(NAME)
        self.latest = None
        log = LogConfig(name="state", period_in_ms=50)
        for variable in ("stateEstimate.x", "stateEstimate.y", "stateEstimate.z", "stateEstimate.yaw"):
            log.add_variable(variable, "float")
        log.add_variable("supervisor.info", "uint16_t")
        crazyflie.log.add_config(log)
        log.data_received_cb.add_callback(self.hear)
        log.start()
        self.wait(lambda: self.latest, "values come")

    def hear(self, time_ms, values, log):
        self.latest = values

    def wait(self, test, what, seconds=8):
        end = time.time() + seconds
        while time.time() < end:
            if test():
                return
            time.sleep(0.02)
        raise AssertionError(f"{what}: not within {seconds} s; {self.latest}, {self.emulator.pose(NAME)}")

    def own(self):
        """The true place in the Crazyflie's own frame, which begins where it was switched on."""
        x, y, z, yaw = self.emulator.pose(NAME)
        x, y, turn = x - self.home[0], y - self.home[1], self.home[3]
        sin, cos = math.sin(turn), math.cos(turn)
        return (cos * x + sin * y, cos * y - sin * x, z), math.remainder(yaw - turn, math.tau)

    def flies(self):
        return bool(self.latest["supervisor.info"] & 16)

    def agrees(self):
        time.sleep(0.2)
        said = [self.latest[f"stateEstimate.{axis}"] for axis in "xyz"]
        place, yaw = self.own()
        assert math.dist(said, place) < 0.1, (said, place)
        assert abs(math.remainder(math.radians(self.latest["stateEstimate.yaw"]) - yaw, math.tau)) < 0.1
        return place, yaw


def manoeuvres(flight):
    """Takes off, flies to a place and lands by itself."""
    commander = flight.crazyflie.high_level_commander
    commander.takeoff(0.8, 1.5)
    flight.wait(lambda: flight.own()[0][2] > 0.75, "it takes off")
    assert flight.flies()
    commander.go_to(1.0, -0.5, 1.0, math.pi / 2, 3.0)
    flight.wait(lambda: math.dist(flight.own()[0], (1.0, -0.5, 1.0)) < 0.08, "it goes to a place")
    flight.wait(lambda: abs(flight.own()[1] - math.pi / 2) < 0.08, "it turns")
    flight.agrees()
    commander.land(0.0, 2.0)
    flight.wait(lambda: not flight.flies(), "it lands")
    assert flight.emulator.pose(NAME)[2] == 0


def set_points(flight):
    """Follows set-points, as people's first scripts send them."""
    with MotionCommander(flight.crazyflie, default_height=0.5) as motion:
        flight.wait(lambda: abs(flight.own()[0][2] - 0.5) < 0.1, "it rises")
        (x, y, _), yaw = flight.agrees()
        motion.forward(0.5, velocity=0.3)
        place, _ = flight.agrees()
        ahead = (x + 0.5 * math.cos(yaw), y + 0.5 * math.sin(yaw))
        assert math.dist(place[:2], ahead) < 0.15, (place, ahead)
        motion.turn_left(90)
        time.sleep(0.3)
        turn = math.remainder(flight.own()[1] - yaw, math.tau)
        assert abs(turn - math.pi / 2) < 0.25, turn
    flight.wait(lambda: not flight.flies(), "it lands")


def silence(flight):
    """It lands when set-points stop, as a real one stops its motors."""
    commander = flight.crazyflie.commander
    end = time.time() + 2
    while time.time() < end:
        commander.send_hover_setpoint(0, 0, 0, 0.5)
        time.sleep(0.05)
    assert flight.flies()
    flight.wait(lambda: not flight.flies(), "it gives up")


def main():
    cflib.crtp.init_drivers()
    with Emulator(sys.argv[1]) as emulator, tempfile.TemporaryDirectory() as cache:
        uri = f"udp://127.0.0.1:{emulator.where[NAME]}"
        with SyncCrazyflie(uri, cf=Crazyflie(rw_cache=cache)) as connected:
            crazyflie = connected.cf
            crazyflie.param.set_value("kalman.resetEstimation", "1")
            time.sleep(0.2)
            assert crazyflie.param.get_value("kalman.resetEstimation") == "1"
            flight = Flight(emulator, crazyflie)
            manoeuvres(flight)
            set_points(flight)
            silence(flight)
    print("cflib flies the emulated Crazyflie")


main()
