"""Dispersion: robots start in the middle and spread over as many targets, each of which one robot is to visit."""

from starl.env._places import Scatter
from starl.env._settings import Settings
from starl.env._task import Task


class Dispersion(Task):
    """Reward: 1 for each target that a robot visits first; robots that come together share it. Done when all are visited."""

    settings = Settings(4, parameters={"radius": 0.1})
    starts = Scatter(room=0.5, gap=0.22)
    points = {"target": Scatter(room=1.5)}
    measures = {
        "visitors": "Float([r for r in peers if distance(r.position, target) < r.radius].size())",
        "visited: Bool": "steps > 0 and (previous.visited or visitors > 0.0)",
    }
    observe = "position", "velocity", "to every target", "every visited"
    reward = "[1.0 / t.visitors for t in peers if not t.previous.visited and distance(position, t.target) < radius].sum()"
    terminated = "visited"
