"""Simulations: step, steer, look into, copy, bring back."""

from __future__ import annotations

import base64
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from operator import index
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from starl._errors import Diagnostic
from starl._errors import StarlError
from starl._files import Scenario
from starl._native import Engine
from starl._requests import request
from starl._show import Viewer
from starl._tables import Table

if TYPE_CHECKING:
    import matplotlib.axes

#: A call of the native module lasts about this long, so that Ctrl-C is answered.
_SLICE_SECONDS = 0.05


@dataclass(frozen=True)
class Status:
    """How far a run is."""

    now: float
    #: Whether the run has come to its end.
    over: bool
    #: "reached", "violated", "timed_out" or "failed"; None before the end.
    outcome: str | None
    #: How many physics steps the call has made.
    steps: int


@dataclass(frozen=True)
class Snapshot:
    """A moment of a simulation that is kept."""

    simulation: Simulation
    number: int
    now: float

    def drop(self) -> None:
        """Frees its memory."""
        self.simulation._ask("drop", snapshot=self.number)


@dataclass(frozen=True)
class Robot:
    """What is known of a robot for the whole run."""

    number: int
    name: str
    model: str
    program: str


class Simulation:
    """A run of a scenario. The same scenario and seed give the same run, to the last bit, as on the command line.

    `scenario` may be the name of an example. `records` chooses what is kept for `records()`: the names of topics
    (docs/reference/trace.md), or all of them.
    """

    #: What the scenario is called.
    title: str
    #: The seed of 64 bits.
    seed: int
    #: When the run ends at the latest.
    duration: float
    #: The length of a physics step.
    step_length: float
    #: The warnings of the compiler.
    warnings: list[Diagnostic]

    def __init__(
        self,
        scenario: Scenario | str,
        *,
        seed: int | None = None,
        records: Iterable[str] | Literal["all"] = "all",
    ) -> None:
        scenario = Scenario._from(scenario)
        options = scenario._options if seed is None else {**scenario._options, "seed": str(seed)}
        chosen = [records] if isinstance(records, str) else records
        topics = None if records == "all" else [_topic(name) for name in chosen]
        self._engine = Engine(scenario._programs)
        self._adopt(request(self._engine, "open", files=scenario._files, options=options, topics=topics))

    @classmethod
    def _recorded(cls, recorded: Any) -> Simulation:
        """The run that a trace records, at its start."""
        simulation = cls.__new__(cls)
        simulation._engine = Engine()
        simulation._adopt(request(simulation._engine, "open_recorded", recorded=recorded))
        return simulation

    def _adopt(self, opened: dict[str, Any]) -> None:
        self._number: int = opened["simulation"]
        self.title = opened["title"]
        self.seed = int(opened["seed"])
        self.duration = opened["duration"]
        self.step_length = opened["step_length"]
        self.warnings = [Diagnostic._of(found) for found in opened["warnings"]]
        self._engine.keep_all_records(self._number)
        self._arrays: tuple[NDArray[np.float64], ...] | None = None
        self._status = self._ask("status")

    def _ask(self, name: str, **parameters: Any) -> Any:
        return request(self._engine, name, simulation=self._number, **parameters)

    # Time

    @property
    def now(self) -> float:
        """The time of the run."""
        now: float = self._status["now"]
        return now

    @property
    def over(self) -> bool:
        """Whether the run has come to its end."""
        over: bool = self._status["over"]
        return over

    @property
    def outcome(self) -> str | None:
        """How the run ended: "reached", "violated", "timed_out" or "failed"; None before the end."""
        outcome: str | None = self._status["outcome"]
        return outcome

    def step(self, steps: int = 1) -> Status:
        """Makes physics steps, also when the run is over."""
        if steps < 0:
            raise StarlError(f"steps: {steps} is less than 0")
        for _ in range(steps):
            self._status = self._ask("step")
        self._refresh()
        return self._told(steps)

    def run(self, until: float | None = None, *, steps: int | None = None) -> Status:
        """Runs to the end, or to a time, or for so many steps at most. Other threads of Python run meanwhile, and Ctrl-C
        stops between two steps."""
        if until is not None and not (isinstance(until, (float, int, np.number)) and until >= 0 and np.isfinite(until)):
            raise StarlError(f"until: {until!r} is not a time; give seconds from 0, or nothing for the end of the run")
        if steps is not None and index(steps) < 0:
            raise StarlError(f"steps: {steps} is less than 0")
        made, slice = 0, 1
        while True:
            left = slice if steps is None else min(slice, steps - made)
            begun = time.perf_counter()
            self._status = self._ask("run", until=until, steps=left)
            took = time.perf_counter() - begun
            made += self._status["steps"]
            if self._status["steps"] < left or made == steps:
                self._refresh()
                return self._told(made)
            slice = max(1, min(slice * 2, int(slice * _SLICE_SECONDS / max(took, 1e-6))))

    def _told(self, steps: int) -> Status:
        status = self._status
        return Status(status["now"], status["over"], status["outcome"], steps)

    # The robots

    @property
    def robots(self) -> list[Robot]:
        """The robots, in the order of their numbers."""
        fleet = self._ask("fleet")
        return [Robot(number, one["name"], one["model"], one["program"]) for number, one in enumerate(fleet)]

    @property
    def poses(self) -> NDArray[np.float64]:
        """Where the robots are: shape (robots, 7), a row x, y, z and the orientation as a quaternion x, y, z, w.

        A read-only view of memory that `step`, `run` and `restore` overwrite: copy it to keep it. After a robot has
        joined, ask for a new one."""
        return self._views()[0]

    @property
    def estimates(self) -> NDArray[np.float64]:
        """Where the robots believe they are, as `poses`."""
        return self._views()[1]

    @property
    def velocities(self) -> NDArray[np.float64]:
        """How the robots move: shape (robots, 6), a row the velocity x, y, z and the rates of roll, pitch and yaw; a
        view as `poses`."""
        return self._views()[2]

    def _views(self) -> tuple[NDArray[np.float64], ...]:
        robots = self._engine.robots(self._number)
        if self._arrays is None or len(self._arrays[0]) != robots:
            self._arrays = tuple(np.empty((robots, columns)) for columns in (7, 7, 6))
            self._refresh()
        views = tuple(array.view() for array in self._arrays)
        for view in views:
            view.setflags(write=False)
        return views

    def _refresh(self) -> None:
        if self._arrays is not None and not self._engine.fill(self._number, *self._arrays):
            self._arrays = None

    def robot(self, robot: int | str) -> dict[str, Any]:
        """One robot at this moment, by its number or name: its variables, actions, primitives, timers and mailbox."""
        found: dict[str, Any] = self._ask("robot", robot=self._robot(robot))
        return found

    def _robot(self, robot: int | str) -> int:
        """The number of a robot that is given by its number or name. A number may be that of a robot that joins later."""
        if isinstance(robot, (int, np.integer)) and robot >= 0:
            return int(robot)
        names = [one["name"] for one in self._ask("fleet")]
        if robot in names:
            return names.index(robot)
        some = ", ".join(names[:8]) + (" ..." if len(names) > 8 else "")
        raise StarlError(f"there is no robot {robot!r}; give a number from 0, or one of the names {some}")

    def _robots(self, robots: Iterable[int | str]) -> list[int]:
        return [self._robot(robot) for robot in robots]

    def states(self) -> list[dict[str, Any]]:
        """The condition of each robot and the state of its program, in one line."""
        found: list[dict[str, Any]] = self._ask("states")
        return found

    def world(self) -> dict[str, Any]:
        """The obstacles, waypoints, areas and things."""
        found: dict[str, Any] = self._ask("world")
        return found

    # Results

    def report(self) -> dict[str, Any]:
        """The report of the run so far: properties, messages, collisions, failures."""
        found: dict[str, Any] = self._ask("report")
        return found

    @property
    def digest(self) -> str:
        """The hash of all that has happened: 16 hexadecimal digits, the same as on the command line."""
        digest: str = self.report()["digest"]
        return digest

    def records(self, topic: str | None = None) -> Table:
        """What has happened so far. With a topic, such as "pose" or "action", its members are columns; without, all
        topics, each record with its content as JSON."""
        try:
            return Table(self._engine.records(self._number, topic))
        except ValueError as error:
            raise StarlError(str(error)) from None

    def scenario(self) -> str:
        """The scenario with all that was applied, as the text of a file: run from the start, it goes as this run
        went."""
        text: str = self._ask("scenario")
        return text

    def save_trace(self, path: str | Path) -> None:
        """Writes the trace of the run so far, as `starl run --trace` does. Takes as long as the run."""
        Path(path).write_bytes(self._trace())

    def _trace(self) -> bytes:
        return base64.b64decode(self._ask("trace"))

    # Moments

    def snapshot(self) -> Snapshot:
        """Keeps the present moment."""
        return Snapshot(self, self._ask("snapshot"), self.now)

    def restore(self, snapshot: Snapshot) -> None:
        """Goes back, or forth, to a moment that was kept, exactly. It stays kept."""
        if not isinstance(snapshot, Snapshot):
            raise StarlError(f"{snapshot!r} is not a snapshot")
        if snapshot.simulation is not self:
            raise StarlError("the snapshot is one of another simulation")
        self._status = self._ask("restore", snapshot=snapshot.number)
        self._refresh()

    # Steering

    def apply(self, intervention: dict[str, Any], *, at: float | None = None) -> None:
        """Steers the run, at a time or at once. An intervention is a dictionary as docs/reference/javascript.md gives
        them, such as `{"leave": [2]}`; for the usual ones there are methods."""
        self._ask("apply", intervention=intervention, at=at)

    def _fault(self, fault: Any, at: float | None) -> None:
        self.apply({"fault": fault}, at=at)

    def crash(self, *robots: int | str, at: float | None = None) -> None:
        """Robots crash: they lose all but stored variables, and stop."""
        _named(robots)
        self._fault({"crash": self._robots(robots)}, at)

    def restart(self, *robots: int | str, at: float | None = None) -> None:
        """Robots that are down start again."""
        _named(robots)
        self._fault({"restart": self._robots(robots)}, at)

    def partition(self, *groups: Sequence[int | str], at: float | None = None) -> None:
        """Robots in different groups do not hear each other; robots in no group form one more."""
        self._fault({"partition": [self._robots(group) for group in groups]}, at)

    def heal(self, *, at: float | None = None) -> None:
        """Ends a partition."""
        self._fault("heal", at)

    def push(self, robot: int | str, by: Sequence[float], *, at: float | None = None) -> None:
        """Moves a robot's body by x, y, z as far as nothing is in the way."""
        self.apply({"push": {"robot": self._robot(robot), "by": _point(by)}}, at=at)

    def tell(self, name: str, *robots: int | str, at: float | None = None, **fields: Any) -> None:
        """An operator tells robots something; all of them if none are named. Fields are truth values, numbers, texts and
        places."""
        order = {"name": name, "fields": [[field, _value(field, value)] for field, value in fields.items()]}
        self.apply({"tell": {"robots": self._robots(robots), "order": order}}, at=at)

    def set_way_point(self, name: str, position: Sequence[float], *, at: float | None = None) -> None:
        """Sets a waypoint, new or not."""
        self.apply({"set_way_point": {"name": name, "position": _point(position), "group": 0}}, at=at)

    # Pictures

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws the world from above, the paths so far and where robots are."""
        from starl._plot import plot

        return plot(self.records("pose"), [robot.name for robot in self.robots], self.world(), ax)

    def show(self, *, live: bool = False, height: int = 560) -> Viewer:
        """The viewer with the run so far, for a notebook; it needs no server. If `live`, the page simulates the run
        itself, from its start and steered as it was, and it can be steered there."""
        return Viewer(self.title, self._trace(), live=live, height=height)

    def __reduce__(self) -> Any:
        raise TypeError(
            "a simulation cannot be pickled or deeply copied: keep a moment with `snapshot()`, or send its scenario and seed"
        )

    def _repr_html_(self) -> str:
        return self.show()._repr_html_()

    def __repr__(self) -> str:
        return f"<starl.Simulation of {self.title!r} at {self.now:g} s{' (over)' if self.over else ''}>"


def _named(robots: Sequence[int | str]) -> None:
    if not robots:
        raise StarlError("name at least one robot by its number or name")


def _topic(name: str) -> str:
    return name if name.startswith("/") else f"/starl/{name}"


def _point(numbers: Sequence[float]) -> dict[str, float]:
    try:
        x, y, z = (*map(float, numbers), 0.0, 0.0)[:3] if len(numbers) in (2, 3) else (float("nan"),) * 3
    except (TypeError, ValueError):
        x = y = z = float("nan")
    if not all(np.isfinite([x, y, z])):
        raise StarlError(f"{numbers!r} is not a point; give x, y and z")
    return {"x": x, "y": y, "z": z}


def _value(name: str, value: Any) -> dict[str, Any]:
    """A field of an order."""
    match value:
        case bool():
            return {"bool": value}
        case int():
            return {"int": value}
        case float():
            return {"float": value}
        case str():
            return {"text": value}
        case [_, _] | [_, _, _]:
            return {"point": _point(value)}
    raise StarlError(f"{name}: an order has truth values, numbers, texts and places, not {value!r}")
