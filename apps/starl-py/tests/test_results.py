"""Results: tables, traces, plots, the viewer."""

import re
from pathlib import Path

import numpy as np
import pandas
import polars
import pyarrow
import pytest
from matplotlib.figure import Figure

import starl


@pytest.fixture(scope="module")
def race() -> starl.Simulation:
    simulation = starl.Simulation("race", seed=7)
    simulation.run()
    return simulation


def test_tables_become_frames_of_every_library(race: starl.Simulation) -> None:
    table = race.records("delivered")
    assert len(table) > 0
    frame = polars.DataFrame(table)
    assert frame.columns == table.columns == pyarrow.table(table).column_names
    assert table.to_polars().equals(frame)
    assert isinstance(table.to_pandas(), pandas.DataFrame) and len(table.to_pandas()) == len(table)
    assert frame.schema["time_ns"] == polars.Int64 and frame.schema["from"] == polars.Int64
    assert np.array_equal(table.to_numpy()["time_ns"], frame["time_ns"].to_numpy())


def test_a_frame_outlives_its_simulation() -> None:
    simulation = starl.Simulation("race", seed=7)
    simulation.run(2.0)
    frame = simulation.records("pose").to_polars()
    copy = frame.clone().to_dicts()
    del simulation
    assert frame.to_dicts() == copy


def test_records_without_a_value_are_null(race: starl.Simulation) -> None:
    frame = race.records("primitive").to_polars()
    assert frame["fields.vicinity"].null_count() > 0
    assert frame.filter(polars.col("name") == "start")["fields.vicinity"].null_count() == 0


def test_a_trace_is_read_as_it_was_recorded(race: starl.Simulation, tmp_path: Path) -> None:
    path = tmp_path / "race.mcap"
    race.save_trace(path)
    trace = starl.read_trace(path)
    assert (trace.outcome, trace.digest, trace.seed) == ("reached", race.digest, 7)
    assert trace.end == pytest.approx(race.now)
    assert [robot["name"] for robot in trace.robots] == [robot.name for robot in race.robots]
    assert trace.records("sent").to_polars().equals(race.records("sent").to_polars())
    again = trace.simulation()
    again.run()
    assert again.digest == race.digest


def test_a_cut_trace_is_read_as_far_as_it_goes(race: starl.Simulation, tmp_path: Path) -> None:
    whole, cut, bad = tmp_path / "whole.mcap", tmp_path / "cut.mcap", tmp_path / "bad.mcap"
    race.save_trace(whole)
    cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    trace = starl.read_trace(cut)
    assert trace.error and trace.outcome is None
    bad.write_bytes(b"no trace")
    for path in (bad, tmp_path / "none.mcap"):
        with pytest.raises(starl.StarlError, match=re.escape(str(path))):
            starl.read_trace(path)


def test_a_plot_shows_every_path(race: starl.Simulation, tmp_path: Path) -> None:
    axes = race.plot()
    legend, figure = axes.get_legend(), axes.get_figure()
    assert legend and isinstance(figure, Figure)
    labels = [text.get_text() for text in legend.get_texts()]
    assert labels == [robot.name for robot in race.robots]
    figure.savefig(tmp_path / "plot.png")


def test_the_viewer_is_one_page_that_holds_the_run(race: starl.Simulation, tmp_path: Path) -> None:
    recorded, live = race.show(), race.show(live=True)
    recorded.save(tmp_path / "run.html")
    page = (tmp_path / "run.html").read_text()
    assert "{{" not in page.split("<script type=\"module\">")[0]
    assert not re.search(r"<(script|link|img)[^>]*(src|href)=\"(?!data:)", page)
    assert len(live.page()) > len(page) + 1_000_000
    assert recorded._repr_html_().isascii()
