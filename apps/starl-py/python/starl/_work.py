"""Many independent pieces of work: on threads or processes of this machine or on a cluster of Ray, with progress."""

from __future__ import annotations

import logging
import multiprocessing
import os
import pickle
import socket
import sys
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeVar
from urllib.parse import urlsplit

from starl import _native
from starl._errors import StarlError

Result = TypeVar("Result")

#: A piece of work of the cluster should last about this long, so that its overhead does not count.
_BATCH_SECONDS = 0.5
_MOST_IN_BATCH = 500


@dataclass(frozen=True)
class Plan:
    """What another process needs to know to do a piece of work by its number."""

    version: str
    content: bytes
    #: The programs in Python by name, pickled.
    programs: bytes

    @classmethod
    def of(cls, content: bytes, programs: Mapping[str, Any], dumps: Callable[[Any], bytes]) -> Plan:
        """A plan of the native module. `dumps` pickles the programs."""
        try:
            return cls(_native.__version__, content, dumps(dict(programs)))
        except Exception as error:
            raise StarlError(f"a program in Python cannot be sent to other processes: {error}") from None

    def load(self) -> dict[str, Any]:
        """The programs."""
        if self.version != _native.__version__:
            message = f"a worker has version {_native.__version__} of the package `starl`, and the plan is of {self.version}"
            raise StarlError(f"{message}; install the same wheel everywhere")
        programs: dict[str, Any] = pickle.loads(self.programs)
        return programs


#: Does the work of some numbers of a plan in another process.
Worker = Callable[[Plan, list[int]], list[Result]]


def on_threads(
    work: Callable[[int], Result], numbers: list[int], threads: int | None, stop: Callable[[bool], None]
) -> Iterator[Result]:
    """Does the work of each number on threads of this process, and gives results as they come. The native module does
    the work without Python's lock, except in programs in Python. When the caller ends early, `stop` ends what is under
    way."""
    stop(False)
    with ThreadPoolExecutor(_count(threads, "threads")) as pool:
        try:
            yield from _on(pool, work, numbers, threads)
        except BaseException:
            stop(True)
            raise


def on_processes(plan: Plan, worker: Worker[Result], numbers: list[int], processes: int) -> Iterator[Result]:
    """Does the work of each number on processes of this machine."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(_count(processes, "processes"), context) as pool:
        try:
            for results in _on(pool, _Call(plan, worker), numbers, processes):
                yield from results
        except BrokenProcessPool:
            message = "a process has ended unexpectedly; a script that uses processes needs `if __name__ == \"__main__\":`"
            raise StarlError(f"{message} around what it does") from None


@dataclass(frozen=True)
class _Call:
    plan: Plan
    worker: Worker[Any]

    def __call__(self, number: int) -> list[Any]:
        return self.worker(self.plan, [number])


def _count(asked: int | None, what: str) -> int:
    if asked is not None and (not hasattr(asked, "__index__") or asked < 1):
        raise StarlError(f"{asked!r} {what}: give at least 1")
    return asked or os.cpu_count() or 1


def _on(pool: Executor, work: Callable[[int], Result], numbers: list[int], count: int | None) -> Iterator[Result]:
    ahead = iter(numbers)
    pending: set[Future[Result]] = {pool.submit(work, number) for number in islice(ahead, 2 * (count or os.cpu_count() or 1))}
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
        raise


def unreachable(address: str, error: Exception) -> StarlError:
    """The error of a cluster that cannot be reached."""
    reason = (str(error).strip().splitlines() or [type(error).__name__])[-1].strip().rstrip(".")
    hint = "; start one with `ray start --head`, or use \"local\" for one of this process" if address == "ray" else ""
    return StarlError(f"the cluster of Ray {address!r} cannot be reached: {reason}{hint}")


def connect(address: str) -> int:
    """Connects this process to a cluster of Ray, unless it is connected to one, and gives the number of its processors.
    "ray" is the cluster that RAY_ADDRESS names or that runs on this machine, "local" one that is started here."""
    try:
        import ray
    except ImportError:
        raise StarlError("a cluster needs Ray: pip install 'starl[ray]'") from None

    place = urlsplit(address if "://" in address else f"//{address}")
    named = {"ray": "auto", "local": None}.get(address, address)
    # A cluster that takes clients sometimes fails to start the process for one, and says so by a broken connection.
    pauses = [1.0, 3.0] if place.scheme == "ray" else []
    while not ray.is_initialized():
        try:
            # Ray itself would try for minutes.
            if place.port:
                socket.create_connection((place.hostname, place.port), timeout=5.0).close()
        except (OSError, ValueError) as error:
            raise unreachable(address, error) from None
        try:
            ray.init(address=named, log_to_driver=False, logging_level=logging.ERROR)
        except (OSError, RuntimeError, ValueError, ImportError) as error:
            if not pauses:
                raise unreachable(address, error) from None
            time.sleep(pauses.pop(0))
    resources: dict[str, float] = ray.cluster_resources()  # type: ignore[no-untyped-call]
    return int(resources.get("CPU", 0))


def on_ray(
    address: str,
    content: bytes,
    programs: Mapping[str, Any],
    worker: Worker[Result],
    numbers: list[int],
    ended: Callable[[], bool] = lambda: False,
) -> Iterator[Result]:
    """Does the work on a cluster of Ray, in batches, and gives results as they come. What was under way on a node that dies
    is done again elsewhere; results do not depend on it, since the same number gives the same result everywhere. Stops early when
    `ended` says so."""
    connect(address)
    import ray
    from ray import cloudpickle, exceptions

    shared = ray.put(Plan.of(content, programs, cloudpickle.dumps))
    # Ray itself retries what a dead worker was doing, without end; results lost with a node come here as errors.
    remote = ray.remote(num_cpus=1, max_retries=-1)(worker)
    ahead = deque(numbers)
    under_way: dict[Any, tuple[list[int], float]] = {}
    size = 1
    while (ahead or under_way) and not ended():
        cpus = max(1, connect(address))
        while ahead and len(under_way) < 2 * cpus:
            batch = [ahead.popleft() for _ in range(min(size, max(1, len(ahead) // cpus), len(ahead)))]
            under_way[remote.remote(shared, batch)] = (batch, time.monotonic())
        ready, _ = ray.wait(list(under_way), timeout=1.0)
        for reference in ready:
            batch, begun = under_way.pop(reference)
            try:
                results = ray.get(reference)
            except (exceptions.WorkerCrashedError, exceptions.ObjectLostError, exceptions.NodeDiedError):
                ahead.extendleft(reversed(batch))
                continue
            except exceptions.RayTaskError as error:
                raise StarlError(str(error.cause or error)) from None
            except ConnectionError as error:
                raise StarlError(f"the connection to the cluster is lost: {error}") from None
            yield from results
            each = (time.monotonic() - begun) / len(batch) / 2
            size = max(1, min(_MOST_IN_BATCH, int(_BATCH_SECONDS / max(each, 1e-6))))


class Progress:
    """How far long work is, with the time left, on one line of the error stream if that is a terminal, and in notebooks."""

    def __init__(self, what: str, total: int, done: int, shown: bool | None) -> None:
        self._what, self._total, self._begun_with, self._done = what, total, done, done
        self._shown = sys.stderr.isatty() if shown is None else shown
        self._begun = time.monotonic()
        self._told = 0.0

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


def run_all(
    work: Callable[[int], Result],
    worker: Worker[Result],
    content: Callable[[], bytes],
    programs: Mapping[str, Any],
    numbers: list[int],
    *,
    threads: int | None,
    processes: int | None,
    cluster: str | None,
    stop: Callable[[bool], None] = lambda stop: None,
) -> Iterator[Result]:
    """Does the work of each number where it was asked for: by `work` on threads of this process, or by `worker` in others,
    which get the plan that `content` gives."""
    given = [name for name, value in [("threads", threads), ("processes", processes), ("cluster", cluster)] if value is not None]
    if len(given) > 1:
        raise StarlError(f"{' and '.join(given)}: give one of them")
    if cluster is not None:
        if not isinstance(cluster, str):
            raise StarlError(f'cluster: {cluster!r} is not an address; give "ray", "local" or "ray://HOST:PORT"')
        return on_ray(cluster, content(), programs, worker, numbers)
    if processes is not None:
        return on_processes(Plan.of(content(), programs, pickle.dumps), worker, numbers, processes)
    return on_threads(work, numbers, threads, stop)
