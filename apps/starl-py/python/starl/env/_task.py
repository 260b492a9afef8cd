"""The interface of tasks."""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Callable, Mapping, Sequence
from types import EllipsisType
from typing import Any

from numpy.typing import NDArray

from starl.env._places import Places, Scatter, draw
from starl.env._settings import Settings
from starl.env._world import Floats, Ints, World


class Task:
    """Where robots start, what they see, and what they are rewarded for.

    A subclass sets these parts. `reward`, `terminated`, `measures` and `information` are expressions of the StarL language
    about one robot. Each part except `measures` may be a method instead, which handles all environments of a batch at once.
    Random numbers come from `world.uniform` and `world.scatter`, never from elsewhere: so an environment goes the same way
    whatever is beside it.

    The keywords of the constructor change parts of the task, `values`, and fields of its settings.
    """

    #: Robots and the world around them.
    settings: Settings
    #: An episode is truncated after so many actions.
    max_steps: int = 200
    #: Places are scattered from -half to half, metres.
    half: float = 1.0
    #: Where robots start.
    starts: Places = Scatter()
    #: Points that expressions and observations may name: one for each robot, or shared by all robots of an environment.
    points: Mapping[str, Places] = {}
    #: Numbers that expressions and observations may name, one for all robots or one each.
    values: Mapping[str, float | Sequence[float | EllipsisType]] = {}
    #: Quantities that are computed after each action, by name: a Float, or `"name: Bool"` and `"name: Point"`.
    measures: Mapping[str, str] = {}
    #: Names of quantities; or a method that returns arrays (E, N, k), which are joined, and changes nothing.
    observe: Sequence[str] | Callable[..., Sequence[NDArray[Any]]]
    #: A Float; or a method that returns the reward of each robot for the last action: (E, N).
    reward: str | Callable[..., Floats]
    #: A Bool, and the episode ends when it is true of all robots; or a method that returns (E,), called after `reward`.
    terminated: str | Callable[..., NDArray[Any]] | None = None
    #: Bools or Floats by name, averaged over robots; or a method that returns arrays (E, ...) for `infos`. None: the measures.
    information: Mapping[str, str] | Callable[..., dict[str, NDArray[Any]]] | None = None

    def __init__(self, robots: int | None = None, **changes: Any) -> None:
        values, settings = dict(self.values), {} if robots is None else {"robots": robots}
        fields = {field.name for field in dataclasses.fields(Settings)}
        for name, value in changes.items():
            if name in values:
                values[name] = value
            elif name in _PARTS:
                setattr(self, name, value)
            elif name in fields:
                settings[name] = value
            else:
                close = difflib.get_close_matches(name, [*values, *_PARTS, *fields], 1)
                hint = f"; did you mean `{close[0]}`?" if close else ""
                raise TypeError(f"{type(self).__name__} has no setting `{name}`{hint}")
        self.values = values if "values" not in changes else self.values
        self.settings = dataclasses.replace(getattr(self, "settings", Settings(1)), **settings)

    def begin(self, world: World) -> None:
        """Makes the arrays of the task's own. Called once, before anything else."""

    def reset(self, world: World, envs: Ints) -> None:
        """Begins an episode in these environments: draws places, calls `world.place`, and resets the task's arrays."""
        starts, headings, points = draw(world, envs, self.half, self.starts, self.points)
        world.place(envs, starts, headings)
        for name, places in points.items():
            world[name][envs] = places

    def advance(self, world: World) -> None:
        """Moves what the task moves itself. Called once after each action, before expressions are evaluated."""


_PARTS = [name for name in Task.__annotations__]
