"""Dispersion: robots start in the middle and spread over as many targets, each of which one robot is to visit."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl.env._settings import Settings
from starl.env._task import Task
from starl.env._world import Floats, Ints, World


class Dispersion(Task):
    """Reward: 1 for each target that a robot visits first. Done when all are visited."""

    def __init__(self, robots: int = 4, *, half: float = 1.5, **more: Any) -> None:
        self.half = half
        self.settings = Settings(robots, **{"parameters": {"radius": 0.1}, **more})

    def begin(self, world: World) -> None:
        self.targets: Floats = np.zeros((world.environments, world.robots, 2))
        self.visited: NDArray[np.bool_] = np.zeros((world.environments, world.robots), np.bool_)

    def reset(self, world: World, envs: Ints) -> None:
        near = 0.25 * np.sqrt(world.robots)
        world.place(envs, world.scatter(envs, world.robots, (-near, -near), (near, near), gap=0.22))
        targets = world.scatter(envs, world.robots, (-self.half, -self.half), (self.half, self.half))
        self.targets[envs] = targets[..., :2]
        self.visited[envs] = False

    def _ways(self, world: World) -> Floats:
        return self.targets[:, None] - world.positions[:, :, None]

    def observe(self, world: World) -> Sequence[NDArray[Any]]:
        ways = self._ways(world).reshape(world.environments, world.robots, -1)
        visited = np.broadcast_to(self.visited[:, None], (world.environments, world.robots, world.robots))
        return [world.positions, world.velocities[..., :2], ways, visited]

    def reward(self, world: World) -> Floats:
        near: NDArray[np.bool_] = np.linalg.norm(self._ways(world), axis=-1) < world.radii[:, None]
        near &= ~self.visited[:, None]
        self.visited |= near.any(axis=1)
        # Robots that reach a target together share it.
        shares: Floats = (near / np.maximum(near.sum(axis=1, keepdims=True), 1)).sum(axis=2)
        return shares

    def terminated(self, world: World) -> NDArray[np.bool_]:
        done: NDArray[np.bool_] = np.all(self.visited, axis=1)
        return done

    def information(self, world: World) -> dict[str, NDArray[Any]]:
        return {"visited": self.visited.mean(axis=1)}
