"""The worlds of a batch of environments, as arrays."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from starl import _native
from starl._errors import StarlError
from starl.env._settings import Box, Circle, Settings, Waypoints

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Quantities that observations compute from the arrays of the world.
COMPUTED = ("heading", "touched", "heard")


class World:
    """E environments of N robots each. Arrays are overwritten by each step: copy what you keep.

    Places are metres in a world frame with z up, angles radians, speeds metres per second.
    """

    def __init__(self, settings: Settings, environments: int, threads: int = 1) -> None:
        if environments < 1:
            raise ValueError(f"{environments} environments; use at least 1")
        if threads < 1:
            raise ValueError(f"{threads} threads; use at least 1")
        settings.check()
        self.settings = settings
        #: The number of environments.
        self.environments = environments
        #: The number of robots of each.
        self.robots = settings.robots
        self._batch = _native_batch(settings, environments, threads)
        #: Radius of each robot's body, greatest speed, and greatest rate of turn: shape (N,).
        self.radii, self.speeds, self.turn_rates = np.array(self._batch.limits).T
        shape = (environments, self.robots)
        rays = settings.lidar.rays if settings.lidar else 0
        words = settings.radio.numbers if settings.radio else 0
        heard = self.robots if settings.radio else 0
        #: Where robots are: (E, N, 6), a row x, y, z, yaw, pitch, roll.
        self.poses: Floats = np.zeros((*shape, 6))
        #: (E, N, 6): the velocity in the world frame, then the rates of yaw, pitch and roll.
        self.velocities: Floats = np.zeros((*shape, 6))
        #: The first thing that each robot touched in the last action: (E, N); -1 for nothing, below N another robot, from N
        #: on an obstacle.
        self.contacts: NDArray[np.int32] = np.full(shape, -1, np.int32)
        #: (E, N, rays): metres from the body's edge to what the ray meets; the range if it meets nothing.
        self.lidar: Floats = np.zeros((*shape, rays))
        #: The newest message by receiver and sender: (E, N, N, numbers); 0 where none came.
        self.messages: Floats = np.zeros((*shape, heard, words))
        #: How many actions ago that was sent: (E, N, N); -1 where none came.
        self.ages: NDArray[np.int32] = np.full((*shape, heard), -1, np.int32)
        #: Actions since the robots were placed: (E,).
        self.steps: Ints = np.zeros(environments, np.int64)
        self._actions: Floats = np.zeros((*shape, self._batch.action_numbers))
        self._sent: Floats = np.zeros((*shape, words))
        #: The task's own quantities by name: (E, N, k).
        self.quantities: dict[str, Floats] = {}
        self._rows: Floats = np.zeros((*shape, 0))
        self._outputs = (self.poses, self.velocities, self.contacts, self.lidar, self.messages, self.ages)
        self._show(np.arange(environments))

    def _declare(self, widths: Mapping[str, int], constants: Mapping[str, Sequence[float]]) -> None:
        """Makes room for the quantities of a task."""
        shape = (self.environments, self.robots)
        self._rows = np.zeros((*shape, sum(widths.values())))
        places = np.cumsum([0, *widths.values()])
        for (name, width), place in zip(widths.items(), places, strict=False):
            self.quantities[name] = self._rows[..., place : place + width]
        for name, values in constants.items():
            self.quantities[name] = np.broadcast_to(np.asarray(values, np.float64)[:, None], (*shape, 1))

    def __getitem__(self, name: str) -> Floats:
        """A quantity of the task: (E, N, 2) for points, else (E, N, 1); of a Bool 0 or 1."""
        return self.quantities[name]

    def __setitem__(self, name: str, values: ArrayLike) -> None:
        self.quantities[name][...] = values

    def mean(self, name: str, *, where: str, least: str | float = 1) -> Floats:
        """The mean of a quantity over the robots of each environment of which a Bool is true: (E, 1, k). It is 0 where
        there are fewer than `least` of them, a number or the name of a value."""
        chosen = quantity(self, where, "where")
        needed = quantity(self, least, "least")[:, :1] if isinstance(least, str) else least
        count = chosen.sum(axis=1, keepdims=True)
        total: Floats = (quantity(self, name, "mean") * chosen).sum(axis=1, keepdims=True)
        return np.where(count >= np.maximum(needed, 1), total / np.maximum(count, 1), 0.0)

    @property
    def action_numbers(self) -> int:
        """How many numbers a robot's action has, with its message."""
        numbers: int = self._actions.shape[2] + self._sent.shape[2]
        return numbers

    @property
    def seconds(self) -> float:
        """How long an action lasts."""
        return self.settings.physics_step * self.settings.steps_per_action

    @property
    def positions(self) -> Floats:
        """Where robots are in the plane: (E, N, 2)."""
        return self.poses[..., :2]

    @property
    def headings(self) -> Floats:
        """(E, N)."""
        return self.poses[..., 3]

    def step(self, actions: NDArray[np.floating[Any]]) -> None:
        """Carries out an action of every robot: (E, N, numbers), each from -1 to 1."""
        numbers = self._actions.shape[2]
        if actions.shape != (self.environments, self.robots, self.action_numbers):
            expected = (self.environments, self.robots, self.action_numbers)
            raise ValueError(f"actions have the shape {actions.shape}; use {expected}")
        if actions.dtype.kind not in "biuf":
            raise ValueError(f"actions have the type {actions.dtype}; use numbers")
        self._actions[...] = actions[..., :numbers]
        self._sent[...] = actions[..., numbers:]
        self._batch.step(self._actions, self._sent, *self._outputs)
        self.steps += 1

    def seed(self, envs: Ints, seeds: NDArray[np.uint64]) -> None:
        """Restarts the random streams of environments."""
        self._batch.seed(envs, seeds)

    def uniform(self, envs: Ints, *shape: int, low: float = 0.0, high: float = 1.0) -> Floats:
        """Numbers from the environments' own random streams: shape (len(envs), *shape)."""
        numbers = np.empty((len(envs), int(np.prod(shape))))
        self._batch.draw(envs, numbers)
        return (low + (high - low) * numbers).reshape(len(envs), *shape)

    def scatter(
        self,
        envs: Ints,
        count: int,
        low: Sequence[float],
        high: Sequence[float],
        *,
        gap: float | None = None,
        clearance: float | None = None,
    ) -> Floats:
        """Free places between two corners, drawn from the environments' own streams: (len(envs), count, 3).

        They are `gap` apart, 2.5 radii of the largest robot unless given, and `clearance` from obstacles, a radius unless
        given. Robots do not count as obstacles."""
        radius = float(self.radii.max())
        gap = 2.5 * radius if gap is None else gap
        clearance = radius if clearance is None else clearance
        places = np.empty((len(envs), count, 3))
        self._batch.scatter(envs, (_corner(low), _corner(high)), (clearance, 0.1, gap), places)
        return places

    def set_circles(self, envs: Ints, circles: Floats) -> None:
        """Gives environments round pillars of their own, beside the obstacles of all: (len(envs), count, 3), a row x, y,
        radius. They stay until they are set again."""
        self._batch.set_circles(envs, np.ascontiguousarray(circles, np.float64))

    def place(self, envs: Ints, positions: Floats, headings: ArrayLike = 0.0) -> None:
        """Begins an episode with the robots at rest: positions (len(envs), N, 2 or 3), headings (len(envs), N)."""
        poses = np.zeros((len(envs), self.robots, 4))
        poses[..., : positions.shape[-1]] = positions
        poses[..., 3] = headings
        self._batch.place(envs, poses)
        self.steps[envs] = 0
        self._show(envs)

    def _show(self, envs: Ints) -> None:
        self._batch.show(envs, *self._outputs)

    def __reduce__(self) -> Any:
        raise TypeError("environments cannot be pickled or deeply copied: pickle the task, and make another environment of it")

    def __repr__(self) -> str:
        return f"<starl.env.World of {self.environments} environments with {self.robots} robots>"


def quantity(world: World, name: str, part: str = "observe") -> Floats:
    """The array (E, N, k) that holds a quantity."""
    given: dict[str, Floats] = {
        "position": world.positions,
        "altitude": world.poses[..., 2:3],
        "velocity": world.velocities[..., :2],
        "turn_rate": world.velocities[..., 3:4],
        "lidar": world.lidar,
        **world.quantities,
    }
    if name not in given:
        names = [*given, *COMPUTED]
        close = difflib.get_close_matches(name, names, 1)
        hint = f"; did you mean `{close[0]}`?" if close else f"; use one of {', '.join(names)}"
        raise StarlError(f"{part}: there is no quantity `{name}`{hint}")
    return given[name]


def _corner(numbers: Sequence[float]) -> tuple[float, float, float]:
    x, y, z = (*map(float, numbers), 0.0)[:3]
    return x, y, z


def _native_batch(settings: Settings, environments: int, threads: int) -> _native.Batch:
    lidar, radio = settings.lidar, settings.radio
    delay = radio.delay if radio else 0
    shortest, longest = (delay, delay) if isinstance(delay, int) else delay
    try:
        return _native.Batch(
            settings.models(),
            environments,
            physics_step=settings.physics_step,
            steps_per_action=settings.steps_per_action,
            collisions=settings.collisions,
            circles=[(one.x, one.y, one.radius) for one in settings.obstacles if isinstance(one, Circle)],
            boxes=[(one.left, one.bottom, one.right, one.top) for one in settings.obstacles if isinstance(one, Box)],
            walls=settings.walls,
            lidar=(lidar.rays, lidar.range) if lidar else None,
            reach=settings.actions.reach if isinstance(settings.actions, Waypoints) else None,
            radio=(radio.numbers, radio.range, radio.loss, shortest, longest) if radio else None,
            threads=threads,
        )
    except (ValueError, OverflowError) as error:
        raise StarlError(str(error)) from None
