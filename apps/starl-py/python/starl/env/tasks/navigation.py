"""Navigation with lidar: each robot has a goal of its own, and does not know where the others are or go."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl.env._settings import Lidar, Settings
from starl.env._task import Task
from starl.env._world import Floats, Ints, World


class Navigation(Task):
    """Reward: metres by which a robot came nearer to its goal, less 1 for touching something. Done when all are there."""

    def __init__(self, robots: int = 10, *, half: float = 1.0, **more: Any) -> None:
        self.half = half
        self.settings = Settings(robots, **{"parameters": {"radius": 0.1}, "lidar": Lidar(12, 0.35), **more})

    def begin(self, world: World) -> None:
        self.goals: Floats = np.zeros((world.environments, world.robots, 2))
        self.left: Floats = np.zeros((world.environments, world.robots))

    def reset(self, world: World, envs: Ints) -> None:
        places = world.scatter(envs, 2 * world.robots, (-self.half, -self.half), (self.half, self.half))
        world.place(envs, places[:, : world.robots], world.uniform(envs, world.robots, low=-np.pi, high=np.pi))
        self.goals[envs] = places[:, world.robots :, :2]
        self.left[envs] = self._distances(world)[envs]

    def observe(self, world: World) -> Sequence[NDArray[Any]]:
        heading = np.stack([np.cos(world.headings), np.sin(world.headings)], axis=-1)
        return [world.positions, heading, world.velocities[..., :2], self.goals - world.positions, world.lidar]

    def reward(self, world: World) -> Floats:
        before, self.left = self.left, self._distances(world)
        return before - self.left - (world.contacts >= 0)

    def terminated(self, world: World) -> NDArray[np.bool_]:
        arrived: NDArray[np.bool_] = (self.left < world.radii).all(axis=1)
        return arrived

    def information(self, world: World) -> dict[str, NDArray[Any]]:
        return {"arrived": (self.left < world.radii).mean(axis=1)}

    def _distances(self, world: World) -> Floats:
        way = self.goals - world.positions
        return np.hypot(way[..., 0], way[..., 1])
