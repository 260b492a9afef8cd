"""The PyPI package natnet reads the emulated OptiTrack server, which so proves to be one.

    python3 natnet_client.py DEVICES

DEVICES is the example of that name, built.
"""

import math
import sys
import time

from emulator import Emulator
from natnet import NatNetClient


def read(emulator, port, version):
    frames, descriptions = [], []
    client = NatNetClient(command_port=port, use_multicast=False)
    client.on_data_frame_received_event.handlers.append(frames.append)
    client.on_data_description_received_event.handlers.append(descriptions.append)
    with client:
        assert client.server_info.application_name == "StarL emulated Motive"
        assert str(client.server_info.nat_net_protocol_version) == version, client.server_info
        client.request_modeldef()
        client.run_async()
        time.sleep(1)
        client.stop_async()
    numbers = {body.name: body.id_num for body in descriptions[0].rigid_bodies}
    assert set(numbers) == {"create", "drone", "px4", "ardupilot", "crazyflie", "twist", "stamped"}, numbers
    print(f"NatNet {version}: {len(frames)} frames in a second")
    assert 60 < len(frames) < 130
    order = [frame.prefix.frame_number for frame in frames]
    assert order == sorted(set(order)), "frames come in order, each once"
    for name, number in numbers.items():
        x, y, z, yaw = emulator.pose(name)
        (body,) = [body for body in frames[-1].rigid_bodies if body.id_num == number]
        assert body.tracking_valid
        assert math.dist(body.pos, (x, y, z)) < 1e-5, (body.pos, (x, y, z))
        seen = 2 * math.atan2(body.rot[2], body.rot[3])
        assert abs(seen - yaw) < 1e-5, (body.rot, yaw)
        suffix = frames[-1].suffix
        assert 0 < suffix.stamp_transmit - suffix.stamp_camera_mid_exposure < 1e9
    return order


def main():
    with Emulator(sys.argv[1]) as emulator:
        read(emulator, emulator.where["natnet_3"], "3.1.0.0")
        read(emulator, emulator.where["natnet_4"], "4.1.0.0")
    print("the package natnet reads the emulated OptiTrack server")


main()
