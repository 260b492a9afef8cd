"""Pursuit: several slower robots are to touch a faster one, within walls and between pillars."""

from starl.env._settings import Circle, Settings
from starl.env._task import Task


class Pursuit(Task):
    """The last robot is the evader. Reward of the pursuers: 10 when it is caught, less 0.1 for each metre between it and the
    nearest of them; the evader gets the opposite. Done when it is caught."""

    pillars = [Circle(x, y, 0.2) for x in (-1, 1) for y in (-1, 1)]
    settings = Settings(4, parameters={"radius": 0.1, "speed": [0.7, ..., 1.0]}, walls=(-2, -2, 2, 2), obstacles=pillars)
    half = 2.0
    values = {"evader": [False, ..., True], "side": [1.0, ..., -1.0]}
    measures = {"caught: Bool": "exists r: r.evader and r.touched_robot"}
    observe = "position", "velocity", "to every position"
    reward = "side * ((if caught then 10.0 else 0.0) - 0.1 * [r.nearest for r in peers if r.evader].sum())"
    terminated = "caught"
