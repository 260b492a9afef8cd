"""Where robots start, and the points that a task names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from starl._errors import StarlError
from starl.env._world import Floats, Ints, World


@dataclass(frozen=True)
class Scatter:
    """Free places in a square around the origin, drawn at random. Those of one size are apart from each other."""

    #: The square reaches from -half to half, metres; that of the task unless given.
    half: float | None = None
    #: Instead of `half`: the side of the square over the square root of the number of robots, metres.
    room: float | None = None
    #: The least distance between places, metres; 2.5 radii of the largest robot unless given.
    gap: float | None = None
    #: The least distance from obstacles, metres; a radius of the largest robot unless given.
    clearance: float | None = None
    #: Where robots that start here look, radians.
    heading: float | Literal["random"] = 0.0
    #: One place for all robots of an environment.
    shared: bool = False

    def _region(self, half: float, robots: int) -> tuple[float, float | None, float | None]:
        if self.room is not None:
            half = 0.5 * self.room * float(np.sqrt(robots))
        return half if self.half is None else self.half, self.gap, self.clearance


@dataclass(frozen=True)
class Ring:
    """Evenly on a circle around the origin, which is turned at random. Robots that start here look at its middle."""

    #: The radius, metres; `half` of the task unless given.
    radius: float | None = None


@dataclass(frozen=True)
class Opposite:
    """The place opposite to the robot's start, on the other side of the origin."""


Places = Scatter | Ring | Opposite


def draw(
    world: World, envs: Ints, half: float, starts: Places, points: Mapping[str, Places]
) -> tuple[Floats, ArrayLike, dict[str, Floats]]:
    """Starts with their headings, and the points: arrays (len(envs), N, 2)."""
    if isinstance(starts, Opposite):
        raise StarlError("starts: `Opposite` is opposite to a start; use `Scatter` or `Ring`")
    drawn: dict[str, Floats] = {}
    headings: ArrayLike = 0.0
    wanted: dict[str, Places] = {"": starts, **points}
    scattered = {name: place for name, place in wanted.items() if isinstance(place, Scatter)}
    regions = {name: place._region(half, world.robots) for name, place in scattered.items()}
    for region in dict.fromkeys(regions.values()):
        names = [name for name in scattered if regions[name] == region]
        counts = [1 if scattered[name].shared else world.robots for name in names]
        side, gap, clearance = region
        places = world.scatter(envs, sum(counts), (-side, -side), (side, side), gap=gap, clearance=clearance)
        for name, part in zip(names, np.split(places[..., :2], np.cumsum(counts)[:-1], axis=1), strict=True):
            drawn[name] = part
    for name, place in wanted.items():
        if isinstance(place, Ring):
            angles = np.linspace(0.0, 2 * np.pi, world.robots, endpoint=False)
            angles = angles + world.uniform(envs, 1, high=2 * np.pi)
            circle = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
            drawn[name] = (half if place.radius is None else place.radius) * circle
            headings = angles + np.pi if name == "" else headings
        elif isinstance(place, Opposite):
            drawn[name] = -drawn[""]
    if isinstance(starts, Scatter):
        random = starts.heading == "random"
        headings = world.uniform(envs, world.robots, low=-np.pi, high=np.pi) if random else starts.heading
    return drawn.pop(""), headings, drawn
