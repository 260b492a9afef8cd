"""Gymnasium's interface for many environments at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from gymnasium.vector import VectorEnv as GymnasiumVectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from starl.env._episodes import Episodes, Flags, Observations
from starl.env._task import Task
from starl.env._world import Floats


class VectorEnv(GymnasiumVectorEnv[Observations, NDArray[Any], NDArray[Any]]):
    """E environments of N robots: observations (E, N, k), actions (E, N, m), rewards (E,).

    The reward of an environment is the mean of its robots'; `infos["robot_rewards"]` has each: (E, N). An environment's
    seed is `seed + e`, and its random stream is its own, so that the number of environments changes nothing.
    """

    def __init__(
        self,
        task: Task,
        num_envs: int,
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        threads: int = 1,
    ) -> None:
        self._episodes = Episodes(task, num_envs, threads)
        self.task = task
        self.world = self._episodes.world
        self.num_envs = num_envs
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": self.autoreset_mode}
        self.single_observation_space = self._episodes.team(self._episodes.observation_space)
        self.single_action_space = self._episodes.team(self._episodes.action_space)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._is_over: Flags = np.zeros(num_envs, np.bool_)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observations, dict[str, Any]]:
        """Begins new episodes in all environments, or in those of `options["reset_mask"]`."""
        if isinstance(seed, np.integer):
            seed = int(seed)
        super().reset(seed=seed if isinstance(seed, int) else None)
        envs = np.arange(self.num_envs)
        if isinstance(seed, int):
            seeds: Sequence[int | None] = [seed + env for env in range(self.num_envs)]
        else:
            seeds = [None] * self.num_envs if seed is None else list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} environments; give one, or one each")
        mask = (options or {}).get("reset_mask")
        if mask is not None:
            envs = np.flatnonzero(_checked_mask(mask, self.num_envs))
        self._episodes.seed(envs, [seeds[int(env)] for env in envs])
        self._is_over[envs] = False
        self._episodes.reset(envs)
        return self._episodes.observe(), self._information()

    def step(
        self, actions: NDArray[Any]
    ) -> tuple[Observations, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Carries out an action of every robot. With the mode NEXT_STEP, the environments that were over ignore it and begin
        a new episode; with SAME_STEP they do so at once, and `infos["final_obs"]` has the last observation."""
        mode, was_over = self.autoreset_mode, self._is_over
        if mode == AutoresetMode.DISABLED and was_over.any():
            first = int(was_over.argmax())
            raise ValueError(f'environment {first} is over; reset it with options={{"reset_mask": mask}}')
        robot_rewards, terminated, truncated = self._episodes.step(np.asarray(actions))
        if mode == AutoresetMode.NEXT_STEP and was_over.any():
            terminated, truncated = terminated & ~was_over, truncated & ~was_over
            robot_rewards = np.where(was_over[:, None], 0.0, robot_rewards)
            self._episodes.reset(np.flatnonzero(was_over))
        over = terminated | truncated
        infos = self._information(robot_rewards)
        if mode == AutoresetMode.SAME_STEP and over.any():
            infos = self._restart(over, infos)
            self._is_over = np.zeros(self.num_envs, np.bool_)
        else:
            self._is_over = over
        return self._episodes.observe(), robot_rewards.mean(axis=1), terminated, truncated, infos

    def _restart(self, over: Flags, infos: dict[str, Any]) -> dict[str, Any]:
        """Begins new episodes where they are over, and moves what is known of their ends to "final_..."."""
        last = self._episodes.observe()
        final_obs = np.full(self.num_envs, None, dtype=object)
        for env in np.flatnonzero(over):
            final_obs[env] = last[env].copy()
        ends = {**infos, **{name: over.copy() for name in infos if name.startswith("_")}}
        self._episodes.reset(np.flatnonzero(over))
        fresh = self._information(infos["robot_rewards"])
        return {
            **fresh,
            "final_obs": final_obs,
            "_final_obs": over.copy(),
            "final_info": ends,
            "_final_info": over.copy(),
        }

    def _information(self, robot_rewards: Floats | None = None) -> dict[str, Any]:
        infos: dict[str, Any] = {name: values.copy() for name, values in self._episodes.information().items()}
        if robot_rewards is not None:
            infos["robot_rewards"] = robot_rewards
        return {**infos, **{f"_{name}": np.ones(self.num_envs, np.bool_) for name in infos}}


def _checked_mask(mask: Any, environments: int) -> Flags:
    """As Gymnasium's own environments check it."""
    if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (environments,):
        raise TypeError(f'options["reset_mask"] must be a NumPy array of {environments} booleans, not {mask!r}')
    if not mask.any():
        raise ValueError('options["reset_mask"] names no environment')
    return mask
