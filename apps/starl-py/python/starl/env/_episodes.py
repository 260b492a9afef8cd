"""The episodes of a task, as all interfaces need them."""

from __future__ import annotations

from collections.abc import Sequence
from operator import index
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from starl._errors import StarlError
from starl.env._judge import Judge
from starl.env._places import Opposite, Ring, Scatter
from starl.env._quantities import parts
from starl.env._task import Task
from starl.env._world import Floats, Ints, World

Observations = NDArray[np.float32]
Flags = NDArray[np.bool_]


class Episodes:
    """A task in a batch of environments."""

    def __init__(self, task: Task, environments: int, threads: int = 1) -> None:
        _check(task)
        self.task = task
        self.world = World(task.settings, environments, threads)
        self._is_seeded = np.zeros(environments, np.bool_)
        self._is_reset = np.zeros(environments, np.bool_)
        self._judge = Judge(task, self.world)
        task.begin(self.world)
        if callable(task.observe):
            self._parts = []
            width = sum(part.shape[-1] for part in task.observe(self.world))
        else:
            self._parts = parts(self.world, task.observe)
            width = sum(part.width for part in self._parts)
        self._shape = (environments, self.world.robots, width)
        #: Observations and actions of one robot.
        self.observation_space = spaces.Box(-np.inf, np.inf, (width,), np.float32)
        self.action_space = spaces.Box(-1.0, 1.0, (self.world.action_numbers,), np.float32)

    def team(self, space: spaces.Box) -> spaces.Box:
        """The space of all robots: shape (N, ...)."""
        robots = self.world.robots
        low, high = (np.broadcast_to(bound, (robots, *space.shape)) for bound in (space.low, space.high))
        return spaces.Box(low, high, dtype=np.float32)

    def seed(self, envs: Ints, seeds: Sequence[int | None]) -> None:
        """Seeds environments. Those with None go on in their streams; if they have none yet, they get a random one."""
        for env, seed in zip(envs, seeds, strict=True):
            if seed is None and not self._is_seeded[env]:
                seed = int(np.random.SeedSequence().generate_state(1, np.uint64)[0])
            if seed is not None:
                seed = index(seed)
                if not 0 <= seed < 2**64:
                    raise ValueError(f"the seed {seed} is not in 0 to 2**64 - 1")
                self.world.seed(np.array([env]), np.array([seed], np.uint64))
                self._is_seeded[env] = True

    def reset(self, envs: Ints) -> None:
        """Begins an episode in these environments."""
        if len(envs):
            self.task.reset(self.world, envs)
            self._judge.begin(envs)
            self._is_reset[envs] = True

    def observe(self) -> Observations:
        """Returns what robots see, in a new array."""
        seen: Observations = np.empty(self._shape, np.float32)
        observe = self.task.observe
        if callable(observe):
            np.concatenate(observe(self.world), axis=-1, out=seen, casting="unsafe")
            return seen
        place = 0
        for part in self._parts:
            part.write(seen[..., place : place + part.width])
            place += part.width
        return seen

    def step(self, actions: NDArray[Any]) -> tuple[Floats, Flags, Flags]:
        """Rewards (E, N), and which environments are terminated and truncated."""
        if not self._is_reset.all():
            raise ValueError(f"environment {int(self._is_reset.argmin())} has not begun; call reset")
        task, world = self.task, self.world
        world.step(actions)
        task.advance(world)
        rewards = self._judge.judge()
        if callable(task.reward):
            rewards = task.reward(world)
        terminated = task.terminated(world) if callable(task.terminated) else self._judge.terminated.copy()
        return rewards, terminated, world.steps >= task.max_steps

    def information(self) -> dict[str, NDArray[Any]]:
        """The task's measures for `infos`: arrays (E, ...), which are overwritten next time."""
        information = self.task.information
        return information(self.world) if callable(information) else self._judge.information


def _check(task: Any) -> None:
    """Refuses parts of the wrong type, which would count as missing."""
    if not isinstance(task, Task):
        raise StarlError(f"{task!r} is not a task; give an object of a subclass of `Task`")
    for part in ("observe", "reward"):
        if not hasattr(task, part):
            raise StarlError(f"{type(task).__name__}.{part} is missing: set it, or write a method")
    texts = {"reward": task.reward, **{f"measures[{name!r}]": text for name, text in task.measures.items()}}
    if task.terminated is not None:
        texts["terminated"] = task.terminated
    if task.information is not None and not callable(task.information):
        texts |= {f"information[{name!r}]": text for name, text in task.information.items()}
    for part, text in texts.items():
        if not isinstance(text, str) and (not callable(text) or part.startswith("measures")):
            raise StarlError(f"{part}: {text!r} is not an expression; write it as a text")
    for part, place in {"starts": task.starts, **{f"points[{name!r}]": place for name, place in task.points.items()}}.items():
        if not isinstance(place, (Scatter, Ring, Opposite)):
            raise StarlError(f"{part}: {place!r} is not a place; use `Scatter`, `Ring` or `Opposite`")
    for part in ("half", "max_steps"):
        number = getattr(task, part)
        if not isinstance(number, (int, float, np.number)) or not 0 < number < np.inf:
            raise StarlError(f"{part}: {number!r} is not a number greater than 0")
