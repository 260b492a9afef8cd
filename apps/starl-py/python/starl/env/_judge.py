"""The expressions of a task."""

from __future__ import annotations

import json
from collections.abc import Sequence
from types import EllipsisType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from starl import _native
from starl._errors import Diagnostic, StarlError
from starl.env._settings import each
from starl.env._task import Task
from starl.env._world import Floats, Ints, World


class Judge:
    """Evaluates the expressions of a task for all environments."""

    def __init__(self, task: Task, world: World) -> None:
        self._world = world
        for part in (task.values, task.points, {_typed(name)[0]: text for name, text in task.measures.items()}):
            for name in part:
                if not (name.isidentifier() and name.isascii()):
                    raise StarlError(f"`{name}` is not a name for a quantity; use letters, digits and _")
        constants = [(name, *_constant(name, value, world.robots)) for name, value in task.values.items()]
        points: list[tuple[str, str, str | None]] = [(name, "Point", None) for name in task.points]
        columns = points + [(*_typed(name), text) for name, text in task.measures.items()]
        world._declare(
            {name: 2 if kind == "Point" else 1 for name, kind, _ in columns},
            {name: values for name, _, values in constants},
        )
        if task.information is None:
            information = {name: name for name, kind in map(_typed, task.measures) if kind != "Point"}
        else:
            information = {} if callable(task.information) else dict(task.information)
        reward, terminated = (part if isinstance(part, str) else None for part in (task.reward, task.terminated))
        try:
            self._native = _native.Judge(
                world._batch, constants, columns, reward, terminated, list(information.items())
            )
        except ValueError as error:
            raise _refusal(error) from None
        self.has_work = bool(reward or terminated or information or task.measures)
        environments = world.environments
        #: Whether environments are terminated.
        self.terminated: NDArray[np.bool_] = np.zeros(environments, np.bool_)
        self._means: Floats = np.zeros((environments, len(information)))
        #: The measures of the information: (E,) each.
        self.information = {name: self._means[:, place] for place, name in enumerate(information)}

    def begin(self, envs: Ints) -> None:
        """Looks at environments that begin an episode."""
        begins = np.zeros(self._world.environments, np.bool_)
        begins[envs] = True
        self._evaluate(begins)

    def judge(self) -> Floats:
        """Looks at all environments after an action. Returns the rewards (E, N), zeros without an expression for them."""
        return self._evaluate(None)

    def _evaluate(self, begins: NDArray[np.bool_] | None) -> Floats:
        world = self._world
        rewards: Floats = np.zeros((world.environments, world.robots))
        if self.has_work:
            world._batch.judge(
                self._native, begins, world._rows, world.lidar, rewards, self.terminated, self._means
            )
        return rewards


def _constant(
    name: str, value: float | Sequence[float | EllipsisType], robots: int
) -> tuple[str, list[float]]:
    given = [value.item(), ...] if isinstance(value, np.generic) else value
    items = each(f"values: {name}", [given, ...] if isinstance(given, (bool, int, float)) else list(given), robots)
    if not all(isinstance(item, (bool, int, float, np.bool_, np.number)) for item in items):
        raise StarlError(f"values: {name}: {value!r} is not a number or a Boolean, or a list of them")
    return "Bool" if all(isinstance(item, (bool, np.bool_)) for item in items) else "Float", [float(item) for item in items]


def _typed(name: str) -> tuple[str, str]:
    """A measure's name and its type."""
    word, _, kind = name.partition(":")
    return word.strip(), kind.strip() or "Float"


def _refusal(error: ValueError) -> StarlError:
    if len(error.args) != 2:
        return StarlError(str(error))
    text, found = error.args
    problems: list[dict[str, Any]] = json.loads(found)
    return StarlError(text.rstrip(), [Diagnostic._of(problem) for problem in problems])
