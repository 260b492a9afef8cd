"""Compares the speed of `starl.env` and VMAS: navigation with lidar, on one core.

Robots, rays, environments, physics steps and actions are the same for both. Needs `starl[env]`, `vmas` and `torch`:
`python apps/starl-py/benchmarks/navigation.py --robots 10 --environments 4096`
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable

import numpy as np


def memory() -> int:
    """Bytes of this process that are in memory."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def measure(name: str, step: Callable[[], object], robot_steps: int, seconds: float) -> float:
    """Robot-steps per CPU second, after a few steps to get going."""
    for _ in range(3):
        step()
    steps, begun = 0, time.process_time()
    while (took := time.process_time() - begun) < seconds:
        step()
        steps += 1
    rate = steps * robot_steps / took
    print(f"{name}: {rate:,.0f} robot-steps per CPU second ({steps} steps of {robot_steps:,} in {took:.1f} s)")
    return rate


def ours(arguments: argparse.Namespace) -> float:
    from starl.env import Lidar, VectorEnv, tasks

    before = memory()
    task = tasks.Navigation(arguments.robots, lidar=Lidar(arguments.rays, 0.35))
    env = VectorEnv(task, arguments.environments)
    env.reset(seed=1)
    random = np.random.default_rng(1)
    actions = random.uniform(-1, 1, (8, arguments.environments, arguments.robots, 3)).astype(np.float32)
    turn = 0

    def step() -> None:
        nonlocal turn
        turn += 1
        env.step(actions[turn % 8])

    step()
    used = (memory() - before - actions.nbytes) / arguments.environments
    print(f"starl: {used / 1024:.1f} KiB of memory for an environment of {arguments.robots} robots")
    return measure("starl", step, arguments.environments * arguments.robots, arguments.seconds)


def theirs(arguments: argparse.Namespace) -> float:
    import torch
    from vmas import make_env  # type: ignore[import-untyped]

    torch.set_num_threads(1)
    env = make_env(
        "navigation",
        num_envs=arguments.environments,
        device="cpu",
        continuous_actions=True,
        max_steps=200,
        seed=1,
        n_agents=arguments.robots,
        n_lidar_rays=arguments.rays,
        lidar_range=0.35,
    )
    env.reset(seed=1)
    generator = torch.Generator().manual_seed(1)
    shape = (8, arguments.robots, arguments.environments, 2)
    actions = 2 * torch.rand(shape, generator=generator) - 1
    turn = 0

    def step() -> None:
        nonlocal turn
        turn += 1
        with torch.no_grad():
            env.step(list(actions[turn % 8]))

    return measure("VMAS", step, arguments.environments * arguments.robots, arguments.seconds)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=10)
    parser.add_argument("--rays", type=int, default=12)
    parser.add_argument("--environments", type=int, default=4096)
    parser.add_argument("--seconds", type=float, default=10.0, help="CPU time for each of the two")
    parser.add_argument("--only", choices=["starl", "vmas"])
    arguments = parser.parse_args()
    rates = [run(arguments) for name, run in (("starl", ours), ("vmas", theirs)) if arguments.only in (None, name)]
    if len(rates) == 2:
        print(f"starl / VMAS: {rates[0] / rates[1]:.1f}")


if __name__ == "__main__":
    main()
