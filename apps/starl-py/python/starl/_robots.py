"""Robots that are programmed in Python, and the primitives of the thesis as objects."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterable, Sequence
from typing import Any, Literal, TypeVar

from starl import _native
from starl._errors import StarlError

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
        """The program cannot go on."""
        self._native.fail(reason)

    def action(self, name: str) -> None:
        """Records that a guarded action fired."""
        self._native.action(name)

    def log(self, text: str) -> None:
        """Records a line of the log."""
        self._native.log(text)

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
    """Moves the robot to a target around obstacles and other robots."""

    def __init__(self, *, vicinity: float = 0.075, planner: str = "auto", most_nodes: int = 20_000) -> None:
        self._options = (vicinity, planner, most_nodes)

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.reach_avoid(name, *self._options)

    def reach_avoid(self, robot: RobotHandle, target: Sequence[float]) -> None:
        """Sets out for a target, x, y and perhaps z."""
        x, y, z = (*target, 0.0)[:3]
        self._native.go(robot._native, x, y, z)

    def stop(self, robot: RobotHandle) -> None:
        """Gives up the target."""
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
        self._native.send_all(robot._native, _encoded(message))


class LocalBroadcast(Primitive):
    """Messages to all robots in reach of the radio, once, without acknowledgement."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.local_broadcast(name)

    def broadcast(self, robot: RobotHandle, message: Any) -> None:
        """Sends a message that JSON can write."""
        self._native.send_all(robot._native, _encoded(message))


class Unicast(Primitive):
    """Messages to one robot, acknowledged and sent again."""

    def _make(self, name: str) -> _native.Primitive:
        return _native.Primitive.unicast(name)

    def send(self, robot: RobotHandle, to: int, message: Any) -> None:
        """Sends a message that JSON can write to a robot."""
        self._native.send(robot._native, to, _encoded(message))


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
        self._native.write(robot._native, variable, _encoded(value))

    def read(self, variable: str, default: Any = None) -> Any:
        """The value that is known; the default before the first write."""
        found = self._native.read(variable)
        return default if found is None else json.loads(found)


class RobotProgram:
    """A program of a robot in Python: override `start`, `activate` and `receive`.

    Make primitives in `__init__`, one attribute each. Each robot runs a deep copy of the object, and a restarted one a
    fresh copy, so attributes are the robot's own variables. Calls must depend on nothing else: draw random numbers from the
    robot, read no clock and no global that changes, and do not iterate over sets of texts, whose order differs from
    process to process. Then the run repeats exactly.
    """

    def start(self, robot: RobotHandle) -> None:
        """Called once, and again when the robot restarts after a crash."""

    def activate(self, robot: RobotHandle) -> None:
        """Called every control period: one pass over the guarded actions."""

    def receive(self, robot: RobotHandle, sender: int, message: Any, primitive: Primitive | None) -> None:
        """Called when a primitive delivers a message."""

    def _primitives(self) -> list[_native.Primitive]:
        """The native primitives, named after their attributes."""
        found = [(name, value) for name, value in vars(self).items() if isinstance(value, Primitive)]
        for name, primitive in found:
            primitive._bind(name)
        return [primitive._native for _, primitive in found]

    def _receive(self, native: _native.Handle, sender: int, port: int, content: bytes) -> None:
        own = (value for value in vars(self).values() if isinstance(value, Primitive))
        primitive = next((one for one in own if one._native.port == port), None)
        self.receive(RobotHandle(native), sender, json.loads(content), primitive)

    def _start(self, native: _native.Handle) -> None:
        self.start(RobotHandle(native))

    def _activate(self, native: _native.Handle) -> None:
        self.activate(RobotHandle(native))


def _encoded(message: Any) -> bytes:
    return json.dumps(message, separators=(",", ":"), allow_nan=False).encode()
