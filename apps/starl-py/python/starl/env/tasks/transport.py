"""Transport: a thing too heavy for one robot is to be brought to a place."""

from starl.env._places import Scatter
from starl.env._settings import Settings
from starl.env._task import Task
from starl.env._world import World


class Transport(Task):
    """Robots near the thing hold it; while at least `carriers` do, it moves with their mean velocity. It is no body: robots
    pass under it. Reward: metres by which the thing came nearer to its goal, and a tenth of those by which a robot came
    nearer to the thing. Done when it is there."""

    settings = Settings(4, parameters={"radius": 0.1})
    half = 1.5
    values = {"carriers": 2, "reach": 0.3}
    points = {"thing": Scatter(shared=True), "goal": Scatter(shared=True)}
    measures = {"left": "distance(thing, goal)", "way": "distance(position, thing)", "holds: Bool": "way < reach"}
    observe = "position", "velocity", "to thing", "thing to goal", "holds"
    reward = "previous.left - left + 0.1 * (previous.way - way)"
    terminated = "left < 0.1"

    def advance(self, world: World) -> None:
        world["thing"] += world.seconds * world.mean("velocity", where="holds", least="carriers")
