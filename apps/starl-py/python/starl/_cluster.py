"""Does jobs of the command `starl` on a cluster of Ray: `python -m starl._cluster ADDRESS VERSION`.

A job is a line of JSON on standard input, an answer a line of JSON on standard output. After `{"ready": ...}` and for each
job, there is a `{"result": ...}` for each number in any order and then `{"done": {}}`. The process ends when its input does,
also in the middle of a job. `{"error": message}` is the last line of one that cannot continue.
"""

from __future__ import annotations

import json
import os
import queue
import sys
import threading
from typing import IO, Any

from starl import _native
from starl._campaign import _attempt, _shrink
from starl._errors import StarlError
from starl._sweep import _run_on_worker
from starl._work import Worker, connect, on_ray

_WORKERS: dict[str, Worker[Any]] = {"sweep": _run_on_worker, "test": _attempt, "shrink": _shrink}


def main() -> None:
    """Does jobs until there are no more."""
    # Output of Ray does not get among the answers.
    answers = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)
    jobs: queue.SimpleQueue[bytes] = queue.SimpleQueue()
    ended = threading.Event()
    threading.Thread(target=_read, args=(sys.stdin.buffer, jobs, ended), daemon=True).start()
    _, address, version = sys.argv
    try:
        if version != _native.__version__:
            own = f"the package `starl` of {sys.executable} has version {_native.__version__}, and this command {version}"
            raise StarlError(f"{own}; install the wheel of the same version")
        answers.write(b'{"ready":{"processors":%d}}\n' % connect(address))
        while line := jobs.get():
            job = json.loads(line)
            content = json.dumps(job["plan"]).encode()
            for result in on_ray(address, content, {}, _WORKERS[job["work"]], job["numbers"], ended.is_set):
                answers.write(b'{"result":%s}\n' % (result or b"null"))
            answers.write(b'{"done":{}}\n')
    except StarlError as error:
        answers.write(json.dumps({"error": str(error)}).encode() + b"\n")
    except (KeyboardInterrupt, BrokenPipeError):
        # The command was interrupted, and has gone or will go.
        pass


def _read(source: IO[bytes], jobs: queue.SimpleQueue[bytes], ended: threading.Event) -> None:
    for line in source:
        jobs.put(line)
    ended.set()
    jobs.put(b"")


if __name__ == "__main__":
    main()
