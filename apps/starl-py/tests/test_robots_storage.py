"""Variables of robots in Python that outlast a crash, and variables that faults overwrite."""

from typing import Any

import pytest

import starl


class Counter(starl.RobotProgram):
    stable = ("count", "seen")

    def __init__(self) -> None:
        self.count = 0
        self.seen: list[list[int]] = []
        self.calls = 0

    def start(self, robot: starl.RobotHandle) -> None:
        robot.log(f"starts with {self.count} {self.calls} {robot.has_storage}")

    def activate(self, robot: starl.RobotHandle) -> None:
        self.calls += 1
        if self.calls % 2:
            self.count += 1
            self.seen.append([self.count])


def starts(kept: bool, seed: int = 1, loss: float = 0.0) -> list[str]:
    fields: dict[str, Any] = {"storage": {"kept": kept, "loss": loss}} if kept else {}
    scenario = starl.Scenario("race", program=Counter(), robots="create=1", duration="6s", **fields)
    simulation = starl.Simulation(scenario, seed=seed)
    simulation.crash(0, at=2.0)
    simulation.restart(0, at=3.0)
    simulation.crash(0, at=4.0)
    simulation.restart(0, at=5.0)
    simulation.run()
    assert not simulation.report()["failures"]
    texts: list[str] = simulation.records("log").to_polars()["text"].to_list()
    return texts


def test_stable_variables_outlast_crashes() -> None:
    first, second, third = (text.split() for text in starts(kept=True))
    assert first[2:] == ["0", "0", "True"]
    assert 5 <= int(second[2]) <= 20 and second[3] == "0"
    assert int(third[2]) > int(second[2]) and third[3] == "0"


def test_without_storage_nothing_outlasts_a_crash() -> None:
    assert starts(kept=False) == ["starts with 0 0 False"] * 3


def test_storage_may_be_lost() -> None:
    assert starts(kept=True, loss=1.0) == ["starts with 0 0 True"] * 3


def test_snapshots_keep_what_is_stored() -> None:
    scenario = starl.Scenario("race", program=Counter(), robots="create=2", duration="6s", storage={"kept": True})
    digests = set()
    for back in (False, True):
        simulation = starl.Simulation(scenario)
        simulation.crash(0, at=3.0)
        simulation.restart(0, at=3.5)
        simulation.run(2.0)
        kept = simulation.snapshot()
        if back:
            simulation.run(5.0)
            simulation.restore(kept)
        simulation.run()
        digests.add(simulation.digest)
    assert len(digests) == 1


def test_a_stable_variable_must_be_there() -> None:
    class Bad(starl.RobotProgram):
        stable = ("nothing",)

    with pytest.raises(starl.StarlError, match="there is no attribute 'nothing'"):
        starl.Scenario("race", program=Bad())


class Fragile(starl.RobotProgram):
    """Tells when a variable has another type than it had."""

    def __init__(self) -> None:
        self.whole, self.number, self.flag, self.text = 7, 0.25, True, "word"
        self.places = [(1.0, 2.0)]
        self.by_name = {"a": 1}
        self.barrier = starl.Barrier()
        self.before: Any = None

    def activate(self, robot: starl.RobotHandle) -> None:
        values = (self.whole, self.number, self.flag, self.text, self.places, self.by_name)
        if [type(value) for value in values] != [int, float, bool, str, list, dict]:
            robot.fail(f"wrong types: {values}")
        if (self.whole, self.number) != (7, 0.25):
            robot.log(f"overwritten: {values}")
            self.whole, self.number = 7, 0.25


def overwritten(seed: int) -> list[str]:
    scenario = starl.Scenario("race", program=Fragile(), robots="create=3", duration="10s", fault_rates={"corrupt_state": "20/min"})
    simulation = starl.Simulation(scenario, seed=seed)
    simulation.run()
    assert not simulation.report()["failures"]
    texts: list[str] = simulation.records("log").to_polars()["text"].to_list()
    return texts


def test_faults_overwrite_variables_within_their_types() -> None:
    first = overwritten(1)
    assert len(first) > 2 and len(set(first)) == len(first)
    assert first == overwritten(1) != overwritten(2)
