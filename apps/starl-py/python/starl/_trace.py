"""Traces of any host: simulated, real or emulated."""

from __future__ import annotations

import json
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from starl import _native
from starl._errors import StarlError
from starl._show import Viewer
from starl._simulation import Simulation
from starl._tables import Table

if TYPE_CHECKING:
    import matplotlib.axes


class Trace:
    """A trace that was read. One that is cut off or damaged is there as far as it goes, and `error` says why."""

    def __init__(self, path: str) -> None:
        try:
            self._native = _native.Trace(path)
        except ValueError as error:
            raise StarlError(str(error)) from None
        end = json.loads(self._native.end) or {}
        header = json.loads(self._native.header)
        self.path = path
        #: Why the trace ends before the run did; None if it does not.
        self.error: str | None = end.get("error")
        #: How the run ended, in a word.
        self.outcome: str | None = end.get("outcome")
        #: The hash of everything that happened.
        self.digest: str | None = end.get("digest")
        #: When the run ended.
        self.end: float | None = end["end_ns"] * 1e-9 if "end_ns" in end else None
        self.program: str = header["program"]
        self.seed = int(header["seed"])
        self._world: dict[str, Any] = header["world"]
        #: The number, name and model of each robot.
        self.robots: list[dict[str, Any]] = header["robots"]

    def records(self, topic: str | None = None) -> Table:
        """The records of a topic with a column for each member; without a topic all, with their contents as JSON."""
        return Table(self._native.records(topic))

    def simulation(self) -> Simulation:
        """The recorded run of the simulator, at its start and steered as it was: it goes as it went."""
        return Simulation._recorded(json.loads(self._native.recorded))

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws the world from above, the paths and where robots end."""
        from starl._plot import plot

        return plot(self.records("pose"), [robot["name"] for robot in self.robots], self._world, ax)

    def show(self, *, height: int = 560) -> Viewer:
        """The viewer with the trace, for a notebook; it needs no server."""
        return Viewer(Path(self.path).name, Path(self.path).read_bytes(), live=False, height=height)

    def __len__(self) -> int:
        return len(self._native)

    def __repr__(self) -> str:
        return f"<starl.Trace of {self.program!r}: {len(self):,} records, {self.outcome or self.error}>"


def read_trace(path: str | PathLike[str]) -> Trace:
    """Reads the trace of a run, or of a robot."""
    return Trace(fspath(path))
