"""Robots that are programmed in Python."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, ClassVar

from starl import _native
from starl._errors import StarlError
from starl._faults import Draws, overwritten
from starl._handle import RobotHandle
from starl._primitives import Primitive, encoded
from starl._properties import of_class


class RobotProgram:
    """A program of a robot in Python: override `start`, `activate`, `receive` and `told`.

    Make primitives in `__init__`, one attribute each. Each robot runs a deep copy of the object, and a restarted one a
    fresh copy, so attributes are the robot's own variables. Calls must depend on nothing else: draw random numbers from the
    robot, read no clock and no global that changes, and do not iterate over sets of texts, whose order differs from
    process to process. Then the run repeats exactly.
    """

    #: The names of attributes that survive a crash on robots with storage (docs/reference/scenario.md#storage). They hold
    #: values that JSON can write, are written after each call that changes them, and have their stored values when `start`
    #: is called again.
    stable: ClassVar[tuple[str, ...]] = ()

    def start(self, robot: RobotHandle) -> None:
        """Called once, and again when the robot restarts after a crash."""

    def activate(self, robot: RobotHandle) -> None:
        """Called every control period: one pass over the guarded actions."""

    def receive(self, robot: RobotHandle, sender: int, message: Any, primitive: Primitive | None) -> None:
        """Called when a primitive delivers a message."""

    def told(self, robot: RobotHandle, name: str, fields: dict[str, Any]) -> None:
        """Called when an operator tells the robot something, and with the name "way_points" when the waypoints have
        changed. Places are lists, times are seconds, and robots are numbers."""

    def corrupt(self, draws: Draws) -> None:
        """Overwrites the robot's variables at random, as a fault of a scenario does: every attribute that is a number, a
        text or a truth value, or that holds such in lists, tuples, sets and dictionaries, gets another value of its type.
        Override it for attributes of other types."""
        for name, value in sorted(vars(self).items()):
            if not isinstance(value, Primitive):
                setattr(self, name, overwritten(value, draws))

    # The native module calls these.

    def _prepare(self) -> tuple[list[tuple[Primitive, _native.Primitive]], bool]:
        """The primitives, which get the names of their attributes, and whether there are stable variables."""
        for name in self.stable:
            if not hasattr(self, name):
                raise StarlError(f"{type(self).__name__}.stable: there is no attribute {name!r}; set it in __init__")
        found = [(name, value) for name, value in vars(self).items() if isinstance(value, Primitive)]
        for name, primitive in found:
            primitive._bind(name)
        return [(primitive, primitive._native) for _, primitive in found], bool(self.stable)

    def _start(self, native: _native.Handle, stored: dict[str, list[int]]) -> None:
        for name in self.stable:
            if name in stored:
                setattr(self, name, json.loads(bytes(stored[name])))
        self.start(RobotHandle(native))

    def _activate(self, native: _native.Handle) -> None:
        self.activate(RobotHandle(native))

    def _receive(self, native: _native.Handle, sender: int, primitive: Primitive | None, content: bytes | None) -> None:
        try:
            message = json.loads(content or b"")
        except ValueError:
            native.log(f"a message of robot {sender} is ignored: it is not of a program in Python", True)
            return
        self.receive(RobotHandle(native), sender, message, primitive)

    def _told(self, native: _native.Handle, name: str, fields: str) -> None:
        self.told(RobotHandle(native), name, json.loads(fields))

    def _corrupt(self, draws: _native.Draws) -> None:
        self.corrupt(Draws(draws))

    def _stable_values(self) -> dict[str, bytes]:
        return {name: encoded(getattr(self, name)) for name in self.stable}

    @classmethod
    def _properties(cls) -> list[tuple[str, Callable[..., str | None], float | None]]:
        return of_class(cls)
