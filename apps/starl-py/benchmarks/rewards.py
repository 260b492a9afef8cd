"""Measures what expressions of the language cost beside NumPy: rewards, ends and information of navigation, on one core.

Needs `starl[env]`: `python apps/starl-py/benchmarks/rewards.py --robots 10 --environments 4096`
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np

from starl.env import Task, VectorEnv, World, tasks


class ByNumPy(tasks.Navigation):
    """`Navigation` with methods instead of expressions."""

    def begin(self, world: World) -> None:
        self.left = np.zeros((world.environments, world.robots))

    def reset(self, world: World, envs: Any) -> None:
        super().reset(world, envs)
        self.left[envs] = self._distances(world)[envs]

    def reward(self, world: World) -> Any:
        before, self.left = self.left, self._distances(world)
        return before - self.left - (world.contacts >= 0)

    def terminated(self, world: World) -> Any:
        return (self.left < world.radii).all(axis=1)

    def information(self, world: World) -> Any:
        return {"arrived": (self.left < world.radii).mean(axis=1)}

    def _distances(self, world: World) -> Any:
        way = world["goal"] - world.positions
        return np.hypot(way[..., 0], way[..., 1])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=10)
    parser.add_argument("--environments", type=int, default=4096)
    parser.add_argument("--steps", type=int, default=200)
    arguments = parser.parse_args()
    made: dict[str, Task] = {
        "neither": tasks.Navigation(arguments.robots, reward="0.0", terminated=None, information={}),
        "NumPy": ByNumPy(arguments.robots),
        "expressions": tasks.Navigation(arguments.robots),
    }
    made["neither"].reward = lambda world: np.zeros((world.environments, world.robots))
    envs = {name: VectorEnv(task, arguments.environments) for name, task in made.items()}
    random = np.random.default_rng(1)
    shape = (8, arguments.environments, arguments.robots, 3)
    actions = random.uniform(-1, 1, shape).astype(np.float32)
    took: dict[str, list[float]] = {name: [] for name in envs}
    rewards = {}
    for env in envs.values():
        env.reset(seed=1)
    for step in range(arguments.steps):
        # In turn, so that other work on the machine meets all of them.
        for name, env in envs.items():
            begun = time.process_time()
            rewards[name] = env.step(actions[step % 8])[1]
            took[name].append((time.process_time() - begun) / (arguments.environments * arguments.robots))
    np.testing.assert_allclose(rewards["NumPy"], rewards["expressions"], atol=1e-12)
    median = {name: 1e9 * float(np.median(times)) for name, times in took.items()}
    for name, nanoseconds in median.items():
        cost = f", {nanoseconds - median['neither']:.0f} ns for rewards" if name != "neither" else ""
        print(f"{name}: {nanoseconds:.0f} ns of CPU time per robot-step{cost}")
    print(f"speed with expressions / speed with NumPy: {median['NumPy'] / median['expressions']:.2f}")


if __name__ == "__main__":
    main()
