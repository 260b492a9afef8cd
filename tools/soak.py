"""Runs a fleet of eight for a long time with faults, and reports what it needs and how fast it recovers.

    python3 tools/soak.py STARL FOLDER [--minutes 30] [--seed 1]

Four emulated Creates on serial lines and four emulated AR.Drones on UDP go to docks and back (`tools/soak/docks.starl`) over a
network that loses and delays packets. Every 20 s a robot's process is killed, is stopped for 5 s, or receives 2,000 packets
of noise. The script fails if a property is violated, a robot fails or does not recover, memory grows, or a trace exceeds its
limit. Traffic stays on this machine.
"""

import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
CREATES, DRONES, DOCKS = 4, 4, 3
# A robot whose trace has ended cannot be judged, and half an hour takes about 30 MiB.
TRACE_LIMIT_MIB = 64
FIRST_PORT = 23400
# A robot has recovered when it runs and hears all others. It has so long for it, in seconds.
PATIENCE = 20
PERIOD = 20


def scenario(minutes):
    robots = ""
    for model, name, y, count in (("create", "ground", -2, CREATES), ("drone", "air", 2, DRONES)):
        starts = ", ".join(f"{{ position = [{2 * i}, {y}] }}" for i in range(count))
        robots += f'[[robots]]\nmodel = "{model}"\nname = "{name}"\ncount = {count}\nstart = [{starts}]\n\n'
    docks = ", ".join(f'{{ name = "dock{i}", position = [{3 * i}, 0, 0.6] }}' for i in range(DOCKS))
    return (
        f'program = "docks.starl"\nduration = "{minutes}min"\ngoal = "duration"\n\n[storage]\nkept = true\n\n'
        f"[world]\nway_point = [{docks}]\n\n{robots}"
    )


def fleet():
    text = f'scenario = "docks.toml"\ntrace_limit_mib = {TRACE_LIMIT_MIB}\n\n[link]\nfirst_port = {FIRST_PORT}\n'
    text += 'rehearse = { loss = 0.1, duplication = 0.05, delay = "20ms", jitter = "10ms" }\n\n'
    text += f'[positions]\nkind = "natnet"\nserver = "127.0.0.1:{FIRST_PORT + 100}"\n\n'
    for i in range(CREATES):
        text += f'[robots.ground{i}]\ndevice = {{ kind = "create", port = "ground{i}.line" }}\n'
    for i in range(DRONES):
        commands, navdata = FIRST_PORT + 110 + 2 * i, FIRST_PORT + 111 + 2 * i
        addresses = f'commands = "127.0.0.1:{commands}", navdata = "127.0.0.1:{navdata}"'
        text += f'[robots.air{i}]\ndevice = {{ kind = "ardrone", {addresses} }}\n'
    return text


class Fleet:
    """The processes of `starl fleet up` in a folder."""

    def __init__(self, starl, folder):
        self.starl, self.folder = starl, folder
        self.output = open(folder / "output.txt", "w")
        command = [starl, "fleet", "up", "fleet.toml", "--emulate"]
        self.up = subprocess.Popen(command, cwd=folder, stdout=self.output, stderr=subprocess.STDOUT)

    def processes(self):
        """The process of each robot, by its name, and that of the emulator."""
        found = {}
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
            except (OSError, IndexError):
                continue
            if parent != self.up.pid or len(words) < 3:
                continue
            if words[1] == b"robot":
                found[words[words.index(b"--id") + 1].decode()] = int(entry.name)
            elif words[1] == b"emulate":
                found["emulator"] = int(entry.name)
        return found

    def status(self):
        command = [self.starl, "fleet", "status", "fleet.toml", "--json"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        return {robot["name"]: robot for robot in json.loads(done.stdout or "[]")}

    def is_well(self, name):
        """Whether a robot runs and hears all others."""
        robot = self.status().get(name, {})
        if robot.get("condition") == "failed":
            sys.exit(f"{name} has failed: {robot.get('failure')}")
        heard = [link for link in robot.get("links", []) if (link["heard_ago"] or 9.0) < 1.0]
        return robot.get("condition") == "running" and len(heard) == CREATES + DRONES - 1


def memory(process):
    """Resident memory of a process, KiB; none if it has gone."""
    try:
        for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines():
            if line.startswith("VmRSS"):
                return int(line.split()[1])
    except OSError:
        pass
    return None


def noise(port, draw):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for _ in range(2000):
            packet = draw.randbytes(draw.randrange(300))
            # Half of them look like a kind of packet.
            if packet and draw.random() < 0.5:
                packet = bytes([draw.randrange(6)]) + packet[1:]
            sender.sendto(packet, ("127.0.0.1", port))


def disturb(fleet, names, draw):
    """Does one thing to a robot, and waits until it has recovered; what it was, and how long that took."""
    name, kind = draw.choice(names), draw.choice(["killed", "stopped for 5 s", "2,000 packets of noise"])
    process = fleet.processes().get(name)
    if process is None:
        return None
    if kind == "killed":
        os.kill(process, signal.SIGKILL)
    elif kind == "stopped for 5 s":
        os.kill(process, signal.SIGSTOP)
        time.sleep(5)
        os.kill(process, signal.SIGCONT)
    else:
        noise(FIRST_PORT + names.index(name), draw)
    begun = time.monotonic()
    if kind == "killed":
        # The status may still be the old one's.
        time.sleep(1)
    while not fleet.is_well(name):
        if time.monotonic() - begun > PATIENCE:
            sys.exit(f"{name}, {kind}: has not recovered after {PATIENCE} s: {fleet.status().get(name)}")
        time.sleep(0.1)
    return kind, time.monotonic() - begun


def report(recoveries, samples, folder):
    """Prints the figures; whether memory is flat and traces are within their limit."""
    print("| what happened to a robot | times | recovered after, median | at most |\n| --- | ---: | ---: | ---: |")
    for kind, times in sorted(recoveries.items()):
        times.sort()
        print(f"| {kind} | {len(times)} | {times[len(times) // 2]:.1f} s | {times[-1]:.1f} s |")
    is_flat = True
    print("\n| process | memory after a third | at the end |\n| --- | ---: | ---: |")
    for name, sizes in sorted(samples.items()):
        third, last = sizes[len(sizes) // 3], sizes[-1]
        is_flat &= last < 1.25 * third + 4096
        print(f"| {name} | {third / 1024:.1f} MiB | {last / 1024:.1f} MiB |")
    largest = max(path.stat().st_size for path in folder.glob("fleet.runs/0001/*.[0-9]*.mcap"))
    print(f"\nlargest trace of a robot's life: {largest / 2**20:.1f} MiB")
    return is_flat and largest < (TRACE_LIMIT_MIB + 1) * 2**20


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("starl")
    parser.add_argument("folder")
    parser.add_argument("--minutes", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.folder).resolve()
    folder.mkdir(parents=True, exist_ok=False)
    (folder / "docks.toml").write_text(scenario(arguments.minutes))
    (folder / "fleet.toml").write_text(fleet())
    shutil.copy(HERE / "soak/docks.starl", folder)
    draw = random.Random(arguments.seed)
    names = [f"ground{i}" for i in range(CREATES)] + [f"air{i}" for i in range(DRONES)]
    up = Fleet(str(pathlib.Path(arguments.starl).resolve()), folder)
    recoveries, samples = {}, {}
    begun = time.monotonic()
    try:
        while up.up.poll() is None:
            elapsed = time.monotonic() - begun
            for name, process in up.processes().items():
                if (size := memory(process)) is not None:
                    samples.setdefault(name, []).append(size)
            # The end is calm.
            if PERIOD < elapsed < arguments.minutes * 60 - 2 * PERIOD and (done := disturb(up, names, draw)):
                kind, seconds = done
                recoveries.setdefault(kind, []).append(seconds)
                print(f"{elapsed:7.1f} s: {kind}, recovered after {seconds:.1f} s", file=sys.stderr, flush=True)
            time.sleep(max(0.0, PERIOD - (time.monotonic() - begun - elapsed)))
    finally:
        if up.up.poll() is None:
            up.up.send_signal(signal.SIGINT)
            up.up.wait(timeout=60)
    output = (folder / "output.txt").read_text()
    print(output[output.rfind("merged.mcap") :])
    is_well = report(recoveries, samples, folder)
    sys.exit(0 if is_well and up.up.returncode == 0 else 1)


main()
