"""Quantities of robots by name, as parts of observations."""

from __future__ import annotations

import difflib
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl._errors import StarlError
from starl.env._world import World

Part = Callable[[], NDArray[Any]]


def parts(world: World, names: Sequence[str]) -> list[Part]:
    """Functions that give the current values of quantities, each (E, N, k)."""
    if isinstance(names, str):
        raise StarlError(f'observe: give a list of names, as ["{names}"]')
    return [_part(world, name) for name in names]


def _part(world: World, name: str) -> Part:
    environments, robots = world.environments, world.robots
    match name.split():
        case ["to", "every", point]:
            target = _point(world, name, point)
            return lambda: (target()[:, None] - world.positions[:, :, None]).reshape(environments, robots, -1)
        case ["to", point]:
            target = _point(world, name, point)
            return lambda: target() - world.positions
        case [start, "to", end]:
            here, there = _point(world, name, start), _point(world, name, end)
            return lambda: there() - here()
        case ["every", own]:
            each = _quantity(world, own)
            flat = (environments, 1, -1)
            return lambda: np.broadcast_to((all := each().reshape(flat)), (environments, robots, all.shape[2]))
        case [own]:
            return _quantity(world, own)
    raise StarlError(f'observe: `{name}` is no name of a quantity, "to POINT", "POINT to POINT", "every NAME" or "to every POINT"')


def _point(world: World, name: str, point: str) -> Part:
    quantity = _quantity(world, point)
    if quantity().shape[2] != 2:
        raise StarlError(f"observe: `{name}`: `{point}` is no point in the plane")
    return quantity


def _quantity(world: World, name: str) -> Part:
    given: dict[str, Part] = {
        "position": lambda: world.positions,
        "altitude": lambda: world.poses[..., 2:3],
        "heading": lambda: np.stack([np.cos(world.headings), np.sin(world.headings)], axis=-1),
        "velocity": lambda: world.velocities[..., :2],
        "turn_rate": lambda: world.velocities[..., 3:4],
        "touched": lambda: world.contacts[..., None] >= 0,
        "lidar": lambda: world.lidar,
        "heard": lambda: _heard(world),
    }
    own = world.quantities
    if name in own:
        values = own[name]
        return lambda: values
    if name not in given:
        names = [*given, *own]
        close = difflib.get_close_matches(name, names, 1)
        hint = f"; did you mean `{close[0]}`?" if close else f"; use one of {', '.join(names)}"
        raise StarlError(f"observe: there is no quantity `{name}`{hint}")
    return given[name]


def _heard(world: World) -> NDArray[Any]:
    """The mean of the newest messages of the others."""
    is_heard = (world.ages >= 0)[..., None]
    mean: NDArray[Any] = (world.messages * is_heard).sum(axis=2) / np.maximum(is_heard.sum(axis=2), 1)
    return mean
