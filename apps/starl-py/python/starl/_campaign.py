"""Campaigns: runs under faults that are drawn at random, and smaller scenarios for those that go wrong."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from operator import index
from typing import Any

from starl import _native
from starl._errors import StarlError
from starl._files import Scenario
from starl._requests import request
from starl._work import Plan, Progress, run_all


@dataclass(frozen=True)
class Failure:
    """A run that went wrong."""

    profile: str
    seed: int
    #: The property that was violated, "failed" or "unreached".
    wrong: str
    #: What was seen, in a sentence.
    text: str
    digest: str
    #: The smallest scenario that was found to fail in the same way, as the text of a file for the folder of the
    #: scenario; None if it was not looked for.
    scenario: str | None = None
    #: How large it is: robots, faults and seconds, before and after.
    before: dict[str, Any] | None = None
    after: dict[str, Any] | None = None


@dataclass(frozen=True)
class CampaignResults:
    """What came of a campaign."""

    #: For each run, in order: profile, seed, outcome, what was wrong (or None) and digest.
    runs: list[dict[str, Any]]
    failures: list[Failure]

    def __repr__(self) -> str:
        return f"<starl.CampaignResults: {len(self.runs):,} runs, {len(self.failures):,} failures>"


def test(
    scenario: Scenario | str,
    *,
    seeds: int | range = 25,
    profiles: Sequence[str] | None = None,
    shrink: int = 3,
    most_trials: int = 1000,
    threads: int | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    progress: bool | None = None,
) -> CampaignResults:
    """Runs a scenario under profiles of faults with many seeds, as `starl test` does, and makes the first `shrink` runs
    that go wrong smaller, trying up to `most_trials` scenarios for each. Threads, processes and cluster are as for
    `sweep`; the results do not depend on them."""
    scenario = Scenario._from(scenario)
    chosen = seeds if isinstance(seeds, range) else range(1, _count("seeds", seeds) + 1)
    if isinstance(profiles, str):
        profiles = [profiles]
    _count("shrink", shrink), _count("most_trials", most_trials)
    if chosen.step != 1 or not chosen or chosen[0] < 0:
        raise StarlError(f"{seeds}: give a range of seeds that follow each other, at least one")
    with scenario._opened() as (engine, opened):
        known = {one["name"]: one for one in request(engine, "profiles")}
        names = list(profiles) if profiles is not None else [name for name, one in known.items() if one["usual"]]
        for name in names:
            if name not in known:
                raise StarlError(f"there is no profile {name!r}; there are {', '.join(known)}")
        try:
            native = _native.Campaign(engine, opened["simulation"], names, chosen[0], len(chosen), most_trials)
        except ValueError as error:
            raise StarlError(str(error)) from None
    where: dict[str, Any] = {"threads": threads, "processes": processes, "cluster": cluster}

    def tell(what: str, results: Iterable[bytes], count: int) -> Iterable[bytes]:
        return Progress(what, count, 0, progress).of(results)

    numbers = list(range(len(native)))
    results = run_all(native.attempt, _attempt, native.plan, scenario._programs, numbers, **where)
    attempts: dict[int, bytes] = {}
    for attempt in tell("test", results, len(numbers)):
        attempts[json.loads(attempt)["number"]] = attempt
    told = {number: json.loads(attempts[number]) for number in numbers}
    failed = [number for number in numbers if told[number]["finding"] is not None]
    smaller = failed[:shrink]
    results = run_all(native.shrink, _shrink, native.plan, scenario._programs, smaller, **where)
    shrunk = {json.loads(one)[0]: one for one in tell("shrink", results, len(smaller))}
    runs = []
    failures = []
    for number, one in told.items():
        profile, seed = native.at(number)
        wrong = _wrong(one["finding"])
        runs.append({"profile": profile, "seed": seed, "outcome": one["outcome"], "wrong": wrong, "digest": one["digest"]})
        if wrong is not None:
            left = native.smaller(attempts[number], shrunk[number]) if number in shrunk else None
            about = json.loads(left) if left is not None else {}
            sizes = {key: about.get(key) for key in ("scenario", "before", "after")}
            failures.append(Failure(profile, seed, wrong, one["text"], one["digest"], **sizes))
    return CampaignResults(runs, failures)


def _count(name: str, value: int) -> int:
    if not hasattr(value, "__index__") or index(value) < 0:
        raise StarlError(f"{name}: {value!r} is not a whole number from 0")
    return index(value)


def _wrong(finding: dict[str, str] | str | None) -> str | None:
    return finding["violated"] if isinstance(finding, dict) else finding


#: The campaign that this process worked on last: programs are compiled once.
_latest: dict[Plan, _native.Campaign] = {}


def _campaign(plan: Plan) -> _native.Campaign:
    if plan not in _latest:
        _latest.clear()
        _latest[plan] = _native.Campaign.from_plan(plan.content, plan.load())
    return _latest[plan]


def _attempt(plan: Plan, numbers: list[int]) -> list[bytes]:
    campaign = _campaign(plan)
    return [campaign.attempt(number) for number in numbers]


def _shrink(plan: Plan, numbers: list[int]) -> list[bytes]:
    campaign = _campaign(plan)
    return [campaign.shrink(number) for number in numbers]
