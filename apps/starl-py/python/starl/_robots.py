"""Robots that are programmed in Python."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any, ClassVar, TypeVar

from starl import _native
from starl._errors import StarlError
from starl._faults import Draws, overwritten
from starl._primitives import Primitive, encoded
from starl._properties import of_class

T = TypeVar("T")


class RobotHandle:
    """What a program sees of its robot and asks of it, for as long as one call takes."""

    def __init__(self, native: _native.Handle) -> None:
        self._native = native

    @property
    def id(self) -> int:
        """This robot's number."""
        return self._native.id

    @property
    def now(self) -> float:
        """The time by the robot's own clock."""
        return self._native.now

    @property
    def fleet(self) -> list[int]:
        """All robots of the application, this one too."""
        return self._native.fleet

    @property
    def position(self) -> tuple[float, float, float]:
        """Where the robot believes it is."""
        return self._native.position

    @property
    def velocity(self) -> tuple[float, float, float]:
        """How the robot believes it moves, in the world frame."""
        return self._native.velocity

    @property
    def heading(self) -> float:
        """Where the robot believes it looks, from the x axis, left positive."""
        return self._native.heading

    @property
    def way_points(self) -> list[tuple[str, tuple[float, float, float]]]:
        """Name and position of each waypoint of the application."""
        return self._native.way_points

    @property
    def proximity(self) -> list[tuple[float, float]]:
        """Bearing, from the heading, and distance of each ray of the robot's proximity sensors; the range of a ray that
        meets nothing."""
        return self._native.proximity

    @property
    def bumped(self) -> bool:
        """Whether the body touches something."""
        return self._native.bumped

    @property
    def has_storage(self) -> bool:
        """Whether stable variables outlast a crash: see `RobotProgram.stable`."""
        return self._native.has_storage

    def wheels(self, left: float, right: float) -> None:
        """Turns the wheels of a differential drive at these rim speeds, without avoidance of others."""
        self._native.wheels(left, right)

    def drive(self, x: float, y: float, yaw_rate: float = 0.0) -> None:
        """Moves a holonomic robot with this velocity in the world frame, without avoidance of others, and turns it."""
        self._native.drive(x, y, yaw_rate)

    def halt(self) -> None:
        """Stands still; a drone in the air hovers."""
        self._native.halt()

    def finish(self) -> None:
        """The robot has reached its goal."""
        self._native.finish()

    def fail(self, reason: str) -> None:
        """The program cannot continue."""
        self._native.fail(reason)

    def action(self, name: str) -> None:
        """Records that a guarded action fired."""
        self._native.action(name)

    def log(self, text: str) -> None:
        """Records a line of the log."""
        self._native.log(text, False)

    # The robot's random stream: the same draws in every run of a scenario and seed.

    def random(self) -> float:
        """A number from 0 to 1, without 1."""
        return self._native.random()

    def uniform(self, low: float, high: float) -> float:
        """A number between two."""
        return low + (high - low) * self.random()

    def choice(self, among: Sequence[T]) -> T:
        """One of several."""
        return among[int(self.random() * len(among))]


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
