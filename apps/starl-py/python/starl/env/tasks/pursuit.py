"""Pursuit: several slower robots are to touch a faster one, within walls and between pillars."""

from typing import Any

from starl.env._settings import Circle
from starl.env._task import Task


class Pursuit(Task):
    """The last robot is the evader. Reward of the pursuers: 10 when it is caught, less 0.1 for each metre between it and the
    nearest of them; the evader gets the opposite. Done when it is caught."""

    values = {"evader": False}
    measures = {"caught: Bool": "exists r: r.evader and r.touched_robot"}
    observe = "position", "velocity", "to every position"
    reward = """(if evader then -1.0 else 1.0)
        * ((if caught then 10.0 else 0.0) - 0.1 * [r.nearest for r in peers if r.evader].sum())"""
    terminated = "caught"

    def __init__(self, pursuers: int = 3, *, half: float = 2.0, speed: float = 0.7, **more: Any) -> None:
        slow, fast = {"radius": 0.1, "speed": speed, "cruise_speed": min(speed, 0.5)}, {"radius": 0.1}
        pillars = [Circle(0.5 * half * x, 0.5 * half * y, 0.2) for x in (-1, 1) for y in (-1, 1)]
        own = {"parameters": [slow] * pursuers + [fast], "walls": (-half, -half, half, half), "obstacles": pillars}
        super().__init__(pursuers + 1, half=half, evader=[False] * pursuers + [True], **{**own, **more})
