"""Programs in Python that other processes import."""

from typing import Any

import starl


class Hasty(starl.RobotProgram):
    """Promises not to hear much, and speaks ten times itself."""

    def __init__(self) -> None:
        self.radio = starl.Broadcast()
        self.heard = 0
        self.spoken = 0

    def activate(self, robot: starl.RobotHandle) -> None:
        if self.spoken < 10:
            self.radio.broadcast(robot, self.spoken)
            self.spoken += 1
        else:
            robot.finish()

    def receive(self, robot: starl.RobotHandle, sender: int, message: Any, primitive: starl.Primitive | None) -> None:
        self.heard += sender != robot.id

    @starl.invariant
    def shy(fleet: starl.Fleet["Hasty"]) -> str | None:
        loud = [member for member in fleet.members if member.program.heard >= 5]
        return f"robot {loud[0].id} has heard {loud[0].program.heard}" if loud else None

    @starl.eventually(within=10.0)
    def all_spoke(fleet: starl.Fleet["Hasty"]) -> bool:
        return all(member.program.spoken == 10 for member in fleet.members)
