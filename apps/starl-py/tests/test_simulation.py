"""Simulations from Python: the same runs as on the command line, moments, steering, arrays."""

import json
import os
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import starl


@pytest.mark.parametrize("name", ["race", "formation-space"])
@pytest.mark.parametrize("seed", [1, 7])
def test_a_run_has_the_digest_of_the_command(command: str, name: str, seed: int) -> None:
    told = subprocess.run([command, "run", name, "--seed", str(seed), "--json"], capture_output=True, check=False)
    simulation = starl.Simulation(name, seed=seed)
    status = simulation.run()
    assert status.over and simulation.over
    assert simulation.digest == json.loads(told.stdout)["digest"]


def test_the_way_in_which_a_run_is_stepped_changes_nothing() -> None:
    whole, stepped = starl.Simulation("race", seed=3), starl.Simulation("race", seed=3)
    whole.run(4.0)
    while stepped.now < 4.0:
        stepped.step()
    assert whole.digest == stepped.digest
    assert np.array_equal(whole.poses, stepped.poses)


def test_a_snapshot_is_gone_back_to_exactly() -> None:
    simulation = starl.Simulation("race", seed=3)
    simulation.run(2.0)
    kept = simulation.snapshot()
    simulation.run(5.0)
    first = simulation.digest, simulation.poses.copy(), len(simulation.records())
    simulation.restore(kept)
    assert simulation.now == kept.now == pytest.approx(2.0)
    simulation.run(5.0)
    assert simulation.digest == first[0]
    assert np.array_equal(simulation.poses, first[1])
    assert len(simulation.records()) == first[2]
    with pytest.raises(ValueError, match="another simulation"):
        starl.Simulation("race").restore(kept)


def test_arrays_are_views_that_steps_overwrite() -> None:
    simulation = starl.Simulation("race")
    poses, velocities = simulation.poses, simulation.velocities
    assert poses.shape == (4, 7) and simulation.estimates.shape == (4, 7) and velocities.shape == (4, 6)
    before = poses.copy()
    simulation.run(3.0)
    assert not np.array_equal(poses, before)
    assert np.shares_memory(poses, simulation.poses)
    with pytest.raises(ValueError):
        poses[0, 0] = 1.0


def test_orientations_are_unit_quaternions_that_agree_with_the_records() -> None:
    simulation = starl.Simulation("race")
    simulation.run(3.0)
    quaternions = simulation.poses[:, 3:]
    assert np.allclose(np.linalg.norm(quaternions, axis=1), 1.0)
    x, y, z, w = quaternions.T
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    recorded = simulation.records("pose").to_numpy()
    for robot in range(4):
        last = np.flatnonzero(recorded["robot"] == robot)[-1]
        if recorded["time"][last] == pytest.approx(simulation.now):
            assert yaw[robot] == pytest.approx(recorded["yaw"][last])


def test_steering_acts_and_is_in_the_scenario() -> None:
    simulation = starl.Simulation("race", seed=7)
    simulation.crash(0, at=1.0)
    simulation.restart(0, at=3.0)
    simulation.partition([0, 1], [2, 3], at=4.0)
    simulation.heal(at=5.0)
    simulation.run(2.0)
    assert simulation.robot(0)["condition"] == "down"
    assert simulation.robot(simulation.robots[0].name) == simulation.robot(0)
    simulation.run(6.0)
    faults = simulation.records("fault").to_polars()["text"].to_list()
    assert len(faults) == 4
    again = starl.Simulation(starl.Scenario.from_text(simulation.scenario()))
    again.run(6.0)
    assert again.digest == simulation.digest


def test_robots_that_join_give_new_arrays() -> None:
    simulation = starl.Simulation("race")
    old = simulation.poses
    pose = {"position": {"x": 5.0, "y": 5.0, "z": 0.0}, "yaw": 0.0, "pitch": 0.0, "roll": 0.0}
    simulation.apply({"join": {"like": 0, "name": "late", "pose": pose}})
    simulation.run(1.0)
    assert old.shape == (4, 7)
    assert simulation.poses.shape == (5, 7)


def test_other_threads_run_while_a_simulation_does() -> None:
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    # On a busy machine the other thread may rest through a whole run.
    most = 0
    for seed in range(1, 200):
        simulation = starl.Simulation("flocking", seed=seed)
        before = counted
        simulation.run(60.0)
        most = max(most, counted - before)
        if most > 3:
            break
    done.set()
    thread.join()
    assert most > 3


def test_ctrl_c_ends_a_run_between_two_steps() -> None:
    # It simulates ten hours, whatever its robots reach.
    simulation = starl.Simulation(starl.Scenario("flocking", duration="10h", goal="duration"))
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    now = simulation.now
    assert simulation.step().now > now


def test_records_can_be_chosen() -> None:
    simulation = starl.Simulation("race", records=["action"])
    simulation.run(3.0)
    assert len(simulation.records("action")) > 0
    assert len(simulation.records()) == len(simulation.records("action"))
    with pytest.raises(starl.StarlError, match="there is no topic"):
        starl.Simulation("race", records=["actions"])
    with pytest.raises(ValueError, match="the topics are"):
        simulation.records("actions")
