"""PettingZoo's interface for robots that act at the same time."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray
from pettingzoo import ParallelEnv as PettingZooParallelEnv  # type: ignore[import-untyped]

from starl.env._episodes import Episodes, Observations
from starl.env._task import Task


class ParallelEnv(PettingZooParallelEnv):  # type: ignore[misc]
    """One environment, whose robots are the agents `robot_0`, `robot_1`, ... All of them take part until it ends."""

    def __init__(self, task: Task) -> None:
        self._episodes = Episodes(task, 1)
        self.task = task
        self.world = self._episodes.world
        self.metadata = {"name": f"starl_{type(task).__name__.lower()}", "render_modes": [], "is_parallelizable": True}
        self.render_mode = None
        self.possible_agents = [f"robot_{robot}" for robot in range(self.world.robots)]
        self.agents: list[str] = []
        space, actions = self._episodes.observation_space, self._episodes.action_space
        self.observation_spaces = {
            agent: spaces.Box(space.low, space.high, dtype=np.float32) for agent in self.possible_agents
        }
        self.action_spaces = {
            agent: spaces.Box(actions.low, actions.high, dtype=np.float32) for agent in self.possible_agents
        }

    def observation_space(self, agent: str) -> spaces.Box:
        """The same object each time."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> spaces.Box:
        """The same object each time."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Observations], dict[str, dict[str, Any]]]:
        """Begins a new episode. Without a seed the random stream goes on."""
        envs = np.zeros(1, np.int64)
        self._episodes.seed(envs, [seed])
        self._episodes.reset(envs)
        self.agents = list(self.possible_agents)
        return self._observed(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, NDArray[Any]]
    ) -> tuple[dict[str, Observations], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]]:
        """Carries out an action of every robot. All actions must be there."""
        if not self.agents:
            raise ValueError("the episode is over; call reset")
        missing = [agent for agent in self.agents if agent not in actions]
        if missing:
            raise ValueError(f"there is no action for {', '.join(missing)}")
        for agent in self.agents:
            if np.shape(actions[agent]) != self.action_spaces[agent].shape:
                shape = np.shape(actions[agent])
                raise ValueError(f"the action of {agent} has the shape {shape}; use {self.action_spaces[agent].shape}")
        rows = np.stack([np.asarray(actions[agent]) for agent in self.agents])
        rewards, terminated, truncated = self._episodes.step(rows[None])
        agents, facts = self.agents, self._episodes.information()
        information = {name: values[0] for name, values in facts.items()}
        if terminated[0] or truncated[0]:
            self.agents = []
        return (
            self._observed(),
            {agent: float(reward) for agent, reward in zip(agents, rewards[0], strict=True)},
            {agent: bool(terminated[0]) for agent in agents},
            {agent: bool(truncated[0]) for agent in agents},
            {agent: dict(information) for agent in agents},
        )

    def state(self) -> Observations:
        """Returns what all robots see, in one array (N, k)."""
        rows: Observations = self._episodes.observe()[0]
        return rows

    def _observed(self) -> dict[str, Observations]:
        rows = self._episodes.observe()[0]
        return {agent: row.copy() for agent, row in zip(self.possible_agents, rows, strict=True)}
