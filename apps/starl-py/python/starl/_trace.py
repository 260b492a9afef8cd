"""Traces of any host: simulated, real or emulated."""

from __future__ import annotations

import json
from os import PathLike, fspath
from typing import Any

from starl import _native
from starl._errors import StarlError
from starl._simulation import Simulation
from starl._tables import Table


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
        #: The hash of all that happened.
        self.digest: str | None = end.get("digest")
        #: When the run ended.
        self.end: float | None = end["end_ns"] * 1e-9 if "end_ns" in end else None
        self.program: str = header["program"]
        self.seed = int(header["seed"])
        #: The number, name and model of each robot.
        self.robots: list[dict[str, Any]] = header["robots"]

    def records(self, topic: str | None = None) -> Table:
        """The records of a topic with a column for each member; without a topic all, with their contents as JSON."""
        return Table(self._native.records(topic))

    def simulation(self) -> Simulation:
        """The recorded run of the simulator, at its start and steered as it was: it goes as it went."""
        return Simulation._recorded(json.loads(self._native.recorded))

    def __len__(self) -> int:
        return len(self._native)

    def __repr__(self) -> str:
        return f"<starl.Trace of {self.program!r}: {len(self):,} records, {self.outcome or self.error}>"


def read_trace(path: str | PathLike[str]) -> Trace:
    """Reads the trace of a run, or of a robot."""
    return Trace(fspath(path))
