"""A robot of a fleet flies an autopilot that MAVSDK's server plugins make up: MAVSDK reads and acknowledges its commands.

    python3 mavsdk_autopilot.py STARL

The autopilot says that it is PX4. It follows set-points of level velocity with the gain of PX4's loop, and those of the
vertical velocity at once. The command's fleet of one robot visits two waypoints and lands.
"""

import itertools
import json
import math
import pathlib
import random
import socket
import subprocess
import sys
import tempfile
import threading
import time

from mavsdk.component_type import ComponentType
from mavsdk.mavsdk import Configuration, Mavsdk
from mavsdk.plugins.action_server import action_server, ActionServer
from mavsdk.plugins.mavlink_direct_server import MavlinkDirectServer, MavlinkMessage
from mavsdk.plugins.telemetry_server import telemetry_server, TelemetryServer

MAV_CMD_NAV_LAND = 21
MAV_AUTOPILOT_PX4, MAV_TYPE_QUADROTOR = 12, 2
ARMED, CUSTOM_MODE = 128, 1
# PX4's main and sub modes, as its heartbeat packs them.
MODES = {action_server.FlightMode.HOLD: 4 << 16 | 3 << 24, action_server.FlightMode.OFFBOARD: 6 << 16}
LAND_MODE = 4 << 16 | 6 << 24
PERIOD = 0.02
# From an error of velocity to an acceleration, 1/s: PX4's MPC_XY_VEL_P_ACC.
GAIN = 1.8

SCENARIO = """
program = "tour.starl"
duration = "60s"

[world]
way_point = [
    { name = "A", position = [1.5, 0.5, 1] },
    { name = "B", position = [0, -1, 1.5] },
]

[[robots]]
model = "drone"
name = "bird"
start = [{ position = [0, 0, 0] }]
"""

TOUR = """program Tour

motion = ReachAvoid(vicinity = 15cm)
next: Int in 0..way_points().size() + 1 = 0

go()
    pre next < way_points().size() and not motion.active and not motion.done
    eff motion.reach_avoid(way_points()[next], obstacles())

arrive()
    pre motion.done
    eff motion.stop(); next += 1

end()
    pre next == way_points().size()
    eff finish()

eventually toured: forall r: r.finished within 50s
"""


class Autopilot:
    """An autopilot at `port` of this machine, and what it was told."""

    def __init__(self, port):
        configuration = Configuration.create_with_component_type(ComponentType.AUTOPILOT)
        configuration.system_id = 1
        self.mavsdk = Mavsdk(configuration)
        assert self.mavsdk.add_any_connection(f"udpout://127.0.0.1:{port}") == 0
        component = self.mavsdk.server_component_by_type(ComponentType.AUTOPILOT)
        self.actions = ActionServer(component)
        self.telemetry = TelemetryServer(component)
        self.messages = MavlinkDirectServer(component)
        self.actions.set_armable(True, True)
        self.actions.set_disarmable(True, True)
        self.actions.set_allowable_flight_modes(action_server.AllowableFlightModes(can_guided_mode=True))
        self.actions.set_flight_mode(action_server.FlightMode.HOLD)
        self.actions.subscribe_arm_disarm(self.arm)
        self.actions.subscribe_flight_mode_change(self.change_mode)
        self.messages.subscribe_command(MAV_CMD_NAV_LAND, self.land)
        self.messages.subscribe_message("SET_POSITION_TARGET_LOCAL_NED", self.follow)
        self.mode, self.armed = MODES[action_server.FlightMode.HOLD], False
        # North, east, down, and yaw to the right.
        self.place, self.yaw = [0.0, 0.0, 0.0], 0.0
        self.velocity = [0.0, 0.0, 0.0]
        # The set-points.
        self.wanted, self.turn = [0.0, 0.0, 0.0], 0.0
        self.visited, self.told, self.alive = [], [], True
        self.begun = time.time()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def arm(self, result, command, _):
        self.armed = command.arm
        self.told.append("arm" if command.arm else "disarm")

    def change_mode(self, result, mode, _):
        if mode in MODES:
            self.mode = MODES[mode]
        self.told.append(action_server.FlightMode(mode).name)

    def land(self, command, _):
        fields = {"command": MAV_CMD_NAV_LAND, "result": 0, "progress": 0, "result_param2": 0}
        fields |= {"target_system": command.system_id, "target_component": command.component_id}
        self.send("COMMAND_ACK", fields)
        if self.mode != LAND_MODE:
            self.told.append("LAND")
        self.mode = LAND_MODE

    def follow(self, message, _):
        target = json.loads(message.fields_json)
        # A velocity ahead, to the right and down, and a rate of turn.
        assert (target["coordinate_frame"], target["type_mask"]) == (8, 0b010111000111), target
        ahead, right, down = (target[key] for key in ("vx", "vy", "vz"))
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        self.wanted = [cos * ahead - sin * right, sin * ahead + cos * right, down]
        self.turn = target["yaw_rate"]

    def send(self, name, fields):
        self.messages.send_message(MavlinkMessage(name, 1, 1, 0, 0, json.dumps(fields)))

    def run(self):
        beat = 0.0
        while self.alive:
            time.sleep(PERIOD)
            if self.mode == LAND_MODE:
                self.wanted, self.turn = [0.0, 0.0, 0.5], 0.0
            elif not self.armed or self.mode != MODES[action_server.FlightMode.OFFBOARD]:
                self.wanted, self.turn = [0.0, 0.0, 0.0], 0.0
            level = [v + PERIOD * GAIN * (w - v) for v, w in zip(self.velocity[:2], self.wanted[:2])]
            self.velocity = level + [self.wanted[2]]
            self.place = [p + PERIOD * v for p, v in zip(self.place, self.velocity)]
            self.yaw += PERIOD * self.turn
            if self.place[2] >= 0.0:
                self.place[2] = 0.0
                if self.mode == LAND_MODE and self.armed:
                    self.armed = False
                    self.told.append("disarm")
                    self.actions.set_armed_state(False)
            self.visited.append(tuple(self.place))
            now = int((time.time() - self.begun) * 1000)
            self.telemetry.publish_position_velocity_ned(
                telemetry_server.PositionVelocityNed(
                    telemetry_server.PositionNed(*self.place), telemetry_server.VelocityNed(*self.velocity)
                )
            )
            fields = {"time_boot_ms": now, "roll": 0.0, "pitch": 0.0, "yaw": self.yaw}
            self.send("ATTITUDE", fields | {"rollspeed": 0.0, "pitchspeed": 0.0, "yawspeed": self.turn})
            state = telemetry_server.LandedState
            landed = state.ON_GROUND if self.place[2] == 0.0 else state.IN_AIR
            self.telemetry.publish_extended_sys_state(telemetry_server.VtolState.UNDEFINED, landed)
            if now - beat > 500:
                # MAVSDK's own heartbeat names no autopilot.
                beat = now
                fields = {"type": MAV_TYPE_QUADROTOR, "autopilot": MAV_AUTOPILOT_PX4, "custom_mode": self.mode}
                fields["base_mode"] = CUSTOM_MODE | (ARMED if self.armed else 0)
                self.send("HEARTBEAT", fields | {"system_status": 4, "mavlink_version": 3})

    def end(self):
        self.alive = False
        self.thread.join()
        self.mavsdk.destroy()


def free_port():
    """A free port below those that the system gives to sockets that ask for any."""
    while True:
        port = random.randrange(26_000, 32_000)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as tried:
            try:
                tried.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port


def main():
    starl = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "tour.toml").write_text(SCENARIO)
        (folder / "tour.starl").write_text(TOUR)
        port = free_port()
        device = f'[robots.bird0]\ndevice = {{ kind = "mavlink", listen = "127.0.0.1:{port}" }}\n'
        link = f"[link]\nfirst_port = {free_port()}\n"
        (folder / "fleet.toml").write_text('scenario = "tour.toml"\n' + link + device)
        autopilot = Autopilot(port)
        try:
            command = [starl, "fleet", "up", "fleet.toml"]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)
            assert done.returncode == 0, done.stdout + done.stderr
            end = time.time() + 15
            while autopilot.armed and time.time() < end:
                time.sleep(0.1)
        finally:
            autopilot.end()
    for x, y, z in ((1.5, 0.5, 1.0), (0.0, -1.0, 1.5)):
        nearest = min(math.dist(place, (x, -y, -z)) for place in autopilot.visited)
        assert nearest < 0.3, (nearest, autopilot.told)
    # A command that is sent again tells nothing new.
    told = [name for name, _ in itertools.groupby(autopilot.told)]
    assert told == ["OFFBOARD", "arm", "LAND", "disarm"], told
    assert not autopilot.armed and autopilot.place[2] == 0.0, autopilot.place
    print("MAVSDK's autopilot is flown by a robot of a fleet:", ", ".join(told))


main()
