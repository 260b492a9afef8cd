"""Distances between the robots of each environment."""

import numpy as np

from starl.env._world import Floats, World


def ways(world: World) -> Floats:
    """From each robot to each other: (E, N, N, 2)."""
    here: Floats = world.positions
    return here[:, None, :, :] - here[:, :, None, :]


def distances(world: World) -> Floats:
    """Between centres: (E, N, N), infinite from a robot to itself."""
    apart: Floats = np.linalg.norm(ways(world), axis=-1)
    apart[:, np.arange(world.robots), np.arange(world.robots)] = np.inf
    return apart
