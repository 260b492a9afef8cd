"""Sweeps and campaigns on a cluster of Ray, of which a node is killed: the same results as on one core."""

import logging
import socket
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest
import ray
from ray.cluster_utils import Cluster

import starl
from starl._work import connect


@pytest.fixture
def cluster() -> Iterator[Any]:
    """A head without work, and two nodes of one core each."""
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
    cluster.add_node(num_cpus=1)
    ray.init(address=cluster.address, log_to_driver=False, logging_level=logging.ERROR)
    yield cluster
    ray.shutdown()
    cluster.shutdown()  # type: ignore[no-untyped-call]


def test_a_killed_node_changes_nothing(cluster: Any) -> None:
    axes = {"network.loss": "0..0.6:4"}
    alone = starl.sweep("race", axes, seeds=10, threads=1)
    doomed = cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    killed = threading.Event()

    def kill() -> None:
        # In the middle: the cluster has begun to work.
        time.sleep(3.0)
        cluster.remove_node(doomed, allow_graceful=False)
        killed.set()

    thread = threading.Thread(target=kill)
    thread.start()
    begun = time.monotonic()
    runs = 0
    while not killed.is_set() or runs == 0:
        shared = starl.sweep("race", axes, seeds=10, cluster="ray")
        assert shared.rows.to_polars().equals(alone.rows.to_polars())
        runs += 1
        assert time.monotonic() - begun < 120
    thread.join()


def test_a_campaign_on_a_cluster_shrinks_its_failures_there(cluster: Any) -> None:
    from test_sweep import BROKEN

    scenario = starl.Scenario(program=starl.Program(BROKEN), robots="create=3", duration="20s")
    about: dict[str, Any] = {"profiles": ["calm", "lossy"], "seeds": 2, "shrink": 2, "most_trials": 40}
    shared = starl.test(scenario, cluster="ray", **about)
    assert shared.failures and shared.failures[1].scenario
    assert shared == starl.test(scenario, threads=1, **about)


def test_an_error_of_a_worker_is_one_message(cluster: Any) -> None:
    from starl import _work

    def fail(plan: _work.Plan, numbers: list[int]) -> list[int]:
        raise ValueError("the work cannot be done")

    with pytest.raises(starl.StarlError, match="the work cannot be done"):
        list(_work.on_ray("ray", b"", {}, fail, [1, 2]))


def test_a_client_that_the_cluster_could_not_serve_at_first_is_tried_again(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[str] = []

    def init(address: str, **_: Any) -> None:
        tried.append(address)
        if len(tried) == 1:
            # Ray raises this when the cluster could not start a process for the client.
            raise ConnectionAbortedError("Initialization failure from server: starting a server failed")

    monkeypatch.setattr(ray, "init", init)
    monkeypatch.setattr(ray, "is_initialized", lambda: len(tried) > 1)
    monkeypatch.setattr(ray, "cluster_resources", lambda: {"CPU": 2.0})
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"ray://127.0.0.1:{server.getsockname()[1]}"
        assert connect(address) == 2
    assert tried == [address, address]
