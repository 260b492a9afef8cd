"""Flocking: robots learn to move the same way, near each other, without touching."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl.env._settings import Lidar, Radio, Settings
from starl.env._task import Task
from starl.env._world import Floats, Ints, World
from starl.env.tasks._geometry import distances


class Flocking(Task):
    """Reward: the speed of the flock as a part of the greatest, less the distance to the nearest other beyond `spacing`,
    less 1 for touching something. Robots hear two numbers from each neighbour in range."""

    def __init__(self, robots: int = 6, *, half: float = 1.5, spacing: float = 0.5, **more: Any) -> None:
        self.half, self.spacing = half, spacing
        own = {"parameters": {"radius": 0.1}, "lidar": Lidar(12, 1.0), "radio": Radio(2, range=2.0)}
        self.settings = Settings(robots, **{**own, **more})

    def reset(self, world: World, envs: Ints) -> None:
        world.place(envs, world.scatter(envs, world.robots, (-self.half, -self.half), (self.half, self.half)))

    def observe(self, world: World) -> Sequence[NDArray[Any]]:
        heard = (world.ages >= 0)[..., None]
        mean = (world.messages * heard).sum(axis=2) / np.maximum(heard.sum(axis=2), 1)
        return [world.velocities[..., :2], mean, world.lidar]

    def reward(self, world: World) -> Floats:
        flock = np.linalg.norm(world.velocities[..., :2].mean(axis=1), axis=-1) / world.speeds.min()
        nearest = distances(world).min(axis=2)
        rewards: Floats = flock[:, None] - np.maximum(nearest - self.spacing, 0.0) - (world.contacts >= 0)
        return rewards

    def information(self, world: World) -> dict[str, NDArray[Any]]:
        return {"flock_speed": np.linalg.norm(world.velocities[..., :2].mean(axis=1), axis=-1)}
