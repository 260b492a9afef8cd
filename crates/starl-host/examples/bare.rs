//! A node without an operating system: a fixed program, and the loop of a firmware around it.
//!
//! The firmware has a clock, a radio and positioning; it owns nothing of how a robot's software is run.
//! `make portable` checks that this builds for a Cortex-M4.

#![no_std]
extern crate alloc;

use alloc::boxed::Box;
use alloc::vec::Vec;
use starl_core::motion::{Body, Obstacles, Workspace as Space};
use starl_core::{
    Agent, Command, Destination, Duration, Estimate, Event, Message, Port, Primitives, Program,
    Random, Robot, RobotId, Sensors, Time,
};
use starl_host::{
    Clock, Datagram, Hardware, Node, NodeInput, Outlet, PlanJob, Snapshot, Workspace,
};
use starl_motion::Neighbour;

/// Tells all robots when it is activated, and counts what it hears.
#[derive(Clone, Default, Primitives)]
struct Beacon {
    heard: u32,
}

impl Program for Beacon {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        robot.transmit(Destination::All, Port::PROGRAM, &now);
    }

    fn receive(&mut self, robot: &mut Robot<'_>, _: &Message) {
        self.heard += 1;
        robot.emit("heard", [("count", self.heard.into())]);
    }
}

/// The interface of the firmware.
pub trait Board {
    /// Nanoseconds since it was switched on.
    fn now(&self) -> Time;
    /// Waits until this time at the latest, or until the radio has heard something, which it gives.
    fn wait(&mut self, until: Time) -> Option<(u32, Message)>;
    /// Sends a datagram.
    fn send(&mut self, datagram: &Datagram);
    /// Where the robot is.
    fn estimate(&self) -> Estimate;
    /// Sets the motors.
    fn command(&mut self, command: Command);
}

struct Wires<'a, B> {
    board: &'a mut B,
    workspace: &'a mut Workspace,
}

impl<B: Board> Outlet for Wires<'_, B> {
    fn workspace(&mut self) -> &mut Workspace {
        self.workspace
    }

    /// A robot of this size keeps no records.
    fn record(&mut self, _: Time, _: Event) {}

    fn transmit(&mut self, _: Time, datagram: Datagram) {
        self.board.send(&datagram);
    }

    /// It has no planner: a program that asks for a path gets none.
    fn plan(&mut self, _: Time, _: PlanJob) {}

    fn neighbours(&mut self, _: f64, _: &mut Vec<Neighbour>) {}
}

/// Runs a robot until its program fails.
pub fn run<B: Board>(id: RobotId, fleet: &[RobotId], board: &mut B) {
    let agent = Agent::new(Box::new(Beacon::default()), Random::keyed(1, &[]));
    let mut node = Node::new(id, Clock::default(), agent, board.now());
    let mut workspace = Workspace::default();
    let hardware = Hardware {
        body: Body {
            radius: 0.05,
            height: 0.03,
            workspace: Space::Ground,
        },
        control_period: Duration::from_millis(100),
        drive: None,
    };
    let obstacles: Obstacles = [].into();
    let snapshot = Snapshot {
        hardware: &hardware,
        sensors: Sensors::default(),
        fleet,
        way_points: &[],
        obstacles: &obstacles,
    };
    let mut happening = NodeInput::Start;
    while node.runs() {
        let (now, estimate) = (board.now(), board.estimate());
        let workspace = &mut workspace;
        let mut wires = Wires { board, workspace };
        node.locate(now, estimate, &mut wires);
        node.handle(now, happening, &snapshot, &mut wires);
        board.command(node.command());
        happening = match board.wait(node.next_timeout()) {
            Some((sequence, message)) => NodeInput::Datagram { sequence, message },
            None => NodeInput::Timeout,
        };
    }
}
