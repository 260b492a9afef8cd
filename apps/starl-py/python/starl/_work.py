"""Many independent pieces of work: on the threads of this machine or on a cluster of Ray, with progress."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from itertools import islice
from typing import Any, TypeVar

from starl._errors import StarlError

Result = TypeVar("Result")

#: A piece of work of the cluster should last about this long, so that its overhead does not count.
_BATCH_SECONDS = 0.5
_MOST_IN_BATCH = 500


def on_threads(
    work: Callable[[int], Result], numbers: list[int], threads: int | None, stop: Callable[[bool], None]
) -> Iterator[Result]:
    """Does the work of each number on threads of this process, and gives results as they come. The native module does
    the work without Python's lock. When the caller ends early, `stop` ends what is under way."""
    count = (os.cpu_count() or 1) if threads is None else threads
    if count < 1:
        raise StarlError(f"{threads} threads: give at least 1")
    stop(False)
    ahead = iter(numbers)
    with ThreadPoolExecutor(count) as pool:
        pending = {pool.submit(work, number) for number in islice(ahead, 2 * count)}
        try:
            while pending:
                # With a timeout, since a wait without one is not interrupted by Ctrl-C on all systems.
                done, pending = wait(pending, timeout=0.2, return_when=FIRST_COMPLETED)
                for future in done:
                    yield future.result()
                pending |= {pool.submit(work, number) for number in islice(ahead, len(done))}
        except BaseException:
            for future in pending:
                future.cancel()
            stop(True)
            raise


def on_ray(
    address: str, plan: bytes, worker: Callable[[bytes, list[int]], list[Result]], numbers: list[int]
) -> Iterator[Result]:
    """Does the work on a cluster of Ray, in batches, and gives results as they come. `worker` gets the plan and some
    numbers. What was under way on a node that dies is done again elsewhere; results do not depend on it, since the same
    number gives the same result everywhere."""
    try:
        import ray
        from ray import exceptions
    except ImportError:
        raise StarlError("a cluster needs Ray: pip install 'starl[ray]'") from None

    if not ray.is_initialized():
        ray.init(address=None if address == "local" else _address(address), log_to_driver=False)
    shared = ray.put(plan)
    # Ray itself retries what a dead worker was doing, without end; results lost with a node come here as errors.
    remote = ray.remote(num_cpus=1, max_retries=-1)(worker)
    ahead = list(reversed(numbers))
    under_way: dict[Any, tuple[list[int], float]] = {}
    size = 1
    while ahead or under_way:
        resources: dict[str, float] = ray.cluster_resources()  # type: ignore[no-untyped-call]
        cpus = max(1, int(resources.get("CPU", 1)))
        while ahead and len(under_way) < 2 * cpus:
            batch = [ahead.pop() for _ in range(min(size, max(1, len(ahead) // cpus), len(ahead)))]
            under_way[remote.remote(shared, batch)] = (batch, time.monotonic())
        ready, _ = ray.wait(list(under_way), timeout=1.0)
        for reference in ready:
            batch, begun = under_way.pop(reference)
            try:
                results = ray.get(reference)
            except (exceptions.WorkerCrashedError, exceptions.ObjectLostError, exceptions.NodeDiedError):
                ahead.extend(reversed(batch))
                continue
            except exceptions.RayTaskError as error:
                raise StarlError(str(error.cause or error)) from None
            yield from results
            each = (time.monotonic() - begun) / len(batch) / 2
            size = max(1, min(_MOST_IN_BATCH, int(_BATCH_SECONDS / max(each, 1e-6))))


def _address(cluster: str) -> str | None:
    """The address that `ray.init` takes: "ray" means the cluster that runs here or that RAY_ADDRESS names."""
    return "auto" if cluster == "ray" else cluster


class Progress:
    """How far long work is, with the time left, on one line of the error stream if that is a terminal, and in notebooks."""

    def __init__(self, what: str, total: int, done: int, shown: bool | None) -> None:
        self._what, self._total, self._begun_with, self._done = what, total, done, done
        self._shown = sys.stderr.isatty() if shown is None else shown
        self._begun = time.monotonic()
        self._told = 0.0
        self._lock = threading.Lock()

    def of(self, results: Iterable[Result]) -> Iterator[Result]:
        """The same results, counted."""
        try:
            for result in results:
                self._done += 1
                self._tell(time.monotonic())
                yield result
        finally:
            if self._shown and self._told:
                print(f"\r\x1b[K{self._line()}", file=sys.stderr)

    def _tell(self, now: float) -> None:
        if self._shown and now - self._told > 0.2:
            self._told = now
            print(f"\r\x1b[K{self._line()}", end="", file=sys.stderr, flush=True)

    def _line(self) -> str:
        elapsed = time.monotonic() - self._begun
        rate = (self._done - self._begun_with) / max(elapsed, 1e-9)
        left = f", {(self._total - self._done) / rate:,.0f} s left" if 0 < rate and self._done < self._total else ""
        return f"{self._what}: {self._done:,} of {self._total:,}, {rate:,.1f} a second{left}"
