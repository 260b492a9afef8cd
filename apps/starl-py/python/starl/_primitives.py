"""The primitives of the thesis as objects, for robots that are programmed in Python."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterable, Sequence
from typing import Any, Literal

from starl import _native
from starl._errors import StarlError
from starl._handle import RobotHandle


class Primitive:
    """A primitive of a program. It gets its name, by which the robots' instances find each other, from the attribute that
    holds it."""

    _bound: _native.Primitive | None = None

    def _make(self, name: str) -> _native.Primitive:
        raise NotImplementedError

    def __deepcopy__(self, memo: dict[int, Any]) -> Primitive:
        other = type(self).__new__(type(self))
        memo[id(self)] = other
        other.__dict__.update({name: copy.deepcopy(value, memo) for name, value in vars(self).items()})
        return other

    def __getstate__(self) -> dict[str, Any]:
        # Another process gets a program before it runs, whose primitives are still to be bound there.
        return {name: value for name, value in vars(self).items() if name != "_bound"}

    def _bind(self, name: str) -> None:
        if self._bound is None:
            try:
                self._bound = self._make(name)
            except ValueError as error:
                raise StarlError(f"{name}: {error}") from None

    @property
    def _native(self) -> _native.Primitive:
        if self._bound is None:
            raise StarlError("this primitive belongs to no running program; make it an attribute of one in __init__")
        return self._bound


class ReachAvoid(Primitive):
    """Moves the robot to a target around obstacles and other robots, or along a lane."""

    def __init__(
        self, *, vicinity: float = 0.075, planner: str = "auto", most_nodes: int = 20_000, gap: float = 0.75
    ) -> None:
        self._options = (vicinity, planner, most_nodes, gap)

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.reach_avoid(name, *self._options)

    def reach_avoid(self, robot: RobotHandle, target: Sequence[float]) -> None:
        """Sets out for a target, x, y and perhaps z."""
        x, y, z = (*target, 0.0)[:3]
        self._native.go(robot._native, x, y, z)

    def drive_lane(self, robot: RobotHandle, line: Sequence[Sequence[float]], until: float) -> None:
        """Drives along a line until it is `until` metres from the line's start, and stops before a robot that the
        detector shows less than `gap` metres from the line ahead. The same line again moves the limit."""
        places = [(float(x), float(y), float(z)) for x, y, z in ((*point, 0.0)[:3] for point in line)]
        self._native.drive_lane(robot._native, places, until)

    @property
    def along(self) -> float:
        """How far along its lane the robot is, in metres."""
        return self._native.along()

    def stop(self, robot: RobotHandle) -> None:
        """Gives up the target or the lane."""
        self._native.stop(robot._native)

    @property
    def active(self) -> bool:
        """Whether a target is under way."""
        return self._native.motion()[0]

    @property
    def done(self) -> bool:
        """Whether the target was reached."""
        return self._native.motion()[1]

    @property
    def failed(self) -> bool:
        """Whether the target was given up."""
        return self._native.motion()[2]

    @property
    def target(self) -> tuple[float, float, float] | None:
        """The target under way."""
        return self._native.target()


class Broadcast(Primitive):
    """Messages to all other robots, acknowledged and sent again."""

    def __init__(self, *, order: Literal["unordered", "fifo", "causal", "total"] = "unordered") -> None:
        self._order = order

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.broadcast(name, self._order)

    def broadcast(self, robot: RobotHandle, message: Any) -> None:
        """Sends a message that JSON can write to every other robot; in total order, to this one too."""
        self._native.send_all(robot._native, encoded(message))


class LocalBroadcast(Primitive):
    """Messages to all robots in reach of the radio, once, without acknowledgement."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.local_broadcast(name)

    def broadcast(self, robot: RobotHandle, message: Any) -> None:
        """Sends a message that JSON can write."""
        self._native.send_all(robot._native, encoded(message))


class Unicast(Primitive):
    """Messages to one robot, acknowledged and sent again."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.unicast(name)

    def send(self, robot: RobotHandle, to: int, message: Any) -> None:
        """Sends a message that JSON can write to a robot."""
        self._native.send(robot._native, to, encoded(message))


class Mutex(Primitive):
    """Mutual exclusion on named resources."""

    def __init__(self, *, algorithm: Literal["permission", "quorum", "lease"] = "permission") -> None:
        self._algorithm = algorithm

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.mutex(name, self._algorithm)

    def acquire(self, robot: RobotHandle, resources: Iterable[str]) -> None:
        """Asks for all resources at once."""
        self._native.acquire(robot._native, sorted(resources))

    def release(self, robot: RobotHandle, resources: Iterable[str]) -> None:
        """Gives resources back."""
        self._native.release(robot._native, sorted(resources))

    @property
    def held(self) -> bool:
        """Whether this robot alone holds them."""
        return self._native.held()[0]

    @property
    def waiting(self) -> bool:
        """Whether resources are asked for and not held yet."""
        return self._native.held()[1]


class FailureDetector(Primitive):
    """Notices which robots have failed, by their heartbeats."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.failure_detector(name)

    @property
    def suspects(self) -> list[int]:
        """The robots that are believed to have failed; it may be wrong."""
        return self._native.suspects()


class LeaderElection(Primitive):
    """Elects one robot; to replace a leader that has failed, the program also needs a FailureDetector."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.leader_election(name)

    def elect(self, robot: RobotHandle) -> None:
        """Takes part in the election."""
        self._native.elect(robot._native)

    @property
    def leader(self) -> int | None:
        """The leader, as far as it is known."""
        return self._native.leader()


class Registration(Primitive):
    """Robots that register agree on who is registered."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.registration(name)

    def register(self, robot: RobotHandle) -> None:
        """Asks to be registered."""
        self._native.register(robot._native)

    def unregister(self, robot: RobotHandle) -> None:
        """Ends the registration."""
        self._native.unregister(robot._native)

    @property
    def members(self) -> list[int] | None:
        """The robots on which all members agree; None before they do."""
        return self._native.members()


class Barrier(Primitive):
    """A place in the program at which all robots wait for each other."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.barrier(name)

    def arrive(self, robot: RobotHandle) -> None:
        """This robot has arrived."""
        self._native.arrive(robot._native)

    @property
    def passed(self) -> bool:
        """Whether all have arrived since this robot did."""
        return self._native.passed()[0]

    @property
    def waiting(self) -> bool:
        """Whether this robot waits for others."""
        return self._native.passed()[1]


class SharedMemory(Primitive):
    """Variables that all robots read and write; the last write is seen by all in the end."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.shared_memory(name)

    def write(self, robot: RobotHandle, variable: str, value: Any) -> None:
        """Writes a value that JSON can write."""
        self._native.write(robot._native, variable, encoded(value))

    def read(self, variable: str, default: Any = None) -> Any:
        """The value that is known; the default before the first write."""
        found = self._native.read(variable)
        return default if found is None else json.loads(found)


class Geocast(Primitive):
    """Messages to all robots in an area, acknowledged and sent again."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.geocast(name)

    def geocast(
        self,
        robot: RobotHandle,
        message: Any,
        *,
        center: Sequence[float] | None = None,
        radius: float | None = None,
        low: Sequence[float] | None = None,
        high: Sequence[float] | None = None,
    ) -> None:
        """Sends a message that JSON can write to the other robots in a circle, heights left out, or between two corners of
        a box."""
        circle = None if center is None or radius is None else (_place(center), float(radius))
        corners = None if low is None or high is None else (_place(low), _place(high))
        self._native.send_into(robot._native, circle, corners, encoded(message))


class Register(Primitive):
    """Registers, by name, that all robots read and write as if there were one of each (linearizable). Operations take time:
    `read` and `write` begin one and give its number, by which `status` and `value` tell what came of it."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.registers(name)

    def read(self, robot: RobotHandle, register: str) -> int:
        """Begins to read a register."""
        return self._native.begin_read(robot._native, register)

    def write(self, robot: RobotHandle, register: str, value: Any) -> int:
        """Begins to write a value that JSON can write."""
        return self._native.begin_write(robot._native, register, encoded(value))

    def status(self, operation: int) -> Literal["pending", "no_quorum", "done", "unknown"]:
        """How far an operation is: under way, under way while no majority answers, done, or withdrawn or so long ago that
        its result is forgotten."""
        return self._native.status(operation)[0]

    def value(self, operation: int, default: Any = None) -> Any:
        """The value that an operation that is done has read or written; the default if nothing was ever written or the
        operation is not done."""
        found = self._native.status(operation)[1]
        return default if found is None else json.loads(found)

    def withdraw(self, robot: RobotHandle, operation: int) -> None:
        """Gives up an operation, which may still take effect, or forgets its result."""
        self._native.withdraw(robot._native, operation)

    def known(self, register: str, default: Any = None) -> Any:
        """The value of this robot's own copy, at once: one that was written, but possibly not the latest."""
        found = self._native.known(register)
        return default if found is None else json.loads(found)


def _place(position: Sequence[float]) -> tuple[float, float, float]:
    x, y, *z = (float(number) for number in position)
    return (x, y, z[0] if z else 0.0)


def encoded(message: Any) -> bytes:
    """A message or a value as bytes."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False).encode()
