"""Properties of programs in Python, and their violations in sweeps and campaigns, shrunk."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from programs_of_tests import Hasty

import starl


def hasty(robots: int = 4, **fields: Any) -> starl.Scenario:
    return starl.Scenario(program=Hasty(), robots=f"create={robots}", duration="20s", **fields)


def verdicts(simulation: starl.Simulation) -> dict[str, str]:
    own = [one for one in simulation.report()["properties"] if one["property"].startswith(tuple("ABCDEFGHIJKLMNOPQRSTUVWXYZ"))]
    return {one["property"]: one["verdict"] for one in own}


def test_a_violation_has_its_time_and_its_text() -> None:
    simulation = starl.Simulation(hasty())
    simulation.run()
    assert simulation.outcome == "violated"
    [violation] = simulation.report()["violations"]
    assert violation["property"] == "Hasty.shy"
    assert re.fullmatch(r"robot \d has heard [56]", violation["text"])
    assert 0.0 < violation["at"] < 5.0
    assert verdicts(simulation) == {"Hasty.shy": "violated", "Hasty.all_spoke": "holds"}


def test_a_property_that_holds_is_reported_as_such() -> None:
    simulation = starl.Simulation(hasty(network={"loss": 1.0}))
    simulation.run()
    assert simulation.outcome == "reached"
    assert verdicts(simulation) == {"Hasty.shy": "holds", "Hasty.all_spoke": "holds"}


@pytest.mark.parametrize("seed", [1, 5])
def test_violations_come_again_after_a_snapshot(seed: int) -> None:
    def seen(back: bool) -> tuple[str, list[dict[str, Any]]]:
        simulation = starl.Simulation(hasty(network={"loss": 0.2}), seed=seed)
        if back:
            kept = simulation.snapshot()
            simulation.run(3.0)
            simulation.restore(kept)
        simulation.run()
        return simulation.digest, simulation.report()["violations"]

    assert seen(False) == seen(True) and seen(False)[1]


class Properties(starl.RobotProgram):
    """Stands still, under properties of all kinds."""

    def __init__(self) -> None:
        self.passes = 0

    def activate(self, robot: starl.RobotHandle) -> None:
        self.passes += 1

    @starl.invariant
    def raises(fleet: starl.Fleet["Properties"]) -> bool:
        return fleet.now < 1.0 or 1 // 0 == 0

    @starl.invariant
    def comes_and_goes(fleet: starl.Fleet["Properties"]) -> bool:
        return int(fleet.now) % 2 == 0

    @starl.eventually(within=2.0)
    def never(fleet: starl.Fleet["Properties"]) -> bool:
        return not fleet.members

    @starl.eventually(within=1000.0)
    def later(fleet: starl.Fleet["Properties"]) -> bool:
        return not fleet.members

    @starl.invariant
    def sees_all(fleet: starl.Fleet["Properties"]) -> bool:
        one = fleet.members[-1]
        whole = len(fleet.members) == 3 and one.id == 2 and len(one.position) == 3 and not one.finished
        return whole and (one.up or 3.0 <= fleet.now <= 4.1)

    @starl.eventually(within=3.5)
    def sees_a_crash(fleet: starl.Fleet["Properties"]) -> bool:
        return not fleet.members[-1].up and fleet.undisturbed < 0.2


def test_every_kind_of_property() -> None:
    scenario = starl.Scenario(program=Properties(), robots="create=3", duration="5s")
    simulation = starl.Simulation(scenario)
    simulation.crash(2, at=3.0)
    simulation.restart(2, at=4.0)
    simulation.run()
    found = [(one["property"], one["at"], one["text"]) for one in simulation.report()["violations"]]
    by_name = {name: [(at, text) for own, at, text in found if own == name] for name, *_ in found}
    assert "ZeroDivisionError" in by_name["Properties.raises"][0][1]
    assert "test_robots_properties.py:" in by_name["Properties.raises"][0][1]
    assert [round(at, 1) for at, _ in by_name["Properties.comes_and_goes"]] == [1.0, 3.0, 5.0]
    [(at, text)] = by_name["Properties.never"]
    assert 2.0 < at < 2.1 and text == "not within 2s: is not true"
    assert set(by_name) == {"Properties.raises", "Properties.comes_and_goes", "Properties.never"}, found
    assert verdicts(simulation)["Properties.later"] == "open"


@pytest.fixture(scope="module")
def alone() -> starl.CampaignResults:
    return starl.test(hasty(), profiles=["calm", "lossy"], seeds=2, shrink=1, most_trials=40, threads=1)


def test_a_campaign_shrinks_violations_of_programs_in_python(alone: starl.CampaignResults) -> None:
    assert len(alone.runs) == 4
    first = alone.failures[0]
    assert first.wrong == "Hasty.shy" and first.scenario and first.after and first.before
    assert first.after["robots"] < 4 and first.after["duration_seconds"] < 20
    again = starl.Simulation(starl.Scenario.from_text(first.scenario, program=Hasty()))
    again.run()
    assert [one["property"] for one in again.report()["violations"]][:1] == ["Hasty.shy"]


@pytest.mark.parametrize("where", [{"threads": 3}, {"processes": 2}])
def test_threads_and_processes_change_nothing(alone: starl.CampaignResults, where: dict[str, Any]) -> None:
    assert starl.test(hasty(), profiles=["calm", "lossy"], seeds=2, shrink=1, most_trials=40, **where) == alone
    axes = {"network.loss": [0.0, 0.3]}
    one = starl.sweep(hasty(), axes, seeds=2, threads=1).rows.to_polars()
    assert starl.sweep(hasty(), axes, seeds=2, **where).rows.to_polars().equals(one)
    assert set(one["violated"].to_list()) == {"Hasty.shy"}


@pytest.fixture
def cluster(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    import ray
    from ray.cluster_utils import Cluster

    # Workers import the module of the program.
    monkeypatch.setenv("PYTHONPATH", __file__.rpartition("/")[0])
    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 2})
    ray.init(address=cluster.address, log_to_driver=False)
    yield
    ray.shutdown()
    cluster.shutdown()  # type: ignore[no-untyped-call]


def test_a_cluster_changes_nothing(alone: starl.CampaignResults, cluster: None) -> None:
    shared = starl.test(hasty(), profiles=["calm", "lossy"], seeds=2, shrink=1, most_trials=40, cluster="ray")
    assert shared == alone


def test_a_program_that_cannot_be_sent_is_refused() -> None:
    class Local(starl.RobotProgram):
        pass

    scenario = starl.Scenario(program=Local(), robots="create=1", duration="1s")
    with pytest.raises(starl.StarlError, match="cannot be sent to other processes"):
        starl.sweep(scenario, seeds=1, processes=2)
    with pytest.raises(starl.StarlError, match="threads and cluster: give one of them"):
        starl.sweep(scenario, seeds=1, threads=1, cluster="ray")
