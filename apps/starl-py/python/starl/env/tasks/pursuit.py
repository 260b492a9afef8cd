"""Pursuit: several slower robots are to touch a faster one, within walls and between pillars."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl.env._settings import Circle, Settings
from starl.env._task import Task
from starl.env._world import Floats, Ints, World
from starl.env.tasks._geometry import ways


class Pursuit(Task):
    """The last robot is the evader. Reward of the pursuers: 10 when it is caught, less 0.1 for each metre between it and the
    nearest of them; the evader gets the opposite. Done when it is caught."""

    def __init__(self, pursuers: int = 3, *, half: float = 2.0, speed: float = 0.7, **more: Any) -> None:
        self.half = half
        slow = {"radius": 0.1, "speed": speed, "cruise_speed": min(speed, 0.5)}
        own = {
            "parameters": [slow] * pursuers + [{"radius": 0.1}],
            "walls": (-half, -half, half, half),
            "obstacles": [Circle(0.5 * half * x, 0.5 * half * y, 0.2) for x in (-1, 1) for y in (-1, 1)],
        }
        self.settings = Settings(pursuers + 1, **{**own, **more})

    def reset(self, world: World, envs: Ints) -> None:
        inside = self.half - 0.1
        world.place(envs, world.scatter(envs, world.robots, (-inside, -inside), (inside, inside)))

    def observe(self, world: World) -> Sequence[NDArray[Any]]:
        others = ways(world).reshape(world.environments, world.robots, -1)
        return [world.positions, world.velocities[..., :2], others]

    def _caught(self, world: World) -> NDArray[np.bool_]:
        evader = world.robots - 1
        by = world.contacts[:, evader]
        caught: NDArray[np.bool_] = (world.contacts[:, :evader] == evader).any(axis=1) | ((by >= 0) & (by < evader))
        return caught

    def reward(self, world: World) -> Floats:
        nearest = np.linalg.norm(ways(world)[:, -1, :-1], axis=-1).min(axis=1)
        pursuers = 10.0 * self._caught(world) - 0.1 * nearest
        sides = np.append(np.ones(world.robots - 1), -1.0)
        rewards: Floats = pursuers[:, None] * sides
        return rewards

    def terminated(self, world: World) -> NDArray[np.bool_]:
        return self._caught(world)
