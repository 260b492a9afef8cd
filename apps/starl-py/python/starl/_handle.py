"""The handle by which programs in Python see and command their robot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from starl import _native

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
