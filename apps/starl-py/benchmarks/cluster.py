"""Measures sweeps on a local cluster of Ray: throughput against workers, and what a run costs beside the run itself.
`python apps/starl-py/benchmarks/cluster.py --workers 1,2,4`
"""

from __future__ import annotations

import argparse
import logging
import time

import ray
from ray.cluster_utils import Cluster

import starl


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", default="1,2,4")
    parser.add_argument("--target", default="race")
    parser.add_argument("--seeds", type=int, default=400)
    arguments = parser.parse_args()
    for threads in (1, 2):
        begun = time.monotonic()
        starl.sweep(arguments.target, seeds=arguments.seeds, threads=threads)
        print(f"threads {threads}: {arguments.seeds / (time.monotonic() - begun):.0f} runs a second")
    for workers in map(int, arguments.workers.split(",")):
        cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
        for _ in range(workers):
            cluster.add_node(num_cpus=1)
        ray.init(address=cluster.address, log_to_driver=False, logging_level=logging.ERROR)
        # Workers start, and compile the program.
        starl.sweep(arguments.target, seeds=20 * workers, cluster="ray")
        begun = time.monotonic()
        starl.sweep(arguments.target, seeds=arguments.seeds, cluster="ray")
        print(f"Ray, {workers} workers: {arguments.seeds / (time.monotonic() - begun):.0f} runs a second")
        ray.shutdown()
        cluster.shutdown()


if __name__ == "__main__":
    main()
