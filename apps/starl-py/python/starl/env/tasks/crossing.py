"""Crossing: robots stand in a ring, and all want to the other side at once."""

import numpy as np

from starl.env._world import Ints, World
from starl.env.tasks.navigation import Navigation


class Crossing(Navigation):
    """As `Navigation`, from evenly on a circle of radius `half` to the opposite places; the ring is turned at random."""

    def reset(self, world: World, envs: Ints) -> None:
        angles = np.linspace(0.0, 2 * np.pi, world.robots, endpoint=False)
        angles = angles + world.uniform(envs, 1, high=2 * np.pi)
        places = self.half * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        world.place(envs, places, angles + np.pi)
        self.goals[envs] = -places
        self.left[envs] = self._distances(world)[envs]
