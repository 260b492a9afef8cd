"""`starl test --cluster` and `starl sweep --cluster`: the command's results, with the runs made on a cluster of Ray."""

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import polars
import pytest
from ray.cluster_utils import Cluster
from test_sweep import BROKEN


def free_port() -> int:
    """A port that is free, and not among those that Ray gives to workers."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port: int = one.getsockname()[1]
    return port


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """A head without work that takes clients, and two nodes of one core each."""
    port = free_port()
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "ray_client_server_port": port})
    cluster.add_node(num_cpus=1)
    cluster.client = f"ray://127.0.0.1:{port}"  # type: ignore[attr-defined]
    yield cluster
    cluster.shutdown()  # type: ignore[no-untyped-call]


def run(command: str, folder: Path, *arguments: str, cluster: str | None = None) -> subprocess.CompletedProcess[str]:
    """Runs the command in a folder."""
    where = ["--cluster", cluster, "--python", sys.executable] if cluster else []
    return subprocess.run([command, *arguments, *where], cwd=folder, capture_output=True, text=True, timeout=240)


def report(done: subprocess.CompletedProcess[str]) -> dict[str, Any]:
    """The report in JSON, without what differs from machine to machine."""
    assert done.stdout, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    assert found.pop("runs_per_second", 1) > 0
    for key in ("wall_seconds", "processor_seconds", "threads", "runs_per_processor_second"):
        found.pop(key, None)
    return found


@pytest.fixture
def folders(tmp_path: Path) -> tuple[Path, Path]:
    """Two folders with the same broken program."""
    both = (tmp_path / "here", tmp_path / "there")
    for folder in both:
        folder.mkdir()
        (folder / "broken.starl").write_text(BROKEN)
    return both


TEST = ["test", "race", "broken.starl", "--profile", "calm,lossy,crashes", "--seeds", "6", "--duration", "20s", "--shrink", "60", "--json"]


def test_a_test_gives_the_same_report_and_files(command: str, cluster: Any, folders: tuple[Path, Path]) -> None:
    here, there = folders
    alone = run(command, here, *TEST)
    shared = run(command, there, *TEST, cluster=cluster.client)
    assert (alone.returncode, shared.returncode) == (1, 1), shared.stderr
    assert report(shared) == report(alone)
    files = sorted(path.name for path in here.iterdir())
    assert files == sorted(path.name for path in there.iterdir())
    assert len(files) == 3
    for name in files:
        assert (here / name).read_bytes() == (there / name).read_bytes()
    [scenario] = there.glob("*.toml")
    again = run(command, there, "run", scenario.name, "--quiet")
    assert again.returncode == 1 and "Broken.alone" in again.stdout


def test_the_summary_for_people_names_the_cluster(command: str, cluster: Any, tmp_path: Path) -> None:
    done = run(command, tmp_path, "test", "race", "--profile", "calm", "--seeds", "1", cluster=cluster.address)
    assert done.returncode == 0, done.stderr
    assert f"on the cluster {cluster.address} with 1 processor" in done.stdout


def test_a_killed_node_changes_nothing(command: str, cluster: Any, tmp_path: Path) -> None:
    sweep = ["sweep", "race", "--set", "network.loss=0..0.6:4", "--seeds", "30"]
    alone = run(command, tmp_path, *sweep, "--out", "alone.csv")
    assert alone.returncode == 0, alone.stderr
    doomed = cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    out = tmp_path / "shared.csv"
    journal = Path(f"{out}.journal")
    killed: list[int] = []

    def kill() -> None:
        # In the middle: the first rows are here, and not the last.
        while not (journal.exists() and journal.read_bytes().count(b"\n") > 10):
            time.sleep(0.02)
        cluster.remove_node(doomed, allow_graceful=False)
        killed.append(journal.read_bytes().count(b"\n"))

    thread = threading.Thread(target=kill, daemon=True)
    thread.start()
    shared = run(command, tmp_path, *sweep, "--out", out.name, cluster=cluster.address)
    thread.join(timeout=30)
    assert shared.returncode == 0, shared.stderr
    assert killed and killed[0] < 120
    rows = [polars.read_csv(tmp_path / name) for name in ("alone.csv", "shared.csv")]
    assert rows[0].equals(rows[1])


def tasks_of(node: Any) -> list[str]:
    """The tasks that the processes of a node are at work on, as Ray titles them: `ray::NAME`."""
    [raylet] = node.all_processes["raylet"]
    titles = []
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            if f"\nPPid:\t{raylet.process.pid}\n" in status.read_text():
                titles.append(status.with_name("cmdline").read_text().split("\0")[0])
        except OSError:
            pass
    return [title for title in titles if title.startswith("ray::") and "IDLE" not in title]


@pytest.mark.parametrize("task", ["attempt", "shrink"])
def test_a_node_killed_in_a_test_changes_nothing(command: str, cluster: Any, folders: tuple[Path, Path], task: str) -> None:
    here, there = folders
    arguments = ["test", "race", "broken.starl", "--profile", "calm,lossy,crashes", "--seeds", "40", "--json"]
    alone = run(command, here, *arguments)
    cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    killed: list[Any] = []
    ended = threading.Event()

    def kill() -> None:
        while not killed and not ended.is_set():
            killed.extend(node for node in cluster.worker_nodes if any(task in title for title in tasks_of(node)))
        for node in killed[:1]:
            cluster.remove_node(node, allow_graceful=False)

    thread = threading.Thread(target=kill)
    thread.start()
    try:
        shared = run(command, there, *arguments, cluster=cluster.address)
    finally:
        ended.set()
        thread.join()
    assert killed, "no node was at work"
    assert (alone.returncode, shared.returncode) == (1, 1), shared.stderr
    assert report(shared) == report(alone)
    assert {path.name: path.read_bytes() for path in there.iterdir()} == {
        path.name: path.read_bytes() for path in here.iterdir()
    }


def test_an_interrupted_sweep_keeps_its_rows_and_goes_on(command: str, cluster: Any, tmp_path: Path) -> None:
    sweep = [command, "sweep", "race", "--seeds", "200", "--out", "rows.csv", "--cluster", cluster.address, "--python", sys.executable]
    journal = tmp_path / "rows.csv.journal"
    process = subprocess.Popen(sweep, cwd=tmp_path, stdout=subprocess.PIPE, text=True, start_new_session=True)
    while process.poll() is None and not (journal.exists() and journal.read_bytes().count(b"\n") > 5):
        time.sleep(0.02)
    # As a terminal does for Ctrl-C: to the command, and to the interpreter that it has started.
    os.killpg(process.pid, signal.SIGINT)
    told = process.communicate(timeout=30)[0]
    assert process.returncode == 1, told
    with pytest.raises(ProcessLookupError):
        os.killpg(process.pid, 0)
    kept = journal.read_bytes().count(b"\n") - 1
    assert 5 <= kept < 200
    again = subprocess.run(sweep, cwd=tmp_path, capture_output=True, text=True, timeout=240)
    assert again.returncode == 0, again.stderr
    assert f"{kept} were done before" in again.stdout
    assert polars.read_csv(tmp_path / "rows.csv")["number"].to_list() == list(range(200))


#: An interpreter without the package.
BARE = getattr(sys, "_base_executable", sys.executable)


@pytest.mark.parametrize(
    ("python", "address", "message"),
    [
        ("/nowhere/python", "ray", "/nowhere/python cannot be started: there is no such file or folder"),
        (BARE, "ray", "No module named 'starl'"),
        (sys.executable, "ray://127.0.0.1:9", "cannot be reached"),
        (sys.executable, "nonsense", "cannot be reached: Invalid address"),
    ],
)
def test_what_is_missing_is_said(command: str, tmp_path: Path, python: str, address: str, message: str) -> None:
    arguments = [command, "test", "race", "--seeds", "1", "--cluster", address]
    environment = {**os.environ, "STARL_PYTHON": python}
    environment.pop("PYTHONPATH", None)
    done = subprocess.run(arguments, cwd=tmp_path, capture_output=True, text=True, timeout=120, env=environment)
    assert done.returncode == 2
    assert message in done.stderr and "--cluster" in done.stderr
    assert done.stderr.count("\n") == 1


def test_another_version_is_refused() -> None:
    done = subprocess.run([sys.executable, "-m", "starl._cluster", "ray", "9.9.9"], capture_output=True, text=True, timeout=60)
    message = json.loads(done.stdout)["error"]
    assert "this command 9.9.9; install the wheel of the same version" in message


def test_threads_and_a_cluster_exclude_each_other(command: str, tmp_path: Path) -> None:
    done = run(command, tmp_path, "test", "race", "--threads", "2", cluster="ray")
    assert done.returncode == 2 and "--threads" in done.stderr
