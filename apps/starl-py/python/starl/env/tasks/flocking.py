"""Flocking: robots learn to move the same way, near each other, without touching."""

from starl.env._settings import Lidar, Radio, Settings
from starl.env._task import Task


class Flocking(Task):
    """Reward: the speed of the flock as a part of the greatest, less the distance to the nearest other beyond `spacing`,
    less 1 for touching something. Robots hear two numbers from each neighbour in range."""

    settings = Settings(6, parameters={"radius": 0.1}, lidar=Lidar(12, 1.0), radio=Radio(2, range=2.0))
    half = 1.5
    values = {"spacing": 0.5}
    measures = {"flock_speed": "distance(mean_velocity, Point(0.0, 0.0))"}
    observe = "velocity", "heard", "lidar"
    reward = "flock_speed / top_speed - max(nearest - spacing, 0.0) - (if touched then 1.0 else 0.0)"
