"""Runs a fleet with many robots in processes of their own on this machine, and reports what its network loses.

    target/venv/bin/python tools/crowd.py STARL FOLDER [--robots 100] [--seconds 60] [--link router]

Each robot tells all others something once a second without acknowledgement (`tools/crowd/crowd.starl`), and its runtime sends
them beacons. When all robots hear each other, the script measures for `--seconds`: which datagrams in the traces of their
senders are not in those of their receivers, how long the others took, and what the processes need. It fails if one is lost,
if a robot is not heard, or if robots are not stopped. Needs a `starl` with the feature `zenoh`, and the package `mcap`.
"""

import argparse
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from mcap.reader import make_reader

HERE = pathlib.Path(__file__).resolve().parent
FIRST_PORT = 24400
# So long after its sending a datagram counts as lost, in seconds.
LATE = 2
# A robot that was not heard for so long is not connected, in seconds. A busy machine is slow, but loses nothing.
DEAF = 10
# When two robots start, each may begin a session, and what is sent in the older one is lost, so measure only after this, in seconds.
SETTLING = 5


def scenario(robots):
    starts = ", ".join(f"{{ position = [{i % 10}, {i // 10}] }}" for i in range(robots))
    return (
        'program = "crowd.starl"\nduration = "1h"\ngoal = "duration"\n\n'
        f'[[robots]]\nmodel = "holonomic"\nname = "robot"\ncount = {robots}\nstart = [{starts}]\n'
    )


def robots_of(up):
    """The processes of the robots that a process has started."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except (OSError, IndexError):
            continue
        if entry.name.isdigit() and parent == up.pid and words[1:2] == [b"robot"]:
            found.append(int(entry.name))
    return found


def needs(process):
    """Resident memory of a process in MiB, and the processor time that it has used in seconds."""
    text = pathlib.Path(f"/proc/{process}/status").read_text()
    memory = next(int(line.split()[1]) for line in text.splitlines() if line.startswith("VmRSS"))
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return memory / 1024, (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def statuses(starl, folder):
    done = subprocess.run([starl, "fleet", "status", "fleet.toml", "--json"], cwd=folder, capture_output=True, text=True)
    return json.loads(done.stdout or "[]")


def deaf(robots, seconds):
    """The number of pairs of which one has not heard the other for so long."""
    heard = lambda link: link["heard_ago"] is not None and link["heard_ago"] < seconds
    return sum(len(robots) - 1 - sum(map(heard, robot["links"])) for robot in robots)


def events(run, robot):
    """What a robot has sent and received: numbers with times in seconds."""
    sent, received = {}, {}
    with open(run / f"robot{robot}.1.mcap", "rb") as file:
        for _, channel, message in make_reader(file).iter_messages(["/starl/sent", "/starl/delivered"]):
            event, at = json.loads(message.data), message.log_time * 1e-9
            if channel.topic == "/starl/sent":
                sent[event["sequence"]] = at
            else:
                received[event["from"], event["sequence"]] = at
    return sent, received


def judge(run, robots, begin, end):
    """Counts the datagrams sent between two times, and their losses and delays."""
    known = [events(run, robot) for robot in range(robots)]
    due, lost, delays = 0, 0, []
    for sender, (sent, _) in enumerate(known):
        times = {number: at for number, at in sent.items() if begin <= at < end}
        for receiver, (_, received) in enumerate(known):
            if receiver == sender:
                continue
            due += len(times)
            for number, at in times.items():
                arrival = received.get((sender, number))
                if arrival is None or arrival - at > LATE:
                    lost += 1
                else:
                    delays.append(arrival - at)
    return due, lost, sorted(delays)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("starl")
    parser.add_argument("folder")
    parser.add_argument("--robots", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--link", choices=["router", "zenoh", "udp"], default="router", help="zenoh: without a router")
    arguments = parser.parse_args()
    starl, folder = str(pathlib.Path(arguments.starl).resolve()), pathlib.Path(arguments.folder).resolve()
    folder.mkdir(parents=True, exist_ok=False)
    (folder / "crowd.toml").write_text(scenario(arguments.robots))
    shutil.copy(HERE / "crowd/crowd.starl", folder)
    has_router = arguments.link == "router"
    place = f'router = "tcp/127.0.0.1:{FIRST_PORT}"' if has_router else f"first_port = {FIRST_PORT}"
    kind = "zenoh" if has_router else arguments.link
    (folder / "fleet.toml").write_text(f'scenario = "crowd.toml"\n[link]\nkind = "{kind}"\n{place}\n')
    router = subprocess.Popen([starl, "fleet", "router", "fleet.toml"], cwd=folder) if has_router else None
    begun = time.monotonic()
    with open(folder / "output.txt", "w") as output:
        command = [starl, "fleet", "up", "fleet.toml", "--quiet"]
        up = subprocess.Popen(command, cwd=folder, stdout=output, stderr=output)
    try:
        while missing := deaf(robots := statuses(starl, folder), DEAF) or arguments.robots - len(robots):
            if up.poll() is not None or time.monotonic() - begun > 60 + arguments.robots:
                sys.exit(f"robots do not hear each other: {missing} pairs\n{(folder / 'output.txt').read_text()}")
        run = folder / "fleet.runs/0001"
        print(f"all robots hear each other after {time.monotonic() - begun:.1f} s", flush=True)
        epoch = int((run / "epoch").read_text()) * 1e-9
        processes = robots_of(up)
        time.sleep(SETTLING)
        processes += [router.pid] if router else []
        begin, before = time.time() - epoch, [needs(process)[1] for process in processes]
        time.sleep(arguments.seconds)
        end, after = time.time() - epoch, [needs(process) for process in processes]
        time.sleep(LATE)
        last = statuses(starl, folder)
        stopped = subprocess.run([starl, "fleet", "stop", "fleet.toml"], cwd=folder, capture_output=True, text=True)
        print(stopped.stdout + stopped.stderr, end="")
        up.send_signal(signal.SIGINT)
        up.wait(timeout=300)
    finally:
        if up.poll() is None:
            up.send_signal(signal.SIGINT)
            up.wait(timeout=300)
        if router:
            router.send_signal(signal.SIGINT)
            router.wait(timeout=300)
    due, lost, delays = judge(run, arguments.robots, begin, end)
    part = lambda p: delays[min(len(delays) - 1, int(p * len(delays)))] * 1e3
    memory = [size for size, _ in after]
    busy = sum(after[i][1] - before[i] for i in range(len(before))) / (end - begin)
    print(f"datagrams: {due}, lost {lost} ({100 * lost / max(due, 1):.3f} %)")
    print(f"from sending to arrival: median {part(0.5):.1f} ms, p99 {part(0.99):.1f} ms, most {delays[-1] * 1e3:.1f} ms")
    worst = max((link["loss"] for robot in last for link in robot["links"]), default=1.0)
    print(f"beacons: {len(last)} robots answer, worst recent loss {worst:.3f}, {deaf(last, DEAF)} pairs deaf")
    print(f"memory: {sum(memory):.0f} MiB, {max(memory):.1f} MiB for the largest process; processors: {busy:.2f}")
    all_answer = len(last) == arguments.robots and not deaf(last, DEAF)
    sys.exit(0 if due and not lost and all_answer and stopped.returncode == 0 else 1)


main()
