"""StarL from Python: simulate, test and train fleets of robots.

Unless something else is said, times are seconds since the start of the run, lengths are metres, angles are radians, and
places are in one right-handed world frame with z up. Robots are numbers, from 0.
"""

from starl._campaign import CampaignResults, Failure, test
from starl._errors import Diagnostic, StarlError
from starl._files import Program, Scenario, examples
from starl._robots import (
    Barrier,
    Broadcast,
    FailureDetector,
    LeaderElection,
    LocalBroadcast,
    Mutex,
    Primitive,
    ReachAvoid,
    Registration,
    RobotHandle,
    RobotProgram,
    SharedMemory,
    Unicast,
)
from starl._show import Viewer
from starl._simulation import Robot, Simulation, Snapshot, Status
from starl._sweep import SweepResults, sweep
from starl._tables import Table
from starl._trace import Trace, read_trace

__all__ = [
    "Barrier",
    "Broadcast",
    "CampaignResults",
    "Diagnostic",
    "Failure",
    "FailureDetector",
    "LeaderElection",
    "LocalBroadcast",
    "Mutex",
    "Primitive",
    "Program",
    "ReachAvoid",
    "Registration",
    "Robot",
    "RobotHandle",
    "RobotProgram",
    "Scenario",
    "SharedMemory",
    "Simulation",
    "Snapshot",
    "StarlError",
    "Status",
    "SweepResults",
    "Table",
    "Trace",
    "Unicast",
    "Viewer",
    "examples",
    "read_trace",
    "sweep",
    "test",
]
