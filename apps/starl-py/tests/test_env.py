"""Environments for learning."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode
from pettingzoo.test import parallel_api_test, parallel_seed_test  # type: ignore[import-untyped]

from starl import StarlError
from starl.env import Env, Lidar, ParallelEnv, Radio, Settings, Task, VectorEnv, Waypoints, World, tasks

TASKS: list[Callable[[], Task]] = [
    tasks.Crossing,
    tasks.Dispersion,
    tasks.Flocking,
    tasks.Navigation,
    tasks.Pursuit,
    tasks.Transport,
]


def short(task: Task, steps: int) -> Task:
    task.max_steps = steps
    return task


@pytest.mark.parametrize("make", TASKS)
@pytest.mark.filterwarnings("error")
def test_the_tests_of_pettingzoo_pass(make: Callable[[], Task]) -> None:
    parallel_api_test(ParallelEnv(short(make(), 50)), num_cycles=120)
    parallel_seed_test(lambda: ParallelEnv(make()), num_cycles=30)


@pytest.mark.filterwarnings("ignore:.*observation space (minimum|maximum) value is .*infinity")
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("model", ["holonomic", "create", "car"])
def test_the_checker_of_gymnasium_passes(model: str) -> None:
    check_env(Env(tasks.Navigation(1, model=model, parameters={})), skip_render_check=True)


def test_an_env_has_one_robot() -> None:
    with pytest.raises(ValueError, match="use ParallelEnv or VectorEnv"):
        Env(tasks.Navigation(2))


def trajectory(make: Callable[[], Task], environments: int, which: int, threads: int = 1) -> list[np.ndarray[Any, Any]]:
    """What environment `which` shows, with a seed that does not depend on its number."""
    env = VectorEnv(short(make(), 25), environments, threads=threads)
    rows = [env.reset(seed=[500 + index - which for index in range(environments)])[0][which]]
    for step in range(80):
        actions = np.stack(
            [
                np.random.default_rng([500 + index - which, step]).uniform(-1, 1, env.single_action_space.shape or ())
                for index in range(environments)
            ]
        )
        observations, rewards, terminations, truncations, infos = env.step(actions)
        ends = [rewards[which], terminations[which], truncations[which]]
        rows += [observations[which], infos["robot_rewards"][which], np.array(ends, np.float64)]
    return rows


@pytest.mark.parametrize("make", TASKS)
def test_the_size_of_the_batch_changes_nothing(make: Callable[[], Task]) -> None:
    alone = trajectory(make, 1, 0)
    for environments, which, threads in [(7, 3, 1), (64, 63, 1), (64, 20, 3)]:
        among = trajectory(make, environments, which, threads)
        assert all(np.array_equal(a, b) for a, b in zip(alone, among, strict=True)), f"{which} of {environments}"


def test_seeds_differ_and_repeat() -> None:
    env = VectorEnv(tasks.Navigation(3), 4)
    first, _ = env.reset(seed=7)
    assert all(not np.array_equal(first[0], first[other]) for other in range(1, 4))
    second, _ = env.reset()
    assert not np.array_equal(first, second)
    assert np.array_equal(first, env.reset(seed=7)[0])
    assert np.array_equal(first[1:], env.reset(seed=8)[0][:3])


def run(mode: AutoresetMode, steps: int = 12) -> tuple[VectorEnv, list[Any]]:
    env = VectorEnv(short(tasks.Navigation(2), 5), 3, autoreset_mode=mode)
    env.reset(seed=1)
    actions = np.zeros((3, 2, 3))
    return env, [env.step(actions) for _ in range(steps)]


def test_next_step_resets_one_step_later() -> None:
    _, results = run(AutoresetMode.NEXT_STEP)
    assert [bool(truncated.all()) for _, _, _, truncated, _ in results[:6]] == [False] * 4 + [True, False]
    last, reset, after = results[4][0], results[5][0], results[6][0]
    assert not np.array_equal(last, reset)
    assert (results[5][1] == 0).all()
    assert np.array_equal(reset[..., :2], after[..., :2])
    assert bool(results[10][3].all())


def test_same_step_resets_at_once_and_keeps_the_end() -> None:
    _, results = run(AutoresetMode.SAME_STEP)
    observations, _, _, truncated, infos = results[4]
    assert truncated.all()
    assert infos["_final_obs"].all()
    assert np.array_equal(np.stack(list(infos["final_obs"])), results[3][0])
    assert not np.array_equal(observations, results[3][0])
    assert "arrived" in infos["final_info"]
    assert bool(results[9][3].all())


def test_disabled_leaves_resets_to_the_caller() -> None:
    env, results = run(AutoresetMode.DISABLED, 5)
    assert results[4][3].all()
    with pytest.raises(ValueError, match="environment 0 is over"):
        env.step(np.zeros((3, 2, 3)))
    mask = np.array([True, False, True])
    observations, _ = env.reset(options={"reset_mask": mask})
    assert np.array_equal(observations[1], results[4][0][1])
    assert not np.array_equal(observations[0], results[4][0][0])
    with pytest.raises(ValueError, match="environment 1 is over"):
        env.step(np.zeros((3, 2, 3)))
    env.reset(options={"reset_mask": ~mask})
    env.step(np.zeros((3, 2, 3)))
    with pytest.raises(TypeError, match="reset_mask"):
        env.reset(options={"reset_mask": [True, False, True]})


def toward_goals(env: VectorEnv) -> np.ndarray[Any, Any]:
    actions = np.zeros(env.action_space.shape or ())
    actions[..., :2] = np.clip(3 * (env.world["goal"] - env.world.positions), -1, 1)
    return actions


def left(world: World) -> np.ndarray[Any, Any]:
    """How far robots are from their goals: (E, N)."""
    distances: np.ndarray[Any, Any] = np.linalg.norm(world["goal"] - world.positions, axis=-1)
    return distances


def test_robots_that_drive_at_their_goals_arrive_and_are_rewarded() -> None:
    env = VectorEnv(tasks.Navigation(1), 32, autoreset_mode=AutoresetMode.DISABLED)
    env.reset(seed=3)
    way, total = left(env.world), np.zeros(32)
    for _ in range(100):
        _, rewards, terminated, _, _ = env.step(toward_goals(env))
        total += rewards
        if terminated.any():
            break
    assert (left(env.world) < way).all()
    np.testing.assert_allclose(total, (way - left(env.world))[:, 0])
    assert terminated.any()


def test_waypoints_are_driven_to() -> None:
    settings = Settings(2, "create", actions=Waypoints(0.8), steps_per_action=40)
    world = World(settings, 2)
    envs = np.arange(2)
    world.place(envs, np.array([[[0, 0], [0, 3]], [[5, 5], [9, 9]]], np.float64))
    start = world.positions.copy()
    ahead = np.zeros((2, 2, 2))
    ahead[..., 0] = 1.0
    target = start + np.array([0.8, 0.0])
    world.step(ahead)
    for _ in range(5):
        world.step((target - world.positions) / 0.8)
    np.testing.assert_allclose(world.positions, target, atol=0.1)


def test_drones_fly() -> None:
    world = World(Settings(1, "drone"), 1)
    world.place(np.arange(1), np.array([[[0.0, 0.0, 1.0]]]))
    for _ in range(20):
        world.step(np.array([[[0.0, 0.5, 0.0, 0.5]]]))
    assert world.poses[0, 0, 2] > 1.3
    assert world.poses[0, 0, 0] > 0.5


def test_messages_of_actions_are_heard() -> None:
    world = World(Settings(3, radio=Radio(2, range=1.5, delay=1)), 2)
    world.place(np.arange(2), np.array([[[0, 0], [1, 0], [3, 0]]] * 2, np.float64))
    words = np.zeros((2, 3, 5))
    words[:, :, 3:] = [[1, 2], [3, 4], [5, 6]]
    world.step(words)
    assert (world.ages == -1).all()
    world.step(words * 2)
    assert np.array_equal(world.messages[1, 0, 1], [3, 4])
    assert world.ages[1].tolist() == [[-1, 1, -1], [1, -1, -1], [-1, -1, -1]]


def test_lidar_sees_walls_and_own_pillars() -> None:
    world = World(Settings(1, walls=(-1, -1, 1, 1), lidar=Lidar(4, 2.0)), 2)
    world.set_circles(np.array([1]), np.array([[[0.0, 0.5, 0.1]]]))
    world.place(np.arange(2), np.zeros((2, 1, 2)))
    np.testing.assert_allclose(world.lidar[:, 0], [[0.85] * 4, [0.85, 0.25, 0.85, 0.85]])


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (Settings(0), "robots"),
        (Settings(2, "crate"), "there is no robot model `crate`"),
        (Settings(2, parameters={"sped": 1}), "no parameter `sped`"),
        (Settings(2, lidar=Lidar(0)), "0 rays"),
        (Settings(2, radio=Radio(1, loss=2)), "2 is not a probability"),
        (Settings(2, physics_step=0), "physics_step"),
        (Settings(2, walls=(0, 0, 0, 1)), "obstacles"),
    ],
)
def test_settings_out_of_range_are_refused(settings: Settings, message: str) -> None:
    with pytest.raises(StarlError, match=message):
        World(settings, 1)


def test_bad_arguments_are_refused() -> None:
    world = World(Settings(2), 3)
    with pytest.raises(ValueError, match="use \\(3, 2, 3\\)"):
        world.step(np.zeros((3, 2, 2)))
    with pytest.raises(ValueError, match="robot 1 in environment 2"):
        actions = np.zeros((3, 2, 3))
        actions[2, 1, 0] = np.nan
        world.step(actions)
    with pytest.raises(ValueError, match="no environment 3"):
        world.uniform(np.array([3]), 1)
    with pytest.raises(ValueError, match="environment 1: only 1 of 9"):
        world.scatter(np.array([1]), 9, (0, 0), (0.1, 0.1))
    env = ParallelEnv(tasks.Navigation(2))
    env.reset(seed=0)
    with pytest.raises(ValueError, match="no action for robot_1"):
        env.step({"robot_0": np.zeros(3)})


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"robots": -1}, "robots: -1 is not a number of robots"),
        ({"robots": 1.5}, "robots: 1.5 is not a number of robots"),
        ({"obstacles": [1]}, "obstacles: 1 is not a `Circle` or a `Box`"),
        ({"actions": "velocities"}, '"commands" or `Waypoints`'),
        ({"lidar": 5}, "lidar: 5 is not a `Lidar`"),
        ({"lidar": Lidar(-1)}, "lidar: -1 rays"),
        ({"walls": (1, 2, 3)}, "is not left, bottom, right, top"),
        ({"model": None}, "model: None is not the name"),
        ({"reward": 5}, "reward: 5 is not an expression"),
        ({"terminated": True}, "terminated: True is not an expression"),
        ({"information": {"a": 1}}, r"information\['a'\]: 1 is not an expression"),
        ({"measures": {"a": 1}}, r"measures\['a'\]: 1 is not an expression"),
        ({"starts": 5}, "starts: 5 is not a place"),
        ({"points": {"goal": 5}}, r"points\['goal'\]: 5 is not a place"),
        ({"half": np.nan}, "half: nan is not a number"),
        ({"max_steps": 0}, "max_steps: 0 is not a number"),
    ],
)
def test_parts_of_the_wrong_type_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(StarlError, match=message):
        VectorEnv(tasks.Navigation(**changes), 1)


@pytest.mark.parametrize("actions", [np.full((3, 2, 3), 1j), np.full((3, 2, 3), "a"), np.full((3, 2, 3), None)])
def test_actions_are_numbers(actions: Any) -> None:
    env = VectorEnv(tasks.Navigation(2), 3)
    with pytest.raises(ValueError, match="environment 0 has not begun; call reset"):
        env.step(np.zeros((3, 2, 3)))
    env.reset(seed=np.int64(1))  # type: ignore[arg-type]
    for numbers in (np.float16, np.int8, np.bool_):
        env.step(np.ones((3, 2, 3), numbers))
    with pytest.raises(ValueError, match=f"actions have the type {actions.dtype}; use numbers"):
        env.step(actions)


def test_wrong_uses_of_an_environment_are_named() -> None:
    with pytest.raises(StarlError, match="is not a task"):
        VectorEnv(tasks.Navigation, 1)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="0 threads"):
        VectorEnv(tasks.Navigation(2), 1, threads=0)
    env = ParallelEnv(tasks.Navigation(2))
    env.reset(seed=0)
    with pytest.raises(ValueError, match=r"the action of robot_1 has the shape \(2,\); use \(3,\)"):
        env.step({"robot_0": np.zeros(3), "robot_1": np.zeros(2)})
    with pytest.raises(TypeError, match="pickle the task"):
        copy.deepcopy(env)
    assert pickle.loads(pickle.dumps(tasks.Pursuit(3))).settings == tasks.Pursuit(3).settings


def test_transport_needs_enough_carriers() -> None:
    for carriers, moves in [(2, True), (3, False)]:
        env = VectorEnv(tasks.Transport(2, carriers=carriers), 1)
        env.reset(seed=2)
        thing = env.world["thing"]
        env.world.place(np.arange(1), thing + np.array([[[-0.15, 0.0], [0.15, 0.0]]]))
        env.step(np.zeros((1, 2, 3)))
        before = thing.copy()
        actions = np.zeros((1, 2, 3))
        actions[..., 1] = 1.0
        env.step(actions)
        assert np.allclose(thing - before, [[0.0, 0.1 if moves else 0.0]])


def test_a_touch_catches_the_evader() -> None:
    task = tasks.Pursuit(3)
    env = VectorEnv(task, 1)
    env.reset(seed=2)
    env.world.place(np.arange(1), np.array([[[-0.5, 0.0], [0.0, 1.8], [0.0, 0.0]]]))
    actions = np.zeros((1, 3, 3))
    actions[0, 0, 0] = 1.0
    steps = 0
    terminated = np.zeros(1, np.bool_)
    while not terminated[0] and steps < 10:
        _, _, terminated, _, infos = env.step(actions)
        steps += 1
    assert 3 <= steps <= 5
    assert infos["robot_rewards"][0, 0] > 9
    assert infos["robot_rewards"][0, 2] < -9
