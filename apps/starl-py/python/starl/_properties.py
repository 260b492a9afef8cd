"""Properties of programs in Python, which are judged while a run goes on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, TypeVar

P = TypeVar("P")


@dataclass(frozen=True)
class Member(Generic[P]):
    """A robot as a property sees it: not as it believes to be, but as it is."""

    id: int
    #: The robot's program, to be read and not changed; of a robot that is down as it was before.
    program: P
    position: tuple[float, float, float]
    velocity: tuple[float, float, float]
    heading: float
    #: Whether the robot has not crashed.
    up: bool
    #: Whether it is up and has reached its goal.
    finished: bool


@dataclass(frozen=True)
class Fleet(Generic[P]):
    """The robots that run a program, at a moment of a run, for its properties."""

    now: float
    #: The time since the start or since the last fault began or ended; 0 while the network is partitioned, a motor is stuck
    #: or sensors are frozen.
    undisturbed: float
    #: The time since the start or since a fault overwrote the variables of a robot.
    uncorrupted: float
    #: The robots that have started, in the order of their numbers.
    members: list[Member[P]]


Judged = Callable[[Fleet[Any]], "bool | str | None"]


def invariant(function: Judged) -> Any:
    """A property of a program that is to hold after every step of a run: a function of a `Fleet` in the class of the
    program, without `self`. It gives True or None if it holds, and else False or a text that says what is wrong. A violation
    is reported once, and again when the property has held in between. The function must depend on the fleet alone and change
    nothing."""
    return _property(function, None)


def eventually(within: float) -> Callable[[Judged], Any]:
    """A property of a program, as for `invariant`, that is to hold once within this time from the start of a run."""
    return lambda function: _property(function, float(within))


def _property(function: Judged, within: float | None) -> Any:
    function._starl_within = within  # type: ignore[attr-defined]
    return staticmethod(function)


def _judge(
    function: Judged, now: float, undisturbed: float, uncorrupted: float, members: list[tuple[Any, ...]]
) -> str | None:
    """What is wrong with a property; None if it holds."""
    found = function(Fleet(now, undisturbed, uncorrupted, [Member(*member) for member in members]))
    if isinstance(found, str):
        return found
    return None if found is None or found else "is not true"


def of_class(program: type) -> list[tuple[str, Callable[..., str | None], float | None]]:
    """The properties of a program: the name of each, a function that judges it, and the time within which it is to hold."""
    found = [(name, getattr(program, name)) for name in dir(program)]
    own = [(name, function) for name, function in found if hasattr(function, "_starl_within")]
    return [(name, partial(_judge, function), function._starl_within) for name, function in own]
