"""Scenarios and programs, and what is wrong with them."""

from pathlib import Path

import pytest

import starl

HELLO = """program Hello

moved: Bool = false

go()
    pre not moved
    eff moved = true
"""


def test_examples_have_names_and_summaries() -> None:
    found = starl.examples()
    assert "race" in found and all(found.values())


def test_errors_name_line_and_field() -> None:
    with pytest.raises(starl.StarlError) as caught:
        starl.Scenario.from_text('title = "T"\n[network]\nloss = 7\n[[robots]]\nmodel = "create"\n')
    fields = {(one.line, one.field) for one in caught.value.diagnostics}
    assert (3, "network.loss") in fields
    assert "scenario.toml:3" in str(caught.value)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: starl.Scenario("rac"), "did you mean `race`"),
        (lambda: starl.Scenario("race", network={"los": 0.1}), "did you mean `loss`"),
        (lambda: starl.Scenario("race").set("network.loss", 2), "not a probability"),
        (lambda: starl.Scenario("race").set("network.loss", object()), "network.loss"),
        (lambda: starl.Scenario("race", robots="creat=4"), "did you mean `create`"),
        (lambda: starl.Scenario.from_file("no/such.toml"), "no/such.toml"),
        (lambda: starl.Scenario("race", faults="no.toml"), "no.toml"),
        (lambda: starl.Program("hello"), "begin with `program Name`"),
    ],
)
def test_what_is_wrong_is_said(make: object, message: str) -> None:
    with pytest.raises(starl.StarlError, match=message):
        make()  # type: ignore[operator]


def test_a_file_finds_those_beside_it(tmp_path: Path) -> None:
    (tmp_path / "hello.starl").write_text(HELLO)
    scenario = tmp_path / "s.toml"
    world = "[world]\nstart_area = { low = [0, 0], high = [5, 5] }\n"
    scenario.write_text(f'program = "hello.starl"\n{world}[[robots]]\nmodel = "create"\ncount = 2\n')
    opened = starl.Scenario.from_file(scenario)
    assert [robot.model for robot in starl.Simulation(opened).robots] == ["create", "create"]
    (tmp_path / "hello.starl").unlink()
    with pytest.raises(starl.StarlError, match=r"s\.toml:1:11: program: .*hello\.starl"):
        starl.Scenario.from_file(scenario)


def test_a_program_imports_libraries_beside_it(tmp_path: Path) -> None:
    (tmp_path / "helper.starl").write_text("library helper\n\nfunction twice(x: Int) -> Int = 2 * x\n")
    text = HELLO.replace("program Hello\n", "program Hello\n\nimport helper\n").replace("not moved", "not moved and helper.twice(2) == 4")
    path = tmp_path / "hello.starl"
    path.write_text(text)
    program = starl.Program.from_file(path)
    simulation = starl.Simulation(starl.Scenario(program=program, robots="create=2", duration="1s"))
    simulation.run()
    assert len(simulation.records("action")) == 2


def test_keywords_are_fields() -> None:
    scenario = starl.Scenario("race", network={"loss": 0.25, "delay": "30ms"}, duration=7, seed=9)
    text = scenario.text()
    assert "loss = 0.25" in text and 'delay = "30ms"' in text and 'duration = "7s"' in text
    other = scenario.with_(network={"loss": 0.5})
    assert "loss = 0.5" in other.text() and "loss = 0.25" in scenario.text()
    assert starl.Simulation(scenario).seed == 9
    assert starl.Simulation(scenario, seed=2**63 - 1).seed == 2**63 - 1
