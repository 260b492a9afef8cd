"""Sweeps: one scenario with every combination of some fields' values and with many seeds."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from starl import _native
from starl._errors import StarlError
from starl._extras import needed
from starl._files import Scenario, _leaves, _toml
from starl._requests import request
from starl._tables import Table
from starl._work import Plan, Progress, run_all

if TYPE_CHECKING:
    import matplotlib.axes


class SweepResults:
    """What came of a sweep: a row for each run."""

    def __init__(self, native: _native.Sweep) -> None:
        self._native = native
        #: The fields that were varied with their values, the slowest first.
        self.axes: dict[str, list[str]] = dict(native.axes)

    @property
    def rows(self) -> Table:
        """A row for each run, in the order of the plan, with the values of its fields, its seed, outcome, digest and
        metrics."""
        return Table(self._native.table())

    def summary(self) -> list[dict[str, Any]]:
        """For each combination: its `values`, the numbers of runs, the share that reached the `goal` and the mean of
        each of `metrics`, as estimates with 95 % confidence intervals (Wilson's for shares, Student's for means)."""
        combinations: list[dict[str, Any]] = json.loads(self._native.summary())["combinations"]
        return combinations

    def plot(self, metric: str = "goal", ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws the share that reached the goal, or the mean of a metric, against the first field, a line for each value
        of the others, with bands for the confidence intervals."""
        labels = {"goal": "share of runs that reached the goal", **dict(_native.Sweep.metrics())}
        if metric not in labels:
            raise StarlError(f"there is no metric {metric!r}; there are {', '.join(labels)}")
        if not self.axes:
            raise StarlError("there is no field to draw against; give one several values")
        if ax is None:
            ax = needed("matplotlib.pyplot", "plot").subplots(figsize=(6.4, 4.2), layout="constrained")[1]
        [across, *others] = self.axes
        lines: dict[tuple[str, ...], list[tuple[str, dict[str, Any]]]] = {}
        for one in self.summary():
            found = one["goal"] if metric == "goal" else one["metrics"][metric]
            if found is not None:
                key = tuple(one["values"][field] for field in others)
                lines.setdefault(key, []).append((one["values"][across], found))
        numbers = [_number(value) for value in self.axes[across]]
        numeric = all(number is not None for number in numbers)
        places = {value: number if numeric else place for place, (value, number) in enumerate(zip(self.axes[across], numbers, strict=True))}
        for key, points in lines.items():
            label = ", ".join(f"{field} {value}" for field, value in zip(others, key, strict=True))
            at = np.array([places[value] for value, _ in points], dtype=float)
            of = np.array([[one["estimate"], *_band(one)] for _, one in points])
            [line] = ax.plot(at, of[:, 0], marker="o", label=label or None)
            ax.fill_between(at, of[:, 1], of[:, 2], color=line.get_color(), alpha=0.2, linewidth=0)
        if not numeric:
            ax.set_xticks(range(len(numbers)), self.axes[across])
        ax.set_xlabel(f"{across} ({_unit(self.axes[across])})" if numeric and _unit(self.axes[across]) else across)
        ax.set_ylabel(labels[metric])
        if others:
            ax.legend(fontsize=8)
        return ax

    def save(self, out: str | PathLike[str]) -> None:
        """Writes the rows into a file that ends in .parquet, .csv or .jsonl."""
        _native_call(self._native.save, fspath(out))

    def __len__(self) -> int:
        return len(self._native) - len(self._native.open())

    def __repr__(self) -> str:
        return f"<starl.SweepResults: {len(self):,} of {len(self._native):,} runs>"

    def _repr_html_(self) -> str | None:
        return self.rows._repr_html_()


def sweep(
    scenario: Scenario | str,
    set: Mapping[str, Sequence[Any] | str | Any] | None = None,
    *,
    seeds: int | str | range = 10,
    profile: str | None = None,
    out: str | PathLike[str] | None = None,
    threads: int | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    progress: bool | None = None,
) -> SweepResults:
    """Runs a scenario with every combination of values and with many seeds.

    `set` gives fields of the scenario and their values: a list, or a range as text, `"0..0.4:9"`; `fleet` is the number
    of robots. `profile` adds the faults of one (docs/reference/testing.md). With `out`, rows are kept beside that file as
    they come, so that a sweep that was stopped goes on where it was, and the file is written at the end.

    It runs on threads of this process, as many as there are cores unless `threads` says how many; on so many `processes`
    of this machine; or on a `cluster` of Ray, whose workers need the same wheel: "ray" is the one that this process is
    connected to, that RAY_ADDRESS names or that runs on this machine, "local" starts one, and other texts are addresses.
    Programs in Python share one lock on threads. The rows are the same anywhere."""
    scenario = Scenario._from(scenario)
    if set is not None and not isinstance(set, Mapping):
        raise StarlError(f"set: {set!r} is not a dictionary of fields and their values")
    axes = [_axis(*leaf) for name, values in (set or {}).items() for leaf in _leaves(name, values)]
    first = _native_call(_native.Sweep.first_values, axes)
    engine = scenario._engine()
    options = {**scenario._options, "set": [*scenario._options.get("set", []), *first]}
    opened = request(engine, "open", files=scenario._files, options=options, topics=[])
    spread = str(seeds)
    if isinstance(seeds, range):
        if seeds.step != 1 or not seeds:
            raise StarlError(f"{seeds}: give a range of seeds that follow each other, at least one")
        # The command's ranges have their end in them.
        spread = f"{seeds[0]}..{seeds[-1]}"
    native: _native.Sweep = _native_call(_native.Sweep, engine, opened["simulation"], axes, spread, profile)
    if out is not None:
        _native_call(native.keep_beside, fspath(out))
    numbers = native.open()
    told = Progress("sweep", len(native), len(native) - len(numbers), progress)
    where: dict[str, Any] = {"threads": threads, "processes": processes, "cluster": cluster, "stop": native.stop}
    rows = run_all(native.run, _run_on_worker, native.plan, scenario._programs, numbers, **where)
    try:
        for row in told.of(rows):
            if row is not None:
                _native_call(native.take, row)
    finally:
        native.release()
    results = SweepResults(native)
    if out is not None:
        results.save(out)
    return results


#: The sweep that this process ran last: programs are compiled once.
_latest: dict[Plan, _native.Sweep] = {}


def _run_on_worker(plan: Plan, numbers: list[int]) -> list[bytes | None]:
    if plan not in _latest:
        _latest.clear()
        _latest[plan] = _native.Sweep.from_plan(plan.content, plan.load())
    return [_latest[plan].run(number) for number in numbers]


def _axis(field: str, values: Any) -> str:
    if isinstance(values, str):
        return f"{field}={values}"
    if hasattr(values, "tolist"):
        values = values.tolist()
    if not isinstance(values, Iterable):
        values = [values]
    return f"{field}={','.join(_plain(field, value) for value in values)}"


def _plain(field: str, value: Any) -> str:
    return value if isinstance(value, str) else _toml(field, value)


def _number(value: str) -> float | None:
    try:
        return float(value.rstrip("abcdefghijklmnopqrstuvwxyz%/²"))
    except ValueError:
        return None


def _unit(values: list[str]) -> str:
    return values[0].lstrip("+-.0123456789e") if values else ""


def _band(one: dict[str, Any]) -> tuple[float, float]:
    low, high = one["low"], one["high"]
    return (math.nan if low is None else low, math.nan if high is None else high)


def _native_call(call: Any, *arguments: Any) -> Any:
    """Calls the native module; what it refuses is a StarlError."""
    try:
        return call(*arguments)
    except ValueError as error:
        raise StarlError(str(error)) from None
