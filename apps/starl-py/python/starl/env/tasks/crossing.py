"""Crossing: robots stand in a ring, and all want to the other side at once."""

from starl.env._places import Opposite, Ring
from starl.env.tasks.navigation import Navigation


class Crossing(Navigation):
    """As `Navigation`, from evenly on a circle of radius `half` to the opposite places; the ring is turned at random."""

    starts = Ring()
    points = {"goal": Opposite()}
