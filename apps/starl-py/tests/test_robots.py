"""Robots programmed in Python."""

import threading
from typing import Any

import pytest

import starl


class Race(starl.RobotProgram):
    """The Race of the thesis (figure 2.1)."""

    def __init__(self) -> None:
        self.motion = starl.ReachAvoid()
        self.radio = starl.Broadcast()
        self.current = 0
        self.moving = False

    def activate(self, robot: starl.RobotHandle) -> None:
        points = robot.way_points
        if self.current == len(points):
            robot.action("finish")
            self.motion.stop(robot)
            robot.finish()
        elif not self.moving or not (self.motion.active or self.motion.done):
            robot.action("pick")
            self.motion.reach_avoid(robot, points[self.current][1])
            self.moving = True
        elif self.motion.done:
            robot.action("wait")
            self.radio.broadcast(robot, {"reached": self.current})
            self.current += 1
            self.moving = False

    def receive(self, robot: starl.RobotHandle, sender: int, message: Any, primitive: starl.Broadcast | None) -> None:  # type: ignore[override]
        assert primitive is self.radio
        if message["reached"] >= self.current:
            self.current = message["reached"] + 1
            self.moving = False


def race(seed: int = 7, **fields: Any) -> starl.Simulation:
    return starl.Simulation(starl.Scenario("race", program=Race(), **fields), seed=seed)


def test_race_in_python_reaches_its_goal_and_keeps_all_properties() -> None:
    simulation = race()
    simulation.run()
    assert simulation.outcome == "reached"
    assert {robot.program for robot in simulation.robots} == {"Race"}
    assert not [one for one in simulation.report()["properties"] if one["verdict"] == "violated"]


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_runs_repeat_and_snapshots_are_exact(seed: int) -> None:
    first, second = race(seed, network={"loss": 0.3}), race(seed, network={"loss": 0.3})
    first.run()
    second.run(3.0)
    kept = second.snapshot()
    second.run(6.0)
    second.restore(kept)
    second.run()
    assert first.digest == second.digest and first.outcome == "reached"


def test_a_restarted_robot_has_a_fresh_copy() -> None:
    simulation = race()
    simulation.crash(0, at=5.0)
    simulation.restart(0, at=6.0)
    simulation.run()
    assert simulation.outcome == "reached"
    picks = simulation.records("action").to_polars()
    assert len(picks) > 8


def test_the_same_object_serves_many_simulations() -> None:
    program = Race()
    scenario = starl.Scenario("race", program=program)
    digests = set()
    for _ in range(2):
        simulation = starl.Simulation(scenario, seed=7)
        simulation.run()
        digests.add(simulation.digest)
    assert len(digests) == 1 and program.current == 0


class Broken(starl.RobotProgram):
    def activate(self, robot: starl.RobotHandle) -> None:
        if robot.now > 1.0:
            raise KeyError("no such thing")


def test_an_exception_fails_the_robot_and_names_its_line() -> None:
    simulation = starl.Simulation(starl.Scenario("race", program=Broken()))
    simulation.run()
    assert simulation.outcome == "failed"
    assert "test_robots.py:" in simulation.report()["failures"][0]["text"]
    assert "no such thing" in simulation.report()["failures"][0]["text"]


LANE = """
program = "race"
duration = "20s"
motion = { avoidance = false }

[[robots]]
model = "create"
count = 2
sensors = { detector = { range = "3m" } }
start = [{ position = [0, 0] }, { position = [3, 0] }]
"""


class Lane(starl.RobotProgram):
    """Robot 0 drives in a lane in which robot 1 stands."""

    def __init__(self) -> None:
        self.motion = starl.ReachAvoid(gap=1.0)
        self.line: list[tuple[float, ...]] = [(0, 0), (5, 0), (5, 5, 0)]
        self.along: list[float] = []

    def activate(self, robot: starl.RobotHandle) -> None:
        if robot.id == 0:
            self.motion.drive_lane(robot, self.line, until=8.0)
            self.along.append(self.motion.along)


def test_a_robot_in_a_lane_stops_before_one_that_stands_in_it() -> None:
    simulation = starl.Simulation(starl.Scenario.from_text(LANE, program=Lane()))
    simulation.run()
    driven, standing = simulation.poses[:, 0]
    assert standing == 3.0
    # It stops between 0 and 0.6 m before the gap of 1 m.
    assert 1.0 <= standing - driven <= 1.7
    assert simulation.report()["failures"] == []


@pytest.mark.parametrize(
    ("line", "until", "problem"),
    [([], 1.0, "line: give at least one point"), ([(0, float("nan"))], 1.0, "line"), ([(0, 0)], float("inf"), "until")],
)
def test_a_lane_without_a_line_is_refused(line: list[tuple[float, float]], until: float, problem: str) -> None:
    class Wrong(starl.RobotProgram):
        def __init__(self) -> None:
            self.motion = starl.ReachAvoid()

        def activate(self, robot: starl.RobotHandle) -> None:
            self.motion.drive_lane(robot, line, until)

    simulation = starl.Simulation(starl.Scenario(program=Wrong(), robots="create=1", duration="1s"))
    simulation.run()
    assert problem in simulation.report()["failures"][0]["text"]


class Primitives(starl.RobotProgram):
    """Uses every primitive."""

    def __init__(self) -> None:
        self.mutex = starl.Mutex(algorithm="quorum")
        self.election = starl.LeaderElection()
        self.detector = starl.FailureDetector()
        self.registration = starl.Registration()
        self.barrier = starl.Barrier()
        self.memory = starl.SharedMemory()
        self.mail = starl.Unicast()
        self.local = starl.LocalBroadcast()
        self.heard: list[Any] = []
        self.stage = 0
        self.entered = False

    def start(self, robot: starl.RobotHandle) -> None:
        self.barrier.arrive(robot)
        self.election.elect(robot)
        self.registration.register(robot)
        self.mutex.acquire(robot, ["door"])
        self.local.broadcast(robot, ["hello", robot.id, robot.random()])
        if robot.id == 0:
            self.memory.write(robot, "colour", {"red": 1})

    def activate(self, robot: starl.RobotHandle) -> None:
        if self.mutex.held:
            robot.action("enter")
            self.entered = True
            self.mutex.release(robot, ["door"])
        if self.stage == 0 and self.barrier.passed and self.election.leader is not None:
            self.stage = 1
            self.mail.send(robot, self.election.leader, f"from {robot.id}")
        members = self.registration.members
        ready = self.entered and self.stage == 1 and members == robot.fleet
        if ready and self.memory.read("colour") == {"red": 1} and len(self.heard) >= len(robot.fleet) - 1:
            robot.finish()

    def receive(self, robot: starl.RobotHandle, sender: int, message: Any, primitive: starl.Primitive | None) -> None:
        if primitive is self.local:
            assert message[1] == sender and 0 <= message[2] < 1
            self.heard.append(message)


@pytest.mark.parametrize("robots", [2, 5])
def test_every_primitive_works(robots: int) -> None:
    scenario = starl.Scenario("race", program=Primitives(), robots=f"create={robots}")
    simulation = starl.Simulation(scenario)
    simulation.run()
    failures = simulation.report()["failures"]
    assert simulation.outcome == "reached", failures
    used = [one["property"] for one in simulation.report()["properties"] if one["verdict"] == "holds"]
    assert {"mutex.safety", "barrier.safety", "unicast.integrity"} <= set(used)


class Keeper(starl.RobotProgram):
    kept: list[starl.RobotHandle] = []

    def activate(self, robot: starl.RobotHandle) -> None:
        Keeper.kept.append(robot)


def test_a_handle_that_outlives_its_call_is_refused() -> None:
    simulation = starl.Simulation(starl.Scenario("race", program=Keeper(), robots="create=1"))
    simulation.run(0.5)
    with pytest.raises(RuntimeError, match="has returned"):
        Keeper.kept[0].finish()


def test_another_thread_may_look_while_a_program_in_python_runs() -> None:
    simulation = race()
    thread = threading.Thread(target=simulation.run)
    thread.start()
    while thread.is_alive():
        assert simulation.poses.shape == (4, 7)
    thread.join()
    assert simulation.outcome == "reached"


def test_bad_options_and_unbound_primitives_are_refused() -> None:
    class Bad(starl.RobotProgram):
        def __init__(self) -> None:
            self.motion = starl.ReachAvoid(vicinity=-1.0)

    with pytest.raises(starl.StarlError, match="motion: vicinity"):
        starl.Scenario("race", program=Bad())
    with pytest.raises(starl.StarlError, match="belongs to no running program"):
        starl.ReachAvoid().active  # noqa: B018


class Geocaster(starl.RobotProgram):
    """Robot 0 tells those near it; who hears is finished."""

    def __init__(self) -> None:
        self.near = starl.Geocast()
        self.spoke = False

    def activate(self, robot: starl.RobotHandle) -> None:
        if robot.id == 0 and not self.spoke:
            self.spoke = True
            self.near.geocast(robot, "here", center=(0.0, 0.0), radius=1.5)
            self.near.geocast(robot, "there", low=(2.5, -1, -1), high=(3.5, 1, 1))

    def receive(self, robot: starl.RobotHandle, sender: int, message: Any, primitive: starl.Primitive | None) -> None:
        assert primitive is self.near and sender == 0
        robot.action(message)


def test_geocast_reaches_the_robots_in_an_area() -> None:
    floor = """
duration = "5s"
goal = "duration"

[[robots]]
model = "create"
count = 4
start = [{ position = [0, 0] }, { position = [1, 0] }, { position = [2, 0] }, { position = [3, 0] }]
"""
    simulation = starl.Simulation(starl.Scenario.from_text(floor, program=Geocaster()))
    simulation.run()
    heard = simulation.records("action").to_polars()
    assert heard.sort("robot").select("robot", "name").rows() == [(1, "here"), (3, "there")]


class Counting(starl.RobotProgram):
    """Robots write a register, read it, and agree in the end."""

    def __init__(self) -> None:
        self.shared = starl.Register()
        self.operation: int | None = None
        self.wrote = False
        self.seen: Any = None

    def activate(self, robot: starl.RobotHandle) -> None:
        if self.operation is None:
            value = {"from": robot.id}
            self.operation = self.shared.read(robot, "x") if self.wrote or robot.id else self.shared.write(robot, "x", value)
        elif self.shared.status(self.operation) == "done":
            self.wrote = True
            self.seen = self.shared.value(self.operation)
            self.operation = None
            if self.seen == {"from": 0}:
                robot.finish()


@pytest.mark.parametrize("loss", [0.0, 0.3])
def test_registers_are_read_and_written(loss: float) -> None:
    scenario = starl.Scenario("race", program=Counting(), network={"loss": loss})
    simulation = starl.Simulation(scenario)
    simulation.run()
    assert simulation.outcome == "reached", simulation.report()["failures"]
    verdicts = {one["property"]: one["verdict"] for one in simulation.report()["properties"]}
    assert "violated" not in verdicts.values()
    assert [name for name, verdict in verdicts.items() if name.startswith("register.") and verdict == "holds"]


class Obedient(starl.RobotProgram):
    def told(self, robot: starl.RobotHandle, name: str, fields: dict[str, Any]) -> None:
        robot.log(f"{name} {fields}")
        if name == "stop":
            robot.finish()


def test_orders_of_an_operator_arrive_with_their_fields() -> None:
    simulation = starl.Simulation(starl.Scenario("race", program=Obedient(), robots="create=2"))
    simulation.tell("go", 1, to=(1.0, 2.0, 0.5), count=3, fast=True, who="me")
    simulation.set_way_point("X", (1.0, 1.0))
    simulation.tell("stop", at=2.0)
    simulation.run()
    assert simulation.outcome == "reached"
    said = simulation.records("log").to_polars()
    texts = said.filter(said["robot"] == 1)["text"].to_list()
    assert any(text.startswith("go {") and "'count': 3" in text and "'fast': True" in text for text in texts), texts
    assert any(text.startswith("way_points") for text in texts), texts


SPEAKER = """program Speaker

message Hello(count: Int)

radio = Broadcast(name = "radio")
said: Bool = false

hello()
    pre not said
    eff radio.broadcast(Hello(3)); said = true; finish()
"""


class Listener(starl.RobotProgram):
    def __init__(self) -> None:
        self.radio = starl.Broadcast()

    def activate(self, robot: starl.RobotHandle) -> None:
        robot.finish()

    def receive(self, robot: starl.RobotHandle, sender: int, message: Any, primitive: starl.Primitive | None) -> None:
        raise AssertionError("it is not for this program")


def test_a_message_of_a_program_of_the_language_is_ignored_and_logged() -> None:
    text = """
duration = "5s"
goal = "duration"

[[robots]]
model = "create"
program = "Listener"
start = [{ position = [0, 0] }]

[[robots]]
model = "holonomic"
program = "speaker.starl"
start = [{ position = [1, 0] }]
"""
    scenario = starl.Scenario.from_text(text, files={"speaker.starl": SPEAKER}, program=Listener())
    simulation = starl.Simulation(scenario)
    simulation.run()
    assert not simulation.report()["failures"]
    logged = simulation.records("log").to_polars()["text"].to_list()
    assert logged == ["a message of robot 1 is ignored: it is not of a program in Python"]
