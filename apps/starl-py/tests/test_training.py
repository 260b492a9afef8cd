"""The script that trains the policy of `examples/crossing`: its environments, and the file that it writes."""

import runpy
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import starl
from starl.env import VectorEnv

ROOT = Path(__file__).resolve().parents[3]
CROSSING = ROOT / "examples/crossing"


@pytest.fixture(scope="module")
def script() -> dict[str, Any]:
    return runpy.run_path(str(ROOT / "apps/starl-py/examples/train_crossing.py"))


def test_robots_see_the_closeness_of_others_in_eight_directions(script: dict[str, Any]) -> None:
    env = VectorEnv(script["Crossing"](6), 40)
    seen, _ = env.reset(seed=3)
    way = env.world["goal"] - env.world.positions
    others = env.world.positions[:, None] - env.world.positions[:, :, None]
    closeness = np.maximum(0, 1 - np.linalg.norm(others, axis=-1)) * (1 - np.eye(6))
    ahead = np.arctan2(way[..., 1], way[..., 0])
    angles = np.arctan2(others[..., 1], others[..., 0]) - ahead[..., None]
    lobes = np.maximum(0, np.cos(angles[..., None] - np.arange(8) * np.pi / 4))
    np.testing.assert_allclose(seen[..., 0], np.minimum(1, np.linalg.norm(way, axis=-1)), atol=1e-6)
    np.testing.assert_allclose(seen[..., 1:], (closeness[..., None] * lobes).max(axis=2), atol=1e-6)
    assert (seen[..., 1:] > 0).any()


def test_what_the_script_writes_runs_as_a_program(
    script: dict[str, Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "crossing.onnx"
    sizes = {"networks": 4, "situations": 2, "rounds": 1, "episodes": 4, "out": out}
    monkeypatch.setattr(sys, "argv", ["train", *(str(word) for size in sizes.items() for word in (f"--{size[0]}", size[1]))])
    script["main"]()
    assert "round 1: " in capsys.readouterr().out
    for name in ("crossing.starl", "crossing.toml"):
        (tmp_path / name).write_bytes((CROSSING / name).read_bytes())
    run = starl.Simulation(starl.Scenario.from_file(tmp_path / "crossing.toml"))
    run.run(until=1.0)
    assert run.report()["failures"] == []
    assert np.abs(run.velocities).max() > 0
