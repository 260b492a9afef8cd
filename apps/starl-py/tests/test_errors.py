"""Wrong arguments give one clear exception each."""

import copy
import math
import pickle
import subprocess
import sys
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import starl


def race() -> Any:
    """A simulation, without the types that the calls below ignore on purpose."""
    return starl.Simulation("race", seed=7)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: race().run(until=math.nan), "until: nan is not a time"),
        (lambda: race().run(until=math.inf), "until: inf is not a time"),
        (lambda: race().run(until=-1), "until: -1 is not a time"),
        (lambda: race().run(until="5"), "until: '5' is not a time"),
        (lambda: race().run(steps=-1), "steps: -1 is less than 0"),
        (lambda: race().step(-1), "steps: -1 is less than 0"),
        (lambda: race().crash(), "at least one robot"),
        (lambda: race().crash(-1), "there is no robot -1"),
        (lambda: race().crash(1.5), "there is no robot 1.5"),
        (lambda: race().robot("robot7"), "one of the names iRobot0, iRobot1, quadcopter0"),
        (lambda: race().crash(4), "there is no robot 4; the fleet has 4"),
        (lambda: race().crash(1, at=math.nan), "not finite"),
        (lambda: race().push(0, (math.nan, 1)), "is not a point"),
        (lambda: race().push(0, "ab"), "is not a point"),
        (lambda: race().apply({"leave": [object()]}), "is not a number, a text, a list or a dictionary"),
        (lambda: race().records("poses"), 'there is no topic "poses"; the topics are pose'),
        (lambda: race().restore(None), "None is not a snapshot"),
        (lambda: race().restore(race().snapshot()), "the snapshot is one of another simulation"),
        (lambda: starl.Simulation(None), "None is not a scenario"),  # type: ignore[arg-type]
        (lambda: starl.sweep(7), "7 is not a scenario"),  # type: ignore[arg-type]
        (lambda: starl.test([]), r"\[\] is not a scenario"),  # type: ignore[arg-type]
        (lambda: starl.Scenario("race", robots=3), 'robots: 3 is not a fleet; write it as "create=4"'),  # type: ignore[arg-type]
        (lambda: starl.sweep("race", ["network.loss"]), "set: .* is not a dictionary"),  # type: ignore[arg-type]
        (lambda: starl.sweep("race", cluster=5), "cluster: 5 is not an address"),  # type: ignore[arg-type]
        (lambda: starl.sweep("race", threads="2"), "'2' threads: give at least 1"),  # type: ignore[arg-type]
        (lambda: starl.test("race", seeds="5"), "seeds: '5' is not a whole number"),  # type: ignore[arg-type]
        (lambda: starl.test("race", shrink=-1), "shrink: -1 is not a whole number from 0"),
        (lambda: starl.test("race", most_trials=-1), "most_trials: -1 is not a whole number from 0"),
        (lambda: starl.Scenario("race", program=starl.RobotProgram), r"give an object, `RobotProgram\(\.\.\.\)`"),  # type: ignore[arg-type]
        (lambda: starl.Scenario("race", program=7), "program: 7 is not a program"),  # type: ignore[arg-type]
        (lambda: starl.Scenario.from_text(b""), "a scenario is a str, not bytes"),  # type: ignore[arg-type]
        (lambda: starl.Program(None), "a program is a str, not NoneType"),  # type: ignore[arg-type]
        (lambda: starl.Program("program A\n\udc80"), r"not Unicode in line 2: '\\udc80'"),
    ],
)
def test_a_wrong_argument_is_named(call: Callable[[], object], message: str) -> None:
    with pytest.raises(starl.StarlError, match=message):
        call()


def test_numbers_of_numpy_are_numbers() -> None:
    numbers, plain = race(), race()
    for simulation, kind in [(numbers, np.int64), (plain, int)]:
        simulation.run(until=np.float32(2.0) if kind is np.int64 else 2.0)
        simulation.crash(kind(1), at=float(kind(3)))
        simulation.push(kind(0), np.array([0.1, 0.0, 0.0]))
        simulation.run(steps=kind(300))
    assert numbers.digest == plain.digest


def test_one_profile_may_be_given_by_its_name() -> None:
    found = starl.test("race", seeds=np.int64(2), profiles="calm")  # type: ignore[arg-type]
    assert [(run["profile"], run["seed"]) for run in found.runs] == [("calm", 1), ("calm", 2)]


def test_one_topic_may_be_given_by_its_name() -> None:
    simulation = starl.Simulation("race", records="action")
    simulation.run()
    assert len(simulation.records("action")) and not len(simulation.records("pose"))


@pytest.mark.parametrize("copied", [copy.deepcopy, copy.copy, pickle.dumps])
def test_a_simulation_is_not_copied_by_accident(copied: Callable[[object], object]) -> None:
    with pytest.raises(TypeError, match=r"`snapshot\(\)`, or send its scenario and seed"):
        copied(race())


def test_scenarios_programs_and_errors_travel() -> None:
    scenario = starl.Scenario("race", network={"loss": 0.1})
    for copied in (pickle.loads(pickle.dumps(scenario)), copy.deepcopy(scenario)):
        assert copied.text() == scenario.text()
    with pytest.raises(starl.StarlError) as refused:
        scenario.with_(network={"loss": 2})
    again = pickle.loads(pickle.dumps(refused.value))
    assert (str(again), again.diagnostics) == (str(refused.value), refused.value.diagnostics)


def test_a_plot_before_the_first_step_warns_of_nothing() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        race().plot()


@pytest.mark.parametrize(
    ("package", "use", "extra"),
    [
        ("matplotlib", "simulation.plot()", "plot"),
        ("polars", "simulation.records('pose').to_polars()", "frames"),
        ("gymnasium", "import starl.env", "env"),
        ("pettingzoo", "import starl.env", "env"),
    ],
)
def test_a_missing_package_is_named_with_its_extra(package: str, use: str, extra: str) -> None:
    script = f"import sys; sys.modules[{package!r}] = None; import starl; simulation = starl.Simulation('race'); {use}"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert f"ModuleNotFoundError: this needs {package}: pip install 'starl[{extra}]'" in done.stderr
