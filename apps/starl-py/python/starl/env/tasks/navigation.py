"""Navigation with lidar: each robot has a goal of its own, and does not know where the others are or go."""

from starl.env._places import Places, Scatter
from starl.env._settings import Lidar, Settings
from starl.env._task import Task


class Navigation(Task):
    """Reward: metres by which a robot came nearer to its goal, less 1 for touching something. Done when all are there."""

    settings = Settings(10, parameters={"radius": 0.1}, lidar=Lidar(12, 0.35))
    starts: Places = Scatter(heading="random")
    points = {"goal": Scatter()}
    observe = "position", "heading", "velocity", "to goal", "lidar"
    reward = "distance(previous.position, goal) - distance(position, goal) - (if touched then 1.0 else 0.0)"
    terminated = "distance(position, goal) < radius"
    information = {"arrived": "distance(position, goal) < radius"}
