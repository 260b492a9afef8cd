"""Quantities of robots by name, as parts of observations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl._errors import StarlError
from starl.env._world import COMPUTED, World, quantity

Numbers = NDArray[Any]


@dataclass(frozen=True)
class Part:
    """A part of observations: `k` numbers of each robot, which `write` puts into an array (E, N, k)."""

    width: int
    write: Callable[[Numbers], object]


def parts(world: World, names: Sequence[str]) -> list[Part]:
    """The quantities with these names."""
    if isinstance(names, str):
        raise StarlError(f'observe: give a list of names, as ["{names}"]')
    return [_part(world, name) for name in names]


def _part(world: World, name: str) -> Part:
    environments, robots = world.environments, world.robots
    match name.split():
        case ["to", "every", point]:
            every = _point(world, name, point)
            shape = (environments, robots, robots, 2)
            ways = np.empty(shape)
            return Part(
                2 * robots,
                lambda out: _copy(
                    out, np.subtract(every[:, None], world.positions[:, :, None], out=ways).reshape(*shape[:2], -1)
                ),
            )
        case ["to", point]:
            return _way(world.positions, _point(world, name, point))
        case [start, "to", end]:
            return _way(_point(world, name, start), _point(world, name, end))
        case ["every", own] if own not in COMPUTED:
            each = quantity(world, own)
            width = each.shape[2] * robots
            return Part(width, lambda out: _copy(out, each.reshape(environments, 1, width)))
        case ["heading"]:
            return Part(2, lambda out: _direction(world, out))
        case ["touched"]:
            return Part(1, lambda out: np.greater_equal(world.contacts[..., None], 0, out=out, casting="unsafe"))
        case ["heard"]:
            return Part(world.messages.shape[3], lambda out: _copy(out, _heard(world)))
        case [own]:
            values = quantity(world, own)
            return Part(values.shape[2], lambda out: _copy(out, values))
    raise StarlError(
        f'observe: `{name}` is not a name of a quantity, "to POINT", "POINT to POINT", "every NAME" or "to every POINT"'
    )


def _copy(out: Numbers, values: Numbers) -> None:
    np.copyto(out, values, casting="unsafe")


def _way(start: Numbers, end: Numbers) -> Part:
    return Part(2, lambda out: np.subtract(end, start, out=out, casting="unsafe"))


def _direction(world: World, out: Numbers) -> None:
    np.cos(world.headings, out=out[..., 0], casting="unsafe")
    np.sin(world.headings, out=out[..., 1], casting="unsafe")


def _point(world: World, name: str, point: str) -> Numbers:
    found = quantity(world, point)
    if found.shape[2] != 2:
        raise StarlError(f"observe: `{name}`: `{point}` is no point in the plane")
    return found


def _heard(world: World) -> Numbers:
    """The mean of the newest messages of the others."""
    is_heard = (world.ages >= 0)[..., None]
    mean: Numbers = (world.messages * is_heard).sum(axis=2) / np.maximum(is_heard.sum(axis=2), 1)
    return mean
