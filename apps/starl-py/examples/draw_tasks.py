"""Draws the pictures of the tasks: an episode of each with a simple controller, seen from above.

`python apps/starl-py/examples/draw_tasks.py docs/pictures/tasks` writes an SVG file for each task of `starl.env.tasks`. Rings are
where robots start, discs where they end; crosses are goals; a square is the thing that is carried.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from starl.env import Box, Task, VectorEnv, World, tasks

Floats = NDArray[np.float64]
#: The size of a picture and of its margin, pixels.
WIDTH, HEIGHT, EDGE = 240, 150, 12
COLORS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#b0763c", "#7a5ac8", "#a89a00"]


def limited(ways: Floats, most: float) -> Floats:
    """No longer than `most`."""
    length = np.linalg.norm(ways, axis=-1, keepdims=True)
    short: Floats = ways * np.minimum(1.0, most / np.maximum(length, 1e-9))
    return short


def apart(world: World, reach: float, side: float = 1.0) -> Floats:
    """Away from the others in reach and from pillars, and past them on the right."""
    here = world.positions[0]
    pillars = [(one.x, one.y) for one in world.settings.obstacles if not isinstance(one, Box)]
    others = np.concatenate([here, np.array(pillars).reshape(-1, 2)])
    away = here[:, None] - others[None]
    distance = np.linalg.norm(away, axis=-1)
    near = np.where((distance > 0) & (distance < reach), (reach - distance) / np.maximum(distance - 0.15, 0.02), 0.0)
    turned = np.stack([-away[..., 1], away[..., 0]], axis=-1)
    push: Floats = (near[..., None] * (away + side * turned)).sum(axis=1)
    return limited(push, 0.9)


def to_goals(world: World) -> Floats:
    return limited(2 * (world["goal"][0] - world.positions[0]), 0.5) + apart(world, 0.4)


def to_targets(world: World) -> Floats:
    """Each target in turn is given to the nearest robot that has none."""
    here, target = world.positions[0], world["target"][0].copy()
    distance = np.linalg.norm(here[:, None] - target[None], axis=-1)
    way = np.zeros_like(here)
    for _ in here:
        robot, which = np.unravel_index(np.argmin(distance), distance.shape)
        way[robot] = target[which] - here[robot]
        distance[robot], distance[:, which] = np.inf, np.inf
    return limited(3 * way, 0.6) + apart(world, 0.3)


def with_the_others(world: World) -> Floats:
    here, velocity = world.positions[0], world.velocities[0, :, :2]
    together = limited(0.5 * (here.mean(axis=0) - here), 0.25)
    return 0.5 * velocity.mean(axis=0) + together + np.array([0.3, 0.08]) + apart(world, 0.5, side=0.0)


def pursue(world: World) -> Floats:
    here = world.positions[0]
    evader, others = here[-1], here[:-1]
    ahead = evader + 0.5 * world.velocities[0, -1, :2]
    away = evader - others
    flight = (away / np.sum(away**2, axis=-1, keepdims=True)).sum(axis=0) - 0.4 * evader**3
    ways = np.concatenate([limited(4 * (ahead - others), 1.0), limited(flight, 1.0)[None]])
    return ways + apart(world, 0.45, side=2.0)


def carry(world: World) -> Floats:
    """Robots come to the thing, and bring it to its goal once two hold it."""
    here, thing, holds = world.positions[0], world["thing"][0], world["holds"][0] > 0
    gather = limited(3 * (thing - here), 0.6) + apart(world, 0.3)
    go = limited(world["goal"][0] - thing, 0.4) * (holds.sum() >= 2)
    return np.where(holds, go, gather)


CONTROLLERS: dict[str, Callable[[World], Floats]] = {
    "Navigation": to_goals,
    "Crossing": to_goals,
    "Dispersion": to_targets,
    "Flocking": with_the_others,
    "Transport": carry,
    "Pursuit": pursue,
}


def episode(task: Task, controller: Callable[[World], Floats], steps: int, seed: int) -> tuple[World, Floats, Floats]:
    """The world at the end, the places of robots and those of the thing: (steps, N or 1, 2)."""
    env = VectorEnv(task, 1, autoreset_mode=AutoresetMode.DISABLED)
    env.reset(seed=seed)
    world, carried = env.world, "thing" in task.points
    paths, thing = [world.positions[0].copy()], [world["thing"][0, :1].copy()] if carried else []
    actions = np.zeros(env.action_space.shape or ())
    for _ in range(steps):
        actions[0, :, :2] = np.clip(controller(world), -1, 1)
        _, _, terminated, _, _ = env.step(actions)
        paths.append(world.positions[0].copy())
        if carried:
            thing.append(world["thing"][0, :1].copy())
        if terminated[0]:
            break
    return world, np.stack(paths), np.stack(thing) if carried else np.zeros((0, 0, 2))


def line(points: Floats, closed: bool = False) -> str:
    """A path of SVG, without points that a straight line passes within half a pixel."""
    keep = [points[0]]
    for index in range(1, len(points) - 1):
        start, end = keep[-1], points[index + 1]
        (x, y), (to_x, to_y) = points[index] - start, end - start
        length, off = float(np.hypot(to_x, to_y)), abs(to_x * y - to_y * x)
        if off > 0.3 * length or np.linalg.norm(points[index] - start) > 30:
            keep.append(points[index])
    words = [f"{'L' if index else 'M'}{x:.1f} {y:.1f}" for index, (x, y) in enumerate([*keep, points[-1]])]
    return "".join(words) + ("Z" if closed else "")


def picture(task: Task, world: World, paths: Floats, thing: Floats) -> str:
    marks = [world[name][0] for name in ("goal", "target") if name in task.points]
    walls = task.settings.walls
    corners = [np.array(walls).reshape(2, 2)] if walls else []
    everything = np.concatenate([paths.reshape(-1, 2), thing.reshape(-1, 2), *marks, *corners])
    low, high = everything.min(axis=0), everything.max(axis=0)
    scale = float(np.min((np.array([WIDTH, HEIGHT]) - 2 * EDGE) / np.maximum(high - low, 0.5)))

    def place(points: Any) -> Floats:
        moved = (np.asarray(points) - (low + high) / 2) * [scale, -scale]
        return moved + [WIDTH / 2, HEIGHT / 2]

    parts = []
    if walls:
        (left, top), (right, bottom) = place([[walls[0], walls[3]], [walls[2], walls[1]]])
        parts.append(
            f'<rect x="{left:.1f}" y="{top:.1f}" width="{right - left:.1f}" height="{bottom - top:.1f}"'
            ' fill="none" stroke="#8b96a1"/>'
        )
    for one in task.settings.obstacles:
        assert not isinstance(one, Box)
        x, y = place([one.x, one.y])
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{one.radius * scale:.1f}" fill="#8b96a1"/>')
    for spot in np.unique(np.concatenate(marks), axis=0) if marks else []:
        x, y = place(spot)
        parts.append(f'<path d="M{x - 3:.1f} {y:.1f}h6m-3-3v6" stroke="#d81b60" stroke-width="1.4"/>')
    for robot in range(paths.shape[1]):
        color = COLORS[robot % len(COLORS)]
        way, radius = place(paths[:, robot]), float(world.radii[robot]) * scale
        parts.append(f'<path d="{line(way)}" fill="none" stroke="{color}" stroke-width="1.4"/>')
        (x, y), (to_x, to_y) = way[0], way[-1]
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" fill="none" stroke="{color}"/>')
        parts.append(f'<circle cx="{to_x:.1f}" cy="{to_y:.1f}" r="{radius:.1f}" fill="{color}" fill-opacity="0.85"/>')
    if len(thing):
        way = place(thing[:, 0])
        parts.append(f'<path d="{line(way)}" fill="none" stroke="#3c4650" stroke-dasharray="3 3"/>')
        for (x, y), fill in ((way[0], "none"), (way[-1], "#3c4650")):
            parts.append(f'<rect x="{x - 4:.1f}" y="{y - 4:.1f}" width="8" height="8" fill="{fill}" stroke="#3c4650"/>')
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}">'
    return head + "".join(parts) + "</svg>\n"


def pictures() -> dict[str, str]:
    """The picture of each task, by the name of its file."""
    drawn = {}
    for name, controller in CONTROLLERS.items():
        task: Task = getattr(tasks, name)()
        # With 12 robots a picture of a flock says more.
        task = tasks.Flocking(12) if name == "Flocking" else task
        steps = 60 if name == "Flocking" else 200
        drawn[f"{name.lower()}.svg"] = picture(task, *episode(task, controller, steps, SEEDS.get(name, 1)))
    return drawn


#: Episodes that show well what the task is about.
SEEDS = {"Dispersion": 4, "Pursuit": 3, "Transport": 10}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    folder: Path = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pictures().items():
        (folder / name).write_text(text)
        print(f"{name}: {len(text)} bytes")


if __name__ == "__main__":
    main()
