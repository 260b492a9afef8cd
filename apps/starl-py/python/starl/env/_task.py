"""The interface of tasks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl.env._settings import Settings
from starl.env._world import Floats, Ints, World


class Task:
    """Where robots start, what they see, and what they are rewarded for, for all environments of a batch at once.

    Set `settings` and `max_steps`, and write `reset`, `observe` and `reward`. Random numbers come from `world.uniform` and
    `world.scatter`, never from elsewhere: so an environment goes the same way whatever is beside it.
    """

    #: Robots and the world around them.
    settings: Settings
    #: An episode is truncated after so many actions.
    max_steps: int = 200

    def begin(self, world: World) -> None:
        """Makes the arrays of the task's own. Called once, before anything else."""

    def reset(self, world: World, envs: Ints) -> None:
        """Begins an episode in these environments: draws places, calls `world.place`, and resets the task's arrays."""
        raise NotImplementedError

    def observe(self, world: World) -> Sequence[NDArray[Any]]:
        """Returns what each robot sees: arrays (E, N, k), which are joined. Must not change anything."""
        raise NotImplementedError

    def reward(self, world: World) -> Floats:
        """Returns the reward of each robot for the last action: (E, N). Called once after each action."""
        raise NotImplementedError

    def terminated(self, world: World) -> NDArray[np.bool_]:
        """Returns whether the task is done or lost in each environment: (E,). Called after `reward`."""
        return np.zeros(world.environments, np.bool_)

    def information(self, world: World) -> dict[str, NDArray[Any]]:
        """Returns measures for `infos`, such as the part of robots at their goals: arrays (E, ...)."""
        return {}
