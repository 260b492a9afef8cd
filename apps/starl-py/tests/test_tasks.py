"""Parts of tasks: expressions of the language, quantities, places; and the page about tasks."""

import ast
import re
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from starl import StarlError
from starl.env import Lidar, ParallelEnv, Ring, Scatter, Settings, Task, VectorEnv, World, tasks

ROOT = Path(__file__).resolve().parents[3]
TASKS = Path(tasks.__file__).parent
Numbers = NDArray[np.float64]


def touched(world: World) -> Numbers:
    return (world.contacts >= 0).astype(np.float64)


def navigation(world: World, before: dict[str, Numbers]) -> Numbers:
    way: Numbers = np.linalg.norm(world["goal"] - before["positions"], axis=-1)
    left: Numbers = np.linalg.norm(world["goal"] - world.positions, axis=-1)
    return way - left - touched(world)


def apart(world: World) -> Numbers:
    here = world.positions
    apart: Numbers = np.linalg.norm(here[:, None] - here[:, :, None], axis=-1)
    apart[:, np.arange(world.robots), np.arange(world.robots)] = np.inf
    return apart


def flocking(world: World, before: dict[str, Numbers]) -> Numbers:
    flock = np.linalg.norm(world.velocities[..., :2].mean(axis=1), axis=-1) / world.speeds.min()
    near = np.maximum(apart(world).min(axis=2) - 0.5, 0.0)
    return np.asarray(flock[:, None] - near - touched(world))


def dispersion(world: World, before: dict[str, Numbers]) -> Numbers:
    near = np.linalg.norm(world["target"][:, None] - world.positions[:, :, None], axis=-1) < world.radii[:, None]
    near &= before["visited"][:, None, :, 0] == 0
    return np.asarray((near / np.maximum(near.sum(axis=1, keepdims=True), 1)).sum(axis=2))


def transport(world: World, before: dict[str, Numbers]) -> Numbers:
    def measured(thing: Numbers, positions: Numbers) -> Numbers:
        left = np.linalg.norm(world["goal"] - thing, axis=-1)
        return np.asarray(left + 0.1 * np.linalg.norm(thing - positions, axis=-1))

    return measured(before["thing"], before["positions"]) - measured(world["thing"], world.positions)


def pursuit(world: World, before: dict[str, Numbers]) -> Numbers:
    evader = world.robots - 1
    by = world.contacts[:, evader]
    caught = (world.contacts[:, :evader] == evader).any(axis=1) | ((by >= 0) & (by < evader))
    gain = 10.0 * caught - 0.1 * apart(world)[:, evader].min(axis=1)
    return np.asarray(gain[:, None] * np.append(np.ones(evader), -1.0))


@pytest.mark.parametrize(
    ("task", "formula"),
    [
        (tasks.Navigation, navigation),
        (tasks.Crossing, navigation),
        (tasks.Flocking, flocking),
        (tasks.Dispersion, dispersion),
        (tasks.Transport, transport),
        (tasks.Pursuit, pursuit),
    ],
)
def test_expressions_give_what_numpy_gives(
    task: Callable[..., Task], formula: Callable[[World, dict[str, Numbers]], Numbers]
) -> None:
    env = VectorEnv(task(max_steps=40), 16)
    env.reset(seed=11)
    random = np.random.default_rng(5)
    over = np.zeros(16, np.bool_)
    drift, seen = random.uniform(-1, 1, env.action_space.shape or ()), []
    for _ in range(120):
        world = env.world
        before = {"positions": world.positions.copy(), **{name: own.copy() for name, own in world.quantities.items()}}
        actions = np.clip(drift + random.uniform(-1, 1, drift.shape), -1, 1)
        for point in ("goal", "target", "thing"):
            if point in world.quantities and random.random() < 0.7:
                actions[..., :2] = np.clip(4 * (world[point] - world.positions), -1, 1)
        # Rewards are those of the state before the reset.
        _, _, terminated, truncated, infos = env.step(actions)
        if not over.any():
            np.testing.assert_allclose(infos["robot_rewards"], formula(world, before), atol=1e-12)
            seen.append(infos["robot_rewards"].copy())
        over = terminated | truncated
    assert len(seen) > 20
    assert np.std(seen) > 0.001


@pytest.mark.parametrize("name", tasks.__all__)
def test_a_task_takes_ten_lines_at_most(name: str) -> None:
    text = (TASKS / f"{name.lower()}.py").read_text()
    (written,) = (node for node in ast.parse(text).body if isinstance(node, ast.ClassDef))
    documentation = written.body[0]
    lines = text.splitlines()[(documentation.end_lineno or 0) : written.end_lineno]
    assert sum(bool(line.strip()) for line in lines) <= 10


def reach(**changes: Any) -> Task:
    """Robots that are to go to the origin."""
    own = {"observe": ["to home"], "points": {"home": Scatter(0.5, shared=True)}, "reward": "0.0"}
    return Task(2, **{**own, **changes})


def step(task: Task, environments: int = 2, seed: int = 1) -> tuple[VectorEnv, NDArray[Any], dict[str, Any]]:
    env = VectorEnv(task, environments)
    env.reset(seed=seed)
    _, _, _, _, infos = env.step(np.full(env.action_space.shape or (), 0.5))
    return env, infos["robot_rewards"], infos


def test_a_list_is_as_long_as_there_are_robots() -> None:
    task = Task(
        4, values={"share": [1.0, 2.0, ..., 3.0]}, observe=["share"], reward="radius",
        parameters={"radius": [0.3, ..., 0.1, 0.2], "speed": 0.8},
    )  # fmt: skip
    env, rewards, _ = step(task)
    assert env.step(np.zeros((2, 4, 3)))[0][0, :, 0].tolist() == [1.0, 2.0, 2.0, 3.0]
    assert rewards[0].tolist() == [0.3, 0.3, 0.1, 0.2]
    assert (env.world.speeds == 0.8).all()
    for robots, sides in [(1, [-1.0]), (2, [1.0, -1.0]), (5, [1.0] * 4 + [-1.0])]:
        assert VectorEnv(tasks.Pursuit(robots), 1).world["side"][0, :, 0].tolist() == sides


@pytest.mark.parametrize("items", [[..., 1.0], [1.0, ..., 2.0, ...], [1.0, 2.0, 3.0, ..., 4.0], [], [1.0], [[1.0], 2.0]])
def test_a_list_of_the_wrong_length_is_refused(items: Any) -> None:
    with pytest.raises(StarlError, match="values: a: "):
        ParallelEnv(reach(values={"a": items}))
    with pytest.raises(StarlError, match="parameters"):
        ParallelEnv(reach(parameters={"speed": items}))


def test_measures_are_the_information_unless_it_is_given() -> None:
    measures = {"near: Bool": "distance(position, home) < 0.5", "middle: Point": "position", "x": "position.x"}
    env, _, infos = step(reach(measures=measures))
    assert {name for name in infos if not name.startswith("_")} == {"near", "x", "robot_rewards"}
    np.testing.assert_allclose(infos["x"], env.world.positions[..., 0].mean(axis=1))
    assert set(step(reach(measures=measures, information={}))[2]) == {"robot_rewards", "_robot_rewards"}


def test_a_mean_is_over_the_robots_that_are_asked_for() -> None:
    env = VectorEnv(tasks.Transport(3, carriers=2), 2)
    env.reset(seed=3)
    world = env.world
    world["holds"] = [[[1], [0], [1]], [[1], [0], [0]]]
    middle = (world.positions[0, 0] + world.positions[0, 2]) / 2
    np.testing.assert_allclose(world.mean("position", where="holds")[:, 0], [middle, world.positions[1, 0]])
    np.testing.assert_allclose(world.mean("position", where="holds", least="carriers")[:, 0], [middle, [0, 0]])
    assert not world.mean("position", where="holds", least=3).any()
    with pytest.raises(StarlError, match="where: there is no quantity `hold`; did you mean `holds`"):
        world.mean("position", where="hold")


def test_a_task_needs_no_class() -> None:
    env, rewards, infos = step(
        reach(
            reward="distance(previous.position, home) - distance(position, home)",
            terminated="distance(position, home) < 0.1",
            information={"far": "distance(position, home) > 0.5", "x": "position.x"},
        )
    )
    world = env.world
    assert np.array_equal(world["home"][:, 0], world["home"][:, 1])
    far = np.linalg.norm(world["home"] - world.positions, axis=-1) > 0.5
    assert np.array_equal(infos["far"], far.mean(axis=1))
    np.testing.assert_allclose(infos["x"], world.positions[..., 0].mean(axis=1))
    assert rewards.any()


def test_an_episode_ends_when_all_robots_have_done_their_part() -> None:
    for terminated, ends in [("id == id", True), ("exists r: r.position.x > 50.0", False), ("nearest > 1000.0", False)]:
        env = VectorEnv(reach(terminated=terminated), 3)
        env.reset(seed=1)
        assert env.step(np.zeros((3, 2, 3)))[2].tolist() == [ends] * 3


def test_keywords_change_parts_values_and_settings() -> None:
    task = tasks.Flocking(3, spacing=0.25, reward="spacing", model="create", max_steps=7)
    _, rewards, _ = step(task)
    assert (rewards == 0.25).all()
    assert (task.settings.robots, task.settings.model, task.max_steps) == (3, "create", 7)
    assert tasks.Flocking().values == {"spacing": 0.5}
    assert (step(tasks.Navigation(2, values={"share": [0.25, 0.75]}, reward="share"))[1] == [0.25, 0.75]).all()
    with pytest.raises(TypeError, match="Navigation has no setting `rewards`; did you mean `reward`"):
        tasks.Navigation(rewards="1.0")


def test_measures_are_observed_and_remembered() -> None:
    measures = {"count": "previous.count + 1.0", "middle: Point": "(position + home) / 2.0", "odd: Bool": "count == 2.0"}
    task = reach(measures=measures, observe=["count", "middle", "odd", "every count", "position to middle"], reward="count")
    env = VectorEnv(task, 2)
    seen, _ = env.reset(seed=4)
    assert (seen[..., 0] == 1.0).all()
    seen, rewards, _, _, _ = env.step(np.zeros((2, 2, 3)))
    assert (seen[..., [0, 3, 4, 5]] == [2.0, 1.0, 2.0, 2.0]).all()
    assert (rewards == 2.0).all()
    np.testing.assert_allclose(seen[..., 1:3] - seen[..., 6:8], env.world.positions, atol=1e-6)


def test_methods_and_expressions_go_together() -> None:
    class Mixed(Task):
        settings = Settings(2, lidar=Lidar(32, 1.0))
        starts = Ring(0.5)
        measures = {"near: Bool": "[range for range in lidar if range < 0.9].size() > 0"}
        terminated = "near"

        def observe(self, world: World) -> list[Numbers]:
            return [world["near"], world.lidar]

        def reward(self, world: World) -> Numbers:
            return world["near"][..., 0] * 3.0

    env, rewards, _ = step(Mixed())
    assert (rewards == 3.0).all()
    assert np.allclose(np.linalg.norm(env.world.positions - env.world.positions.mean(axis=1, keepdims=True), axis=-1), 0.5)


@pytest.mark.parametrize(
    ("changes", "place", "message", "help"),
    [
        ({"reward": "1.0 +\n  gaol.x"}, ("reward", 2, 3), "there is no `gaol`", None),
        ({"reward": "distance(position, homes)"}, ("reward", 1, 20), "there is no `homes`", "did you mean `home`?"),
        (
            {"reward": "round(1.5)"},
            ("reward", 1, 1),
            "the expression is an Int, not a Float",
            "convert it with `Float(...)`",
        ),
        ({"terminated": "finished"}, ("terminated", 1, 1), "an environment does not know `finished`", None),
        ({"measures": {"a": "ranges[0]"}}, ('measures["a"]', 1, 1), "a task cannot use `ranges`", None),
        ({"information": {"a": "position"}}, ('information["a"]', 1, 1), "the expression has the wrong type", None),
        ({"values": {"home": 1.0}}, ("names", 1, 1), "the name `home` is taken", None),
    ],
)
def test_wrong_expressions_are_told_with_place_and_fix(
    changes: dict[str, Any], place: tuple[str, int, int], message: str, help: str | None
) -> None:
    with pytest.raises(StarlError) as refused:
        ParallelEnv(reach(**changes))
    first = refused.value.diagnostics[0]
    assert (first.file, first.line, first.column) == place
    assert (first.message, first.help) == (message, help)
    assert message in str(refused.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"observe": ["to homes"]}, "there is no quantity `homes`; did you mean `home`"),
        ({"observe": ["to lidar"]}, "`lidar` is no point"),
        ({"observe": "position"}, "give a list"),
        ({"values": {"a": [1.0]}}, "values: a: 1 values for 2 robots"),
        ({"values": {"my share": 1.0}}, "`my share` is not a name"),
        ({"measures": {"a: Int": "1"}}, "the type `Int` is not Bool, Float or Point"),
    ],
)
def test_wrong_parts_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(StarlError, match=message):
        ParallelEnv(reach(**changes))


def test_an_expression_that_fails_names_robot_and_environment() -> None:
    with pytest.raises(ValueError, match=r"reward: `lidar\[5\]` fails for robot 0 in environment 0: index 5"):
        step(reach(reward="lidar[5]", lidar=Lidar(4, 1.0)))


def test_the_page_shows_the_tasks_as_they_are() -> None:
    page = (ROOT / "docs/reference/tasks.md").read_text()
    for name in tasks.__all__:
        source = (TASKS / f"{name.lower()}.py").read_text()
        code = re.sub(r'\n    """.*?"""\n\n', "\n", source[source.index(f"class {name}(") :], count=1, flags=re.S)
        assert f"```python\n{code.strip()}\n```" in page, name
        assert f"](../pictures/tasks/{name.lower()}.svg)" in page


def test_the_pictures_are_what_the_script_draws() -> None:
    drawn = runpy.run_path(str(ROOT / "apps/starl-py/examples/draw_tasks.py"))["pictures"]()
    kept = {path.name: path.read_text() for path in (ROOT / "docs/pictures/tasks").glob("*.svg")}
    assert kept == drawn, "python apps/starl-py/examples/draw_tasks.py docs/pictures/tasks draws them"
