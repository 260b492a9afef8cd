"""Loss, duplication and delay of datagrams against their distributions."""

import math

from .chart import chart, table

DELAY, JITTER, LOSS, COPIES, HELD = 0.040, 0.012, 0.1, 0.05, 0.03


def scenario(lines):
    return f"""
program = "radio"
duration = "30s"
goal = "duration"
[network]
delay = "40ms"
{lines}
[[robots]]
model = "create"
count = 2
control_period = "2ms"
[world]
start_area = {{ low = [0, 0], high = [40, 40] }}
"""


def normal(value):
    return 0.5 * (1 + math.erf((value - DELAY) / JITTER / math.sqrt(2)))


def uniform(value):
    half = JITTER * math.sqrt(3)
    return min(1.0, max(0.0, (value - DELAY + half) / (2 * half)))


def exponential(value):
    return 1 - math.exp(-max(0.0, value - DELAY + JITTER) / JITTER)


def delays(trace):
    """Of each datagram that arrived: the delays of its copies, in seconds; and how many were sent."""
    sent = {(content["robot"], content["sequence"]): time for time, content in trace["sent"]}
    found = {}
    for time, content in trace["delivered"]:
        key = content["from"], content["sequence"]
        found.setdefault(key, []).append((time - sent[key]) * 1e-9)
    # Those that are sent at the end have no time to arrive.
    last = max(sent.values()) - 5e8
    return {key: found.get(key, []) for key, time in sent.items() if time < last}


def share(count, of, expected):
    """A share, and how far it is from what it should be, in standard deviations."""
    deviation = (count - of * expected) / math.sqrt(of * expected * (1 - expected))
    return [f"{of:,}", f"{expected:.3f}", f"{count / of:.4f}", f"{deviation:+.1f}"]


def validate(simulator, folder):
    rows, lines = [], []
    for name, distribution in [("normal", normal), ("uniform", uniform), ("exponential", exponential)]:
        trace = simulator.run(scenario(f'jitter = "12ms"\ndistribution = "{name}"'))
        found = sorted(value for copies in delays(trace).values() for value in copies)
        count = len(found)
        # Kolmogorov and Smirnov: the greatest distance between the two distributions.
        steps = enumerate(found)
        distance = max(max(abs(distribution(at) - index / count), abs(distribution(at) - (index + 1) / count)) for index, at in steps)
        mean = sum(found) / count
        spread = math.sqrt(sum((value - mean) ** 2 for value in found) / count)
        critical = 1.63 / math.sqrt(count)
        rows.append([name, f"{count:,}", f"{mean * 1e3:.2f} ms", f"{spread * 1e3:.2f} ms", f"{distance:.4f}", f"{critical:.4f}"])
        assert distance < critical, f"{name}: {distance} is not below {critical}"
        shown = found[:: count // 60]
        lines.append((f"{name}, run", [(value * 1e3, (index * (count // 60) + 0.5) / count) for index, value in enumerate(shown)], "dots"))
        curve = [(at, distribution(at * 1e-3)) for at in range(0, 121, 2)]
        lines.append((f"{name}, theory", curve))
    (folder / "delays.svg").write_text(chart("Delays of datagrams", "delay, ms", "share of datagrams", lines))
    knobs = f'jitter = "0ms"\nloss = {LOSS}\nduplication = {COPIES}\nreordering = {HELD}\nreordering_delay = "50ms"'
    found = delays(simulator.run(scenario(knobs)))
    arrived = [copies for copies in found.values() if copies]
    copies = [value for several in arrived for value in several]
    chances = [
        ["loss", *share(len(found) - len(arrived), len(found), LOSS)],
        ["duplication", *share(sum(len(several) == 2 for several in arrived), len(arrived), COPIES)],
        ["reordering", *share(sum(value > DELAY + 0.025 for value in copies), len(copies), HELD)],
    ]
    assert all(abs(float(row[-1])) < 4 for row in chances), chances
    first = table(
        ["distribution", "datagrams", "mean (40 ms)", "deviation (12 ms)", "distance of Kolmogorov and Smirnov", "critical at 1 %"], rows
    )
    second = table(["chance", "trials", "set", "found", "deviations from it"], chances)
    return f"{first}\n\n{second}"
