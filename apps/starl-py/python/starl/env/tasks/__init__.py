"""Tasks that people compare on, each about ten lines to read and to change."""

from starl.env.tasks.crossing import Crossing
from starl.env.tasks.dispersion import Dispersion
from starl.env.tasks.flocking import Flocking
from starl.env.tasks.navigation import Navigation
from starl.env.tasks.pursuit import Pursuit
from starl.env.tasks.transport import Transport

__all__ = ["Crossing", "Dispersion", "Flocking", "Navigation", "Pursuit", "Transport"]
