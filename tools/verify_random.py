"""`starl verify` agrees with the runs of random scenarios.

Makes scenarios with random fleets (models, sizes, bodies, programs), worlds, networks, faults, winds and time steps, runs
each with a trace, and judges it by the trace alone. Each property that `verify` judges must have the verdict of the run,
with the same first violation, and no law of the simulated world may be broken. A scenario that fails is kept.

Usage: verify_random.py PATH-OF-STARL [--count N] [--first N] [--keep FOLDER]
"""

import argparse
import collections
import itertools
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LAWS = [
    "speed_limit",
    "acceleration_limit",
    "turn_rate_limit",
    "datagram_integrity",
    "datagram_delay",
    "datagram_range",
    "datagram_order",
]
PROGRAMS = [
    "race", "diffusion", "keeper", "radio", "race.starl", "mutex.starl", "election.starl", "messages.starl",
    "broadcast.starl", "register.starl", "memory.starl", "registration.starl", "barrier.starl", "detector.starl",
    "auction.starl", "formation.starl", "flocking.starl", "line.starl", "maze.starl",
]  # fmt: skip
# Programs that command their own drives name the models that they fit.
MODELS = {
    "diffusion": ["differential"],
    "radio": ["create", "differential"],
    None: ["create", "drone", "car", "holonomic", "differential"],
}
RADII = {"create": 0.165, "drone": 0.34, "car": 0.33, "holonomic": 0.15, "differential": 0.085}


def quantity(number, unit):
    return f'"{number:.6g}{unit}"'


def link(draw):
    """The fields of a link."""
    delay = draw.choice([0.2, 1, 5, 15, 40, 120]) * draw.uniform(0.5, 1.5)
    kind = draw.choice(["constant", "uniform", "normal", "exponential"])
    lines = [f'distribution = "{kind}"', f"delay = {quantity(delay, 'ms')}"]
    jitter = 0 if kind == "constant" else delay * draw.uniform(0, 0.55 if kind == "uniform" else 1)
    lines.append(f"jitter = {quantity(jitter, 'ms')}")
    for field in ["loss", "duplication", "reordering"]:
        if draw.random() < 0.4:
            lines.append(f"{field} = {draw.choice([0.01, 0.1, 0.3, 0.6])}")
    if draw.random() < 0.3:
        lines.append(f"reordering_delay = {quantity(draw.uniform(1, 200), 'ms')}")
    return lines


def network(draw):
    lines = ["[network]", *link(draw)]
    if draw.random() < 0.3:
        lines.append(f"range = {quantity(draw.uniform(1, 8), 'm')}")
    if draw.random() < 0.2:
        lines.append("line_of_sight = true")
    if draw.random() < 0.2:
        lines.append(f"bandwidth = {quantity(draw.choice([20, 100, 1000]), 'kbit/s')}")
    if draw.random() < 0.3:
        lines.append(f"resolution = {quantity(draw.choice([0.1, 0.5, 5, 40]), 'ms')}")
    if draw.random() < 0.2:
        lines += ["[[network.link]]", 'from = ["g0"]', *link(draw)]
    return lines


def fleet(draw, program):
    lines, area = [], 0.0
    for group in range(draw.choice([1, 1, 2, 3])):
        model = draw.choice(MODELS.get(program, MODELS[None]))
        count = draw.choice([1, 2, 3, 4, 6, 10])
        lines += ["[[robots]]", f'model = "{model}"', f'name = "g{group}"', f"count = {count}"]
        radius = RADII[model]
        if draw.random() < 0.4:
            radius *= draw.uniform(0.6, 2)
            lines.append(f"model_parameters = {{ radius = {quantity(radius, 'm')} }}")
        if draw.random() < 0.3:
            lines.append(f"control_period = {quantity(draw.choice([10, 50, 200, 500]), 'ms')}")
        if draw.random() < 0.2:
            lines.append(f"clock = {{ offset = \"{draw.randint(0, 3000)}ms\", drift = \"{draw.randint(0, 5000)}ppm\" }}")
        if program == "diffusion":
            lines.append("sensors = { proximity = true }")
        area += count * (2 * radius + 0.3) ** 2
    return lines, area


def world(draw, area):
    side = max(2.0, (area * draw.uniform(3, 12)) ** 0.5)
    width, height = side, side * draw.uniform(0.6, 1.4)
    lines = ["[world]"]
    corners = f"{{ low = [0, 0], high = [{width:.3f}, {height:.3f}] }}"
    lines.append(f"{draw.choice(['bounds', 'start_area'])} = {corners}")
    place = lambda: (draw.uniform(0.1, 0.9) * width, draw.uniform(0.1, 0.9) * height)
    for number in range(draw.randint(3, 8)):
        x, y = place()
        lines += ["[[world.way_point]]", f'name = "P{number}"', f"position = [{x:.3f}, {y:.3f}]"]
    for _ in range(draw.choice([0, 0, 1, 3, 6])):
        (x, y), size = place(), draw.uniform(0.02, 0.12) * side
        lines.append("[[world.obstacle]]")
        if draw.random() < 0.5:
            lines.append(f"circle = {{ center = [{x:.3f}, {y:.3f}], radius = {quantity(size, 'm')} }}")
        else:
            lines.append(f"rectangle = {{ low = [{x:.3f}, {y:.3f}], high = [{x + size:.3f}, {y + size / 2:.3f}] }}")
        if draw.random() < 0.3:
            lines.append("hidden = true")
        if draw.random() < 0.2:
            lines.append(f'expires = "{draw.randint(1, 8)}s"')
    return lines


def others(draw):
    lines = ["[physics]", f"step = {quantity(draw.choice([1, 5, 10, 25, 25, 50, 100]), 'ms')}"]
    lines += ["[trace]", f"pose_period = {quantity(draw.choice([25, 50, 100, 100, 250]), 'ms')}"]
    lines += ["[positioning]", f"period = {quantity(draw.choice([20, 50, 100]), 'ms')}"]
    if draw.random() < 0.5:
        lines.append(f"position_noise = {quantity(draw.uniform(0, 20), 'mm')}")
    lines += ["[motion]", f"avoidance = {draw.choice(['true', 'false'])}"]
    if draw.random() < 0.4:
        lines += [f"speed_noise = {draw.uniform(0, 1):.3f}", f"turn_noise = {draw.uniform(0, 1):.3f}"]
    if draw.random() < 0.4:
        wind = lambda most: f"[{draw.uniform(-most, most):.2f}, {draw.uniform(-most, most):.2f}]"
        lines += ["[wind]", f"steady = {wind(3)}", f"gust = {wind(2)}", f'gust_period = "{draw.randint(1, 10)}s"']
    if draw.random() < 0.5:
        lines.append("[fault_rates]")
        for kind, end in [
            ("crash", "restart_after"),
            ("partition", "heal_after"),
            ("stuck_motor", "repair_after"),
            ("frozen_sensor", None),
            ("corrupt_state", None),
        ]:
            if draw.random() < 0.5:
                lines.append(f"{kind} = {quantity(draw.choice([0.02, 0.1, 0.3]), '/s')}")
                if end:
                    lines.append(f"{end} = {quantity(draw.uniform(0.5, 4), 's')}")
    if draw.random() < 0.2:
        lines += ["[[event]]", f'at = "{draw.randint(1, 5)}s"', 'kind = "push"', 'robot = "g00"', "by = [0.3, 0.1]"]
        lines += ["[[event]]", f'at = "{draw.randint(1, 6)}s"', 'kind = "network"', *link(draw)]
    return lines


def scenario(seed):
    draw = random.Random(seed)
    program = draw.choice(PROGRAMS)
    robots, area = fleet(draw, program)
    head = [
        f'program = "{program}"',
        f"seed = {seed}",
        f'duration = "{draw.choice([4, 8, 12, 20])}s"',
        'goal = "duration"' if draw.random() < 0.5 else 'goal = "finished"',
    ]
    return "\n".join([*head, *world(draw, area), *network(draw), *others(draw), *robots]) + "\n"


def compare(run, account):
    """What differs between the verdicts of a run and those of its trace."""
    known = {entry["property"]: entry for entry in run["properties"]}
    judged = [entry for entry in account["properties"] if entry["reason"] is None]
    differences = []
    for entry in judged:
        name = entry["property"]
        if name in LAWS:
            if entry["verdict"] != "holds":
                differences.append(f"{name}: {entry['first']}")
        elif any(known[name][field] != entry[field] for field in ["verdict", "first", "violations"]):
            differences.append(f"{name}: the run says {known[name]}, its trace {entry}")
    names = {entry["property"] for entry in judged}
    differences += [f"{law} is not judged" for law in LAWS if law not in names]
    return differences, judged


def attempt(starl, programs, seed):
    """Runs the scenario of a seed, and judges its trace: the two finished processes. None instead of the second if the
    scenario is refused."""
    with tempfile.TemporaryDirectory() as folder:
        for program in programs:
            shutil.copy(program, folder)
        (Path(folder) / "random.toml").write_text(scenario(seed))
        arguments = [starl, "run", "random.toml", "--json", "--trace", "random.mcap"]
        run = subprocess.run(arguments, cwd=folder, capture_output=True, text=True)
        if run.returncode not in (0, 1):
            return run, None
        arguments = [starl, "verify", "random.mcap", "--json"]
        return run, subprocess.run(arguments, cwd=folder, capture_output=True, text=True)


def attempts(starl, first):
    """Each seed from the first with its attempt, in order; as many at once as there are cores."""
    programs = list(ROOT.glob("examples/**/*.starl"))
    seeds = itertools.count(first)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        coming = collections.deque()
        while True:
            while len(coming) <= os.cpu_count():
                seed = next(seeds)
                coming.append((seed, pool.submit(attempt, starl, programs, seed)))
            seed, attempted = coming.popleft()
            yield seed, *attempted.result()


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("starl", type=Path)
    options.add_argument("--count", type=int, default=1000)
    options.add_argument("--first", type=int, default=1)
    options.add_argument("--keep", type=Path)
    given = options.parse_args()
    starl = given.starl.resolve()
    totals, refused, bad = collections.Counter(), collections.Counter(), 0
    for seed, done, verified in attempts(starl, given.first):
        if verified is None:
            reason = done.stderr.strip().splitlines()[0] if done.stderr.strip() else str(done.returncode)
            refused[reason.split(": ", 1)[-1]] += 1
            assert refused.total() < 2 * given.count + 20, refused.most_common(5)
            continue
        run = json.loads(done.stdout)
        account = json.loads(verified.stdout) if verified.stdout else None
        differences, judged = compare(run, account) if account else ([verified.stderr], [])
        totals["scenarios"] += 1
        if totals["scenarios"] % 100 == 0:
            print(f"{totals['scenarios']} scenarios", file=sys.stderr, flush=True)
        totals["robots"] += len(run["robots"])
        totals["records"] += account["records"] if account else 0
        totals["datagrams delivered"] += run["messages"]["delivered"]
        totals["collisions"] += run["collisions"]
        totals["verdicts compared"] += len(judged)
        totals["verdicts of a violation"] += sum(entry["verdict"] == "violated" for entry in judged)
        if differences:
            bad += 1
            print(f"scenario {seed}:", *differences, sep="\n  ", flush=True)
            if given.keep:
                given.keep.mkdir(parents=True, exist_ok=True)
                (given.keep / f"{seed}.toml").write_text(scenario(seed))
        if totals["scenarios"] >= given.count:
            break
    print(*(f"{count:,} {what}" for what, count in totals.items()), sep=", ")
    for reason, count in refused.most_common(5):
        print(f"not run, {count} times: {reason}")
    if bad:
        sys.exit(f"{bad} of {totals['scenarios']} scenarios differ")
    print("every trace was judged as its run was, and no law was broken")


main()
