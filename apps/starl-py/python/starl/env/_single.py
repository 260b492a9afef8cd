"""Gymnasium's interface for one environment with one robot."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from starl.env._episodes import Episodes, Observations
from starl.env._task import Task


class Env(gymnasium.Env[Observations, NDArray[Any]]):
    """One robot: observations (k,), actions (m,). For tasks with several robots use `ParallelEnv` or `VectorEnv`."""

    def __init__(self, task: Task) -> None:
        if isinstance(task, Task) and task.settings.robots != 1:
            raise ValueError(f"the task has {task.settings.robots} robots; use ParallelEnv or VectorEnv")
        self._episodes = Episodes(task, 1)
        self.task = task
        self.world = self._episodes.world
        self.metadata = {"render_modes": []}
        self.observation_space = self._episodes.observation_space
        self.action_space = self._episodes.action_space

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Begins a new episode. Without a seed the random stream goes on."""
        super().reset(seed=seed)
        envs = np.zeros(1, np.int64)
        self._episodes.seed(envs, [seed])
        self._episodes.reset(envs)
        return self._observed(), self._information()

    def step(self, action: NDArray[Any]) -> tuple[Observations, float, bool, bool, dict[str, Any]]:
        """Carries out an action."""
        rewards, terminated, truncated = self._episodes.step(np.asarray(action)[None, None])
        return self._observed(), float(rewards[0, 0]), bool(terminated[0]), bool(truncated[0]), self._information()

    def _observed(self) -> Observations:
        row: Observations = self._episodes.observe()[0, 0]
        return row

    def _information(self) -> dict[str, Any]:
        return {name: values[0] for name, values in self._episodes.information().items()}
