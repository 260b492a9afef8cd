"""Campaigns: runs under faults that are drawn at random, and smaller scenarios for those that go wrong."""

from __future__ import annotations

import json
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from starl._errors import StarlError
from starl._files import Scenario
from starl._native import Engine
from starl._requests import request
from starl._work import Progress, on_ray, on_threads


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
    cluster: str | None = None,
    progress: bool | None = None,
) -> CampaignResults:
    """Runs a scenario under profiles of faults with many seeds, as `starl test` does, and makes the first `shrink` runs
    that go wrong smaller, trying up to `most_trials` scenarios for each. Threads and cluster are as for `sweep`; the
    results do not depend on them."""
    scenario = Scenario(scenario) if isinstance(scenario, str) else scenario
    known = {one["name"]: one for one in request(Engine(), "profiles")}
    names = list(profiles) if profiles is not None else [name for name, one in known.items() if one["usual"]]
    for name in names:
        if name not in known:
            raise StarlError(f"there is no profile {name!r}; there are {', '.join(known)}")
    chosen = range(1, seeds + 1) if isinstance(seeds, int) else seeds
    trials = [(profile, str(seed)) for profile in names for seed in chosen]
    portable = scenario._portable()
    tried = _all({**portable, "trials": trials}, len(trials), "test", threads, cluster, progress)
    failed = [number for number, one in enumerate(tried) if one["wrong"] is not None]
    smaller = [trials[number] for number in failed[:shrink]]
    plan = {**portable, "trials": smaller, "shrink": most_trials}
    shrunk = _all(plan, len(smaller), "shrink", threads, cluster, progress)
    failures = []
    for place, number in enumerate(failed):
        one = tried[number]
        about = shrunk[place] if place < len(shrunk) else {}
        failures.append(
            Failure(
                profile=one["profile"],
                seed=int(one["seed"]),
                wrong=one["wrong"],
                text=one["text"],
                digest=one["digest"],
                scenario=about.get("scenario"),
                before=about.get("before"),
                after=about.get("after"),
            )
        )
    runs = [{key: one[key] for key in ("profile", "seed", "outcome", "wrong", "digest")} for one in tried]
    return CampaignResults([{**run, "seed": int(run["seed"])} for run in runs], failures)


def _all(
    plan: dict[str, Any], count: int, what: str, threads: int | None, cluster: str | None, progress: bool | None
) -> list[dict[str, Any]]:
    """The answers to all trials of a plan, in order."""
    text = json.dumps(plan).encode()
    numbers = list(range(count))
    if cluster is not None:
        results = on_ray(cluster, text, _try_on_worker, numbers)
    else:
        # An engine keeps what it compiled last, and answers one request at a time.
        local = threading.local()

        def work(number: int) -> tuple[int, dict[str, Any]]:
            local.engine = getattr(local, "engine", None) or Engine()
            return _try(plan, local.engine, number)

        results = on_threads(work, numbers, threads, lambda stop: None)
    found = dict(Progress(what, count, 0, progress).of(results))
    return [found[number] for number in numbers]


def _try(plan: dict[str, Any], engine: Engine, number: int) -> tuple[int, dict[str, Any]]:
    profile, seed = plan["trials"][number]
    about = {"files": plan["files"], "options": plan["options"], "profile": profile, "seed": seed}
    if "shrink" in plan:
        return number, request(engine, "shrink", most=plan["shrink"], **about)
    return number, request(engine, "try", **about)


#: The plan of this worker with its engine, which keeps what it compiled last.
_latest: dict[bytes, tuple[dict[str, Any], Engine]] = {}


def _try_on_worker(text: bytes, numbers: list[int]) -> list[tuple[int, dict[str, Any]]]:
    if text not in _latest:
        _latest.clear()
        _latest[text] = (json.loads(text), Engine())
    plan, engine = _latest[text]
    return [_try(plan, engine, number) for number in numbers]
