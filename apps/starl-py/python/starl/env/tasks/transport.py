"""Transport: a thing too heavy for one robot is to be brought to a place."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl.env._settings import Settings
from starl.env._task import Task
from starl.env._world import Floats, Ints, World


class Transport(Task):
    """Robots near the thing hold it; while at least `carriers` do, it moves with their mean velocity. It is no body: robots
    pass under it. Reward: metres by which the thing came nearer to its goal, and a tenth of those by which a robot came
    nearer to the thing. Done when it is there."""

    def __init__(
        self, robots: int = 4, *, carriers: int = 2, half: float = 1.5, reach: float = 0.3, **more: Any
    ) -> None:
        self.half, self.reach, self.carriers = half, reach, carriers
        self.settings = Settings(robots, **{"parameters": {"radius": 0.1}, **more})

    def begin(self, world: World) -> None:
        self.thing: Floats = np.zeros((world.environments, 2))
        self.goal: Floats = np.zeros((world.environments, 2))
        self.left: Floats = np.zeros(world.environments)
        self.way: Floats = np.zeros((world.environments, world.robots))

    def reset(self, world: World, envs: Ints) -> None:
        places = world.scatter(envs, world.robots + 2, (-self.half, -self.half), (self.half, self.half))
        world.place(envs, places[:, 2:])
        self.thing[envs], self.goal[envs] = places[:, 0, :2], places[:, 1, :2]
        self._measure(world, envs)

    def _measure(self, world: World, envs: Ints | slice) -> None:
        self.left[envs] = np.linalg.norm(self.goal - self.thing, axis=-1)[envs]
        self.way[envs] = np.linalg.norm(self.thing[:, None] - world.positions, axis=-1)[envs]

    def observe(self, world: World) -> Sequence[NDArray[Any]]:
        goal = np.broadcast_to((self.goal - self.thing)[:, None], world.positions.shape)
        holds = (self.way < self.reach)[..., None]
        return [world.positions, world.velocities[..., :2], self.thing[:, None] - world.positions, goal, holds]

    def reward(self, world: World) -> Floats:
        left, way = self.left.copy(), self.way.copy()
        holds = self.way < self.reach
        count = holds.sum(axis=1, keepdims=True)
        velocity = (world.velocities[..., :2] * holds[..., None]).sum(axis=1) / np.maximum(count, 1)
        seconds = self.settings.physics_step * self.settings.steps_per_action
        self.thing += np.where(count >= self.carriers, velocity * seconds, 0.0)
        self._measure(world, slice(None))
        return (left - self.left)[:, None] + 0.1 * (way - self.way)

    def terminated(self, world: World) -> NDArray[np.bool_]:
        return self.left < 0.1

    def information(self, world: World) -> dict[str, NDArray[Any]]:
        return {"left": self.left}
