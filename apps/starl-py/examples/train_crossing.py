"""Trains the policy of `examples/crossing` in a few minutes on two cores: an evolution strategy (Salimans et al. 2017) on a
small network, the same for all robots. Needs `starl[env]` and `onnx`.

`python apps/starl-py/examples/train_crossing.py --out examples/crossing/crossing.onnx` prints, every twenty rounds, the part of
the robots that end at their goals and the part of the episodes in which robots touch, and at last the processor time.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np
import onnx
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from onnx import TensorProto, helper, numpy_helper

from starl.env import VectorEnv, World, tasks

Array = NDArray[np.floating[Any]]

#: Closer robots are seen, metres.
SIGHT = 1.0
#: In so many directions.
LOBES = 8
#: Numbers in each layer of the network.
LAYERS = (1 + LOBES, 16, 16, 2)


class Crossing(tasks.Crossing):
    """Robots that know each other's positions. What they see and do is relative to the direction of their goals.

    They see the distance to the goal, at most 1, and for each of eight directions how close the closest robot there is.
    Their reward is metres towards the goal, less a cost for being near another robot, and a high one for touching it.
    """

    max_steps = 120
    reward = """distance(previous.position, goal) - distance(position, goal) - max(0.45 - nearest, 0.0)
        - (if touched then 0.5 else 0.0)"""

    def __init__(self, robots: int) -> None:
        super().__init__(robots, half=1.5, lidar=None, parameters={"radius": 0.15, "speed": 0.5, "cruise_speed": 0.5})

    def reset(self, world: World, envs: NDArray[np.int64]) -> None:
        """Half of the episodes begin in a ring, the others anywhere."""
        super().reset(world, envs)
        anywhere = world.scatter(envs, 2 * world.robots, (-1.7, -1.7), (1.7, 1.7), gap=0.1)[..., :2]
        is_ring = world.uniform(envs, 1)[:, :, None] < 0.5
        world["goal"][envs] = np.where(is_ring, world["goal"][envs], anywhere[:, world.robots :])
        world.place(envs, np.where(is_ring, world.positions[envs], anywhere[:, : world.robots]))

    def observe(self, world: World) -> list[Array]:
        """The distance to the goal, (E, N, 1), and the closeness in each direction, (E, N, 8)."""
        ahead, left, distance = frames(world)
        ways = (world.positions[:, None] - world.positions[:, :, None]).astype(np.float32)
        apart = np.maximum(np.hypot(ways[..., 0], ways[..., 1]), 1e-6)
        ways *= (np.maximum(0, 1 - apart / SIGHT) / apart)[..., None]
        # Vectors to the others, (E, N, N, 2), as long as these are close, and their lengths in each direction.
        close = ways @ np.stack([ahead, left], axis=-1).astype(np.float32)
        angles = np.arange(LOBES) * 2 * np.pi / LOBES
        seen = (close @ np.stack([np.cos(angles), np.sin(angles)]).astype(np.float32)).max(axis=2)
        return [np.minimum(1, distance)[..., None], np.maximum(0, seen)]


def frames(world: World) -> tuple[Array, Array, Array]:
    """The directions to each robot's goal and to the left of it, (E, N, 2), and the distance to it, (E, N)."""
    way = world["goal"] - world.positions
    distance = np.hypot(way[..., 0], way[..., 1])
    ahead = way / np.maximum(distance, 1e-9)[..., None]
    return ahead, np.stack([-ahead[..., 1], ahead[..., 0]], axis=-1), distance


def split(weights: Array) -> list[tuple[Array, Array]]:
    """The matrices and biases of networks whose weights are rows."""
    layers, at = [], 0
    for inputs, outputs in zip(LAYERS, LAYERS[1:], strict=False):
        matrix = weights[:, at : at + inputs * outputs].reshape(-1, inputs, outputs)
        at += inputs * outputs
        layers.append((matrix, weights[:, None, at : at + outputs]))
        at += outputs
    return layers


def evaluate(weights: Array, seen: Array) -> Array:
    """What networks do: the rows of `seen`, (networks, samples, inputs), are for one each."""
    for matrix, bias in split(weights):
        seen = np.tanh(seen @ matrix + bias)
    return seen


def play(env: VectorEnv, task: Crossing, weights: Array, seeds: list[int]) -> tuple[Array, Array, Array]:
    """One episode in each environment, dealt out evenly to the networks: return and arrivals of a robot, and touches."""
    seen, _ = env.reset(seed=seeds)
    environments, robots, _ = seen.shape
    total, arrived, touched = np.zeros(environments), np.zeros(environments), np.zeros(environments, np.bool_)
    is_open = np.ones(environments, np.bool_)
    actions = np.zeros((environments, robots, 3), np.float32)
    for _ in range(task.max_steps):
        rows = seen.reshape(len(weights), -1, LAYERS[0])
        does = evaluate(weights, rows).reshape(environments, robots, 2)
        ahead, left, _ = frames(env.world)
        actions[..., :2] = does[..., :1] * ahead + does[..., 1:] * left
        seen, _, terminated, truncated, infos = env.step(actions)
        total += np.where(is_open, infos["robot_rewards"].mean(axis=1), 0)
        over = (terminated | truncated) & is_open
        touched |= is_open & ~over & (env.world.contacts >= 0).any(axis=1)
        if over.any():
            arrived[over] = infos["final_info"]["arrived"][over]
        is_open &= ~over
        if not is_open.any():
            break
    return total, arrived, touched


def export(weights: Array, path: str) -> None:
    """Writes the network as an ONNX file of 32-bit dense layers."""
    nodes, constants, value = [], [], "seen"
    for number, (matrix, bias) in enumerate(split(weights[None])):
        constants.append(numpy_helper.from_array(matrix[0].astype(np.float32), f"matrix{number}"))
        constants.append(numpy_helper.from_array(bias[0, 0].astype(np.float32), f"bias{number}"))
        nodes.append(helper.make_node("Gemm", [value, f"matrix{number}", f"bias{number}"], [f"sum{number}"]))
        value = "does" if number == len(LAYERS) - 2 else f"layer{number}"
        nodes.append(helper.make_node("Tanh", [f"sum{number}"], [value]))
    seen = helper.make_tensor_value_info("seen", TensorProto.FLOAT, [1, LAYERS[0]])
    does = helper.make_tensor_value_info("does", TensorProto.FLOAT, [1, LAYERS[-1]])
    graph = helper.make_graph(nodes, "crossing", [seen], [does], constants)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)])
    onnx.checker.check_model(model)
    onnx.save(model, path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=6)
    parser.add_argument("--networks", type=int, default=48)
    parser.add_argument("--situations", type=int, default=12)
    parser.add_argument("--rounds", type=int, default=200)
    parser.add_argument("--episodes", type=int, default=256, help="to judge a policy by")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", default="crossing.onnx")
    arguments = parser.parse_args()
    random = np.random.default_rng(arguments.seed)
    task, judged = Crossing(arguments.robots), Crossing(arguments.robots)
    networks, situations = arguments.networks, arguments.situations
    env = VectorEnv(task, networks * situations, autoreset_mode=AutoresetMode.SAME_STEP, threads=2)
    judge = VectorEnv(judged, arguments.episodes, autoreset_mode=AutoresetMode.SAME_STEP, threads=2)
    size = sum((inputs + 1) * outputs for inputs, outputs in zip(LAYERS, LAYERS[1:], strict=False))
    mean, deviation = 0.3 * random.standard_normal(size), 0.1
    first, second = np.zeros(size), np.zeros(size)
    for round in range(arguments.rounds + 1):
        if round % 20 == 0 or round == arguments.rounds:
            _, arrived, touched = play(judge, judged, mean[None], list(range(arguments.episodes)))
            print(f"round {round}: {arrived.mean():.0%} of the robots arrive; {touched.mean():.0%} touch", flush=True)
            export(mean, arguments.out)
        # Pairs of opposite changes, compared by rank, in the same situations.
        half = random.standard_normal((networks // 2, size))
        changes = np.concatenate([half, -half])
        seeds = np.tile(random.integers(1 << 30, size=situations), networks)
        returns, _, _ = play(env, task, mean + deviation * changes, seeds.tolist())
        order = returns.reshape(networks, situations).mean(axis=1).argsort().argsort()
        gradient = (order / (networks - 1) - 0.5) @ changes / (networks * deviation)
        # Adam (Kingma and Ba 2015).
        first = 0.9 * first + 0.1 * gradient
        second = 0.999 * second + 0.001 * gradient**2
        step = first / (1 - 0.9 ** (round + 1)) / (np.sqrt(second / (1 - 0.999 ** (round + 1))) + 1e-8)
        mean += 0.04 * step - 0.0002 * mean
    print(f"the policy is in {arguments.out}, after {time.process_time():.0f} s of processor time")


if __name__ == "__main__":
    main()
