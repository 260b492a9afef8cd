"""Environments for learning: fleets of robots behind the interfaces of Gymnasium and PettingZoo.

A `Task` says where robots start, what they see and what they are rewarded for; `VectorEnv`, `ParallelEnv` and `Env` show it
to a learner. Robots move, collide and measure as in the simulator. Needs the packages `gymnasium` and `pettingzoo`:
`pip install starl[env]`.
"""

from starl._extras import needed

for _package in ("gymnasium", "pettingzoo"):
    needed(_package, "env")

from starl.env import tasks
from starl.env._parallel import ParallelEnv
from starl.env._places import Opposite, Places, Ring, Scatter
from starl.env._settings import Box, Circle, Lidar, Radio, Settings, Waypoints
from starl.env._single import Env
from starl.env._task import Task
from starl.env._vector import VectorEnv
from starl.env._world import World

__all__ = [
    "Box",
    "Circle",
    "Env",
    "Lidar",
    "Opposite",
    "ParallelEnv",
    "Places",
    "Radio",
    "Ring",
    "Scatter",
    "Settings",
    "Task",
    "VectorEnv",
    "Waypoints",
    "World",
    "tasks",
]
