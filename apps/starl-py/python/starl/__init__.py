"""StarL from Python: simulate, test and train fleets of robots.

Unless something else is said, times are seconds since the start of the run, lengths are metres, angles are radians, and
places are in one right-handed world frame with z up. Robots are numbers, from 0.
"""

from starl._campaign import CampaignResults, Failure, test
from starl._errors import Diagnostic, StarlError
from starl._faults import Draws
from starl._files import Program, Scenario, examples
from starl._handle import RobotHandle
from starl._primitives import (
    Barrier,
    Broadcast,
    FailureDetector,
    Geocast,
    LeaderElection,
    LocalBroadcast,
    Mutex,
    Primitive,
    ReachAvoid,
    Register,
    Registration,
    SharedMemory,
    Unicast,
)
from starl._properties import Fleet, Member, eventually, invariant
from starl._robots import RobotProgram
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
    "Draws",
    "Failure",
    "FailureDetector",
    "Fleet",
    "Geocast",
    "LeaderElection",
    "LocalBroadcast",
    "Member",
    "Mutex",
    "Primitive",
    "Program",
    "ReachAvoid",
    "Register",
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
    "eventually",
    "examples",
    "invariant",
    "read_trace",
    "sweep",
    "test",
]
