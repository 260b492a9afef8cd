"""Compares the cost of a program in Python and in the StarL language: processor time of the same kind of fleet, each robot of
which does little at each activation. `python apps/starl-py/benchmarks/programs.py --robots 100`
"""

from __future__ import annotations

import argparse
import time

import starl

COUNT = """program Count

radio = LocalBroadcast()
heard: Int = 0
beats: Int = 0

message Beat(number: Int)

beat()
    pre true
    eff radio.broadcast(Beat(beats)); beats += 1

on Beat(_, number)
    heard += number % 2
"""


class Count(starl.RobotProgram):
    def __init__(self) -> None:
        self.radio = starl.LocalBroadcast()
        self.heard = 0
        self.beats = 0

    def activate(self, robot: starl.RobotHandle) -> None:
        self.radio.broadcast(robot, self.beats)
        self.beats += 1

    def receive(self, robot: starl.RobotHandle, sender: int, message: int, primitive: object) -> None:
        self.heard += message % 2


class Idle(starl.RobotProgram):
    """The cost of the simulation without the program."""


def measure(program: starl.Program | starl.RobotProgram, robots: int, seconds: float) -> tuple[float, int, int]:
    """Processor time, activations and messages handled."""
    scenario = starl.Scenario(
        program=program, robots=f"create={robots}", duration=seconds, goal="duration", network={"range": "1m"},
        world={"bounds": {"low": [-1, -1], "high": [3 * robots**0.5, 3 * robots**0.5]}},
    )  # fmt: skip
    simulation = starl.Simulation(scenario, records=[])
    begun = time.process_time()
    simulation.run()
    took = time.process_time() - begun
    return took, round(robots * seconds * 10), simulation.report()["messages"]["delivered"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=20.0)
    arguments = parser.parse_args()
    costs = {}
    for name, program in (("idle", Idle()), ("language", starl.Program(COUNT)), ("Python", Count())):
        took, activations, delivered = measure(program, arguments.robots, arguments.seconds)
        costs[name] = took
        print(f"{name}: {took:.2f} s of processor time, {activations:,} activations, {delivered:,} messages handled")
    print(f"whole run, Python / language: {costs['Python'] / costs['language']:.1f}")


if __name__ == "__main__":
    main()
