"""Runs each example on each platform from the same files, and writes the table of docs/reference/portability.md.

    target/venv/bin/python tools/portability.py STARL FOLDER [EXAMPLE...]

With EXAMPLE only these rows change. STARL must be built with the feature `zenoh`. FOLDER receives the fleets' files and traces. Real time passes: all examples
take about a quarter of an hour, several of them at once. Traffic stays on this machine.
"""

import concurrent.futures
import itertools
import json
import pathlib
import socket
import subprocess
import sys
import threading

import numpy
from mcap.reader import make_reader

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/reference/portability.md"
MARK = "<!-- tools/portability.py writes what follows -->\n"
# Examples with more robots than this are too many processes for one small machine.
MOST_ROBOTS = 10
# How many fleets run at once.
AT_ONCE = 2
# A fleet has at least this time, and one and a half times as long as the simulator's run, in seconds.
SHORTEST = 100
# A fleet that has not ended this long after its time is stopped, in seconds.
PATIENCE = 100
# Where the ways of robots are compared with those in the simulator.
COMPARED = ["UDP", "Create and AR.Drone", "Crazyflie", "MAVLink", "ROS 2"]
DIFFERENCES = """
## How far paths differ

The distance between the path of a robot on each platform and its path in the simulator: the largest over all robots and
all positions, in both directions (the Hausdorff distance). Poses are recorded every 100 ms, and on real platforms they are the
robot's own estimates. Robots choose other paths where the order of messages decides what each of them does, as in
`auction` and `flocking`.

"""
PLATFORMS = ["simulator", "UDP", "Zenoh", "Create and AR.Drone", "Crazyflie", "MAVLink", "ROS 2"]


class Ports:
    """Hands out ports that are free, each once."""

    def __init__(self, first):
        self.next = first
        self.lock = threading.Lock()

    def take(self, count):
        with self.lock:
            return self.find(count)

    def find(self, count):
        while True:
            first, self.next = self.next, self.next + count
            if all(self.is_free(port) for port in range(first, first + count)):
                return first

    @staticmethod
    def is_free(port):
        for kind in (socket.SOCK_DGRAM, socket.SOCK_STREAM):
            with socket.socket(socket.AF_INET, kind) as tried:
                try:
                    tried.bind(("127.0.0.1", port))
                except OSError:
                    return False
        return True


def devices(robots, platform, ports):
    """The tables of a fleet file that name the devices, or the reason why there are none."""
    first = ports.take(1)
    text = f'[positions]\nkind = "natnet"\nserver = "127.0.0.1:{first}"\n'
    if platform == "ROS 2":
        text = '[positions]\nkind = "ros2"\n'
    named = 0
    for name, model in robots:
        if platform == "MAVLink" and model == "drone":
            device = f'{{ kind = "mavlink", listen = "127.0.0.1:{ports.take(1)}" }}'
        elif platform == "Crazyflie" and model == "drone":
            device = f'{{ kind = "crazyflie", address = "127.0.0.1:{ports.take(1)}" }}'
        elif platform == "Create and AR.Drone" and model == "drone":
            first = ports.take(2)
            device = f'{{ kind = "ardrone", commands = "127.0.0.1:{first}", navdata = "127.0.0.1:{first + 1}" }}'
        elif platform == "Create and AR.Drone" and model == "create":
            device = f'{{ kind = "create", port = "{name}.line" }}'
        elif platform == "ROS 2" and model in ("create", "differential"):
            device = f'{{ kind = "ros2", router = "tcp/127.0.0.1:{first}", namespace = "{name}" }}'
        else:
            continue
        named += 1
        text += f'[robots."{name}"]\ndevice = {device}\n'
    return text if named else None


def run_real(starl, folder, example, robots, seconds, platform, ports):
    """The result of one example on one real platform."""
    if len(robots) > MOST_ROBOTS:
        return f"not tried: {len(robots)} robots"
    place = folder / example / platform.replace(" ", "-")
    place.mkdir(parents=True, exist_ok=True)
    kind = "zenoh" if platform == "Zenoh" else "udp"
    text = f'scenario = "{example}"\n[link]\nkind = "{kind}"\nfirst_port = {ports.take(len(robots))}\n'
    arguments = []
    if platform not in ("UDP", "Zenoh"):
        tables = devices(robots, platform, ports)
        if tables is None:
            return "no such robots"
        text += tables
        arguments = ["--emulate"]
    (place / "fleet.toml").write_text(text)
    command = [starl, "fleet", "up", "fleet.toml", "--quiet", "--duration", f"{seconds}s", *arguments]
    try:
        done = subprocess.run(command, cwd=place, capture_output=True, text=True, timeout=seconds + PATIENCE)
    except subprocess.TimeoutExpired:
        return f"did not end within {seconds + PATIENCE} s"
    (place / "output.txt").write_text(done.stdout + done.stderr)
    if done.returncode == 0:
        return "passes"
    violated = [line.split()[0] for line in done.stdout.splitlines() if " VIOLATED" in line]
    if violated:
        return "violates " + ", ".join(violated)
    if done.returncode == 1:
        return "did not finish in time"
    return "refused: " + done.stderr.strip().splitlines()[-1]


def poses(trace):
    """The way of each robot in a trace, as an array of positions and the times of these, seconds."""
    ways = {}
    with open(trace, "rb") as file:
        for _, _, message in make_reader(file).iter_messages(["/starl/pose"]):
            record = json.loads(message.data)
            way = ways.setdefault(record["robot"], [])
            way.append((message.log_time * 1e-9, record["x"], record["y"], record["z"]))
    return {robot: numpy.array(way) for robot, way in ways.items()}


def along(way, spacing=0.02):
    """Points on the lines between the positions of a way, at most `spacing` metres apart."""
    points = [way[0]]
    for start, end in zip(way, way[1:]):
        steps = max(1, int(numpy.ceil(numpy.linalg.norm(end - start) / spacing)))
        points.extend(start + (end - start) * step / steps for step in range(1, steps + 1))
    return numpy.array(points)


def farthest(way, other):
    """The largest distance of a position on `way` from the nearest one on `other`, metres."""
    line = along(other)
    return max(numpy.linalg.norm(line - position, axis=1).min() for position in way)


def deviation(simulated, real):
    """How far the ways of the robots of two traces differ, metres: the largest over the robots, in both directions."""
    first, second = poses(simulated), poses(real)
    both = [(first[robot][:, 1:], second[robot][:, 1:]) for robot in first if robot in second]
    return max(max(farthest(one, other), farthest(other, one)) for one, other in both)


def compared(folder, name, platform):
    """How far the ways of an example's robots on a platform are from those in the simulator."""
    merged = folder / name / platform.replace(" ", "-") / "fleet.runs/0001/merged.mcap"
    return f"{deviation(folder / name / 'simulated.mcap', merged):.2f} m" if merged.exists() else ""


def renewed(page, rows):
    """Rows with a heading, with the rows of other examples as they are in the table with this heading on the page."""
    heading = f"| {' | '.join(rows[0])} |"
    lines = page.partition(heading + "\n")[2].splitlines()[1:]
    old = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in itertools.takewhile(str.strip, lines)]
    new = {row[0]: row for row in rows[1:]}
    kept = [new.pop(row[0], row) for row in old]
    return [rows[0], *kept, *new.values()]


def table(rows):
    lines = [" | ".join(row) for row in rows]
    lines.insert(1, " | ".join(["---"] * len(rows[0])))
    return "".join(f"| {line} |\n" for line in lines)


def main():
    starl, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
    listed = json.loads(subprocess.run([starl, "list", "--json"], capture_output=True, text=True, check=True).stdout)
    names = sys.argv[3:] or [example["name"] for example in listed["examples"]]
    ports, results = Ports(21000), {}
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        waiting = {}
        for name in names:
            (folder / name).mkdir(parents=True, exist_ok=True)
            command = [starl, "run", name, "--json", "--trace", folder / name / "simulated.mcap"]
            report = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
            results[name, "simulator"] = "passes" if report["outcome"] == "reached" else report["outcome"]
            robots = [(robot["name"], robot["model"]) for robot in report["robots"]]
            seconds = max(SHORTEST, round(1.5 * report["sim_seconds"]))
            for platform in PLATFORMS[1:]:
                job = pool.submit(run_real, starl, folder, name, robots, seconds, platform, ports)
                waiting[job] = (name, platform)
        for job in concurrent.futures.as_completed(waiting):
            results[waiting[job]] = job.result()
            print(*waiting[job], job.result(), flush=True)
    rows = [["example", *PLATFORMS]]
    rows += [[f"`{name}`", *(results[name, platform] for platform in PLATFORMS)] for name in names]
    compare = [["example", *COMPARED]]
    compare += [[f"`{name}`", *(compared(folder, name, platform) for platform in COMPARED)] for name in names]
    compare = [row for row in compare if any(row[1:])]
    page = PAGE.read_text()
    if sys.argv[3:]:
        rows, compare = renewed(page, rows), renewed(page, compare)
    head, _, _ = page.partition(MARK)
    PAGE.write_text(head + MARK + "\n" + table(rows) + DIFFERENCES + table(compare))


if __name__ == "__main__":
    main()
