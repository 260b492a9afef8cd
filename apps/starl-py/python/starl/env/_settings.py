"""The settings that the environments of a task have in common."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import EllipsisType, NoneType
from typing import Any, Literal, TypeVar

import numpy as np

from starl._errors import StarlError

Item = TypeVar("Item")


@dataclass(frozen=True)
class Circle:
    """A round pillar; metres."""

    x: float
    y: float
    radius: float


@dataclass(frozen=True)
class Box:
    """A pillar with sides along the axes, between two corners; metres."""

    left: float
    bottom: float
    right: float
    top: float


@dataclass(frozen=True)
class Lidar:
    """Rays evenly round the body, the first straight ahead."""

    rays: int = 12
    #: How far they see beyond the body's edge, metres.
    range: float = 0.5


@dataclass(frozen=True)
class Radio:
    """With each action, a robot sends a vector of numbers to all others in range."""

    #: How many numbers a message has. They are the last ones of an action.
    numbers: int
    #: Robots farther apart than this, in metres, do not hear each other.
    range: float = float("inf")
    #: The probability that a receiver does not get a message.
    loss: float = 0.0
    #: The shortest and the longest delay in actions, drawn for each receiver; or one delay for all. Without delay a message
    #: is heard at the end of the action with which it is sent.
    delay: int | tuple[int, int] = 0


@dataclass(frozen=True)
class Waypoints:
    """Actions name a waypoint, which the model's tracker drives to: the way to it from the robot in the world frame."""

    #: The length of an action's 1, metres.
    reach: float = 1.0


@dataclass(frozen=True)
class Settings:
    """Robots and the world around them."""

    #: How many robots an environment has.
    robots: int
    #: The model of all robots, or of each: "holonomic", "create", "differential", "car" or "drone".
    model: str | Sequence[str | EllipsisType] = "holonomic"
    #: Parameters of the model that are not at their defaults, by name: a number for all robots, or one each; with several
    #: models, a mapping for each.
    parameters: (
        Mapping[str, float | Sequence[float | EllipsisType]] | Sequence[Mapping[str, float] | EllipsisType]
    ) = field(default_factory=dict)
    #: Seconds.
    physics_step: float = 0.05
    #: How many physics steps an action lasts.
    steps_per_action: int = 2
    #: Whether bodies stop where they touch others and obstacles.
    collisions: bool = True
    #: Walls around the world: left, bottom, right, top, metres.
    walls: tuple[float, float, float, float] | None = None
    obstacles: Sequence[Circle | Box] = ()
    lidar: Lidar | None = None
    radio: Radio | None = None
    #: "commands": the controls of the model, each from -1 to 1.
    actions: Waypoints | Literal["commands"] = "commands"

    def check(self) -> None:
        """Refuses values of the wrong type; the native module refuses numbers that are out of their range."""
        if not isinstance(self.robots, (int, np.integer)) or self.robots < 1:
            raise StarlError(f"robots: {self.robots!r} is not a number of robots; give a whole number from 1")
        kinds: list[tuple[str, Any, type | tuple[type, ...], str]] = [
            ("lidar", self.lidar, (Lidar, NoneType), "a `Lidar`"),
            ("radio", self.radio, (Radio, NoneType), "a `Radio`"),
            ("model", self.model, (str, Sequence), "the name of a model, or a list of them"),
            ("parameters", self.parameters, (Mapping, Sequence), "a dictionary, or a list of them"),
            *(("obstacles", one, (Circle, Box), "a `Circle` or a `Box`") for one in self.obstacles),
        ]
        if self.actions != "commands":
            kinds.append(("actions", self.actions, Waypoints, '"commands" or `Waypoints`'))
        for name, value, kind, what in kinds:
            if not isinstance(value, kind):
                raise StarlError(f"{name}: {value!r} is not {what}")
        if self.lidar and not 0 < self.lidar.rays < 2**16:
            raise StarlError(f"lidar: {self.lidar.rays} rays; use 1 to 65535")
        if self.walls is not None and np.shape(self.walls) != (4,):
            raise StarlError(f"walls: {self.walls!r} is not left, bottom, right, top")

    def models(self) -> list[tuple[str, list[tuple[str, float]]]]:
        """The model of each robot with its parameters."""
        model: Sequence[str | EllipsisType] = [self.model, ...] if isinstance(self.model, str) else self.model
        names = each("model", model, self.robots)
        parameters = self.parameters
        if isinstance(parameters, Mapping):
            columns = {
                name: each(f"parameters: {name}", value if isinstance(value, Sequence) else [value, ...], self.robots)
                for name, value in parameters.items()
            }
            rows: list[Mapping[str, Any]] = [
                {name: column[robot] for name, column in columns.items()} for robot in range(self.robots)
            ]
        else:
            rows = each("parameters", parameters, self.robots)
        return [
            (name, [(key, _number(key, value)) for key, value in own.items()]) for name, own in zip(names, rows, strict=True)
        ]


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise StarlError(f"parameters: {name}: {value!r} is not a number") from None


def each(what: str, items: Sequence[Item | EllipsisType], robots: int) -> list[Item]:
    """An item for each robot. `...` repeats the item before it until there are enough."""
    rest = [place for place, item in enumerate(items) if item is ...]
    if rest:
        [place, *others] = rest
        missing = robots - len(items) + 1
        if others or place == 0 or missing < -1:
            raise StarlError(f"{what}: `...` stands once, behind a value, and there are at most {robots} values")
        # With fewer robots than values, there is none of the repeated one.
        items = [*items[: place + min(missing, 0)], *[items[place - 1]] * missing, *items[place + 1 :]]
    if len(items) != robots:
        raise StarlError(f"{what}: {len(items)} values for {robots} robots; give one, or one each")
    return [item for item in items if not isinstance(item, EllipsisType)]
