"""Sweeps and campaigns: the same results on any number of threads, and after a stop."""

import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import polars
import pytest

import starl
from starl import _work

AXES = {"network.loss": "0..0.6:3", "fleet": [2, 3]}


@pytest.fixture(scope="module")
def swept() -> starl.SweepResults:
    return starl.sweep("race", AXES, seeds=3, threads=1)


def test_every_run_is_there_once(swept: starl.SweepResults) -> None:
    rows = swept.rows.to_polars()
    assert rows["number"].to_list() == list(range(18))
    assert rows.select("network.loss", "fleet", "seed").n_unique() == 18
    assert len(swept) == 18


@pytest.mark.parametrize("threads", [2, 5])
def test_threads_change_nothing(swept: starl.SweepResults, threads: int) -> None:
    again = starl.sweep("race", AXES, seeds=3, threads=threads)
    assert again.rows.to_polars().equals(swept.rows.to_polars())


def test_rows_are_those_of_the_command(swept: starl.SweepResults, command: str, tmp_path: Path) -> None:
    out = tmp_path / "rows.csv"
    sets = ["--set", "network.loss=0..0.6:3", "--set", "fleet=2,3"]
    subprocess.run([command, "sweep", "race", *sets, "--seeds", "3", "--out", out, "--quiet"], check=True)
    assert polars.read_csv(out)["digest"].to_list() == swept.rows.to_polars()["digest"].to_list()


def test_a_range_of_seeds_is_one_of_python() -> None:
    rows = starl.sweep("race", seeds=range(5, 8)).rows.to_polars()
    assert rows["seed"].to_list() == [5, 6, 7]
    for bad in (range(5, 5), range(0, 10, 2)):
        with pytest.raises(starl.StarlError, match="range"):
            starl.sweep("race", seeds=bad)


def test_a_row_has_the_digest_of_its_run(swept: starl.SweepResults) -> None:
    row = swept.rows.to_polars().row(-1, named=True)
    scenario = starl.Scenario("race", network={"loss": row["network.loss"]}, robots="create=2,drone=1")
    single = starl.Simulation(scenario, seed=row["seed"])
    single.run()
    assert {robot.model for robot in single.robots} == {"create", "drone"}
    assert single.digest == row["digest"]


def test_a_stopped_sweep_goes_on_where_it_was(swept: starl.SweepResults, tmp_path: Path) -> None:
    out = tmp_path / "rows.parquet"
    script = f"import starl; starl.sweep('race', {AXES!r}, seeds=3, threads=1, out={str(out)!r})"
    process = subprocess.Popen([sys.executable, "-c", script])
    journal = Path(f"{out}.journal")
    while process.poll() is None and not (journal.exists() and journal.read_bytes().count(b"\n") >= 4):
        pass
    process.kill()
    process.wait()
    kept = journal.read_bytes().count(b"\n")
    again = starl.sweep("race", AXES, seeds=3, out=out)
    assert kept <= journal.read_bytes().count(b"\n") <= 19
    assert again.rows.to_polars().equals(swept.rows.to_polars())
    assert polars.read_parquet(out).equals(swept.rows.to_polars())
    with pytest.raises(starl.StarlError, match="journal"):
        starl.sweep("race", AXES, seeds=4, out=out)


def test_ctrl_c_ends_a_sweep_and_keeps_its_rows(tmp_path: Path) -> None:
    out = tmp_path / "rows.csv"
    threading.Timer(2.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        starl.sweep("flocking", seeds=100_000, out=out)
    assert len(Path(f"{out}.journal").read_text().splitlines()) >= 1


def test_work_that_fails_ends_the_rest() -> None:
    stopped: list[bool] = []

    def work(number: int) -> int:
        if number == 3:
            raise starl.StarlError("three")
        return number

    with pytest.raises(starl.StarlError, match="three"):
        list(_work.on_threads(work, list(range(1000)), 2, stopped.append))
    assert stopped[-1] is True


@pytest.mark.parametrize("threads", [1, 2, 7])
@pytest.mark.parametrize("count", [0, 1, 5, 40])
def test_all_work_is_done_once(threads: int, count: int) -> None:
    done = list(_work.on_threads(lambda number: number, list(range(count)), threads, lambda stop: None))
    assert sorted(done) == list(range(count))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: starl.sweep("race", {"network.los": [1]}), "did you mean `loss`"),
        (lambda: starl.sweep("race", {"network": {"loss": [2]}}), "not a probability"),
        (lambda: starl.sweep("race", seeds=0), "not seeds"),
        (lambda: starl.sweep("race", profile="x"), "no such profile"),
        (lambda: starl.sweep("race", out="x.foo"), "must end in"),
        (lambda: starl.sweep("race", threads=0), "at least 1"),
        (lambda: starl.test("race", profiles=["x"]), "no profile 'x'"),
    ],
)
def test_what_is_wrong_is_said(call: object, message: str) -> None:
    with pytest.raises(starl.StarlError, match=message):
        call()  # type: ignore[operator]


def test_summaries_and_plots(swept: starl.SweepResults) -> None:
    summary = swept.summary()
    assert len(summary) == 6
    goal = summary[0]["goal"]
    assert 0 <= goal["low"] <= goal["estimate"] <= goal["high"] <= 1
    rows = swept.rows.to_polars().filter((polars.col("network.loss") == 0) & (polars.col("fleet") == 2))
    mean = rows["time_to_goal_seconds"].mean()
    assert summary[0]["metrics"]["time_to_goal_seconds"]["estimate"] == pytest.approx(mean)
    axes = swept.plot("time_to_goal_seconds")
    assert axes.get_xlabel() == "network.loss" and len(axes.get_lines()) == 2
    with pytest.raises(starl.StarlError, match="no metric"):
        swept.plot("speed")


BROKEN = """program Broken

message Hello()

radio = Broadcast()
heard: Int = 0

hello()
    pre heard == 0
    eff radio.broadcast(Hello()); heard = 1

on Hello(_)
    heard += 1

/// Wrong on purpose: others are heard too.
invariant alone: heard <= 1
"""


def test_a_campaign_finds_and_shrinks_what_is_wrong(tmp_path: Path) -> None:
    program = starl.Program(BROKEN)
    scenario = starl.Scenario(program=program, robots="create=4", duration="20s")
    found = starl.test(scenario, profiles=["calm", "lossy"], seeds=2, shrink=1, most_trials=60)
    assert len(found.runs) == 4
    assert {failure.wrong for failure in found.failures} == {"Broken.alone"}
    first = found.failures[0]
    assert first.scenario and first.after and first.after["robots"] < 4
    files = {"program.starl": BROKEN}
    again = starl.Simulation(starl.Scenario.from_text(first.scenario, files=files))
    again.run()
    assert [one["property"] for one in again.report()["violations"]][:1] == ["Broken.alone"]
    assert json.dumps(found.runs)
