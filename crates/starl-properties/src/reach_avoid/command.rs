//! One command to a ReachAvoid, and whether its robot keeps out of the unsafe set.

use starl_core::motion::Obstacles;
use starl_core::{Point, Port, RobotId, Time};

/// A command, from its start until its end is reported.
#[derive(Clone, Debug)]
pub struct Command {
    pub port: Port,
    pub started: Time,
    /// The robot's target, moved to where the robot can be.
    pub target: Point,
    pub vicinity: f64,
    unsafe_set: Obstacles,
    pub phase: Phase,
    /// Where its safety was last judged.
    judged: Option<Point>,
    /// The robot was this far from the unsafe set, less what it has moved since, metres.
    clearance: f64,
    /// The robot was found in the unsafe set.
    entered: bool,
    /// It was found to take too long.
    pub overdue: bool,
}

/// How far a command is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Under way.
    Active,
    /// The robot says that it has entered the unsafe set; the next pose will show.
    Failed,
}

impl Command {
    /// The command that was given to an instance.
    pub fn new(
        (port, started): (Port, Time),
        target: Point,
        vicinity: f64,
        unsafe_set: Obstacles,
    ) -> Command {
        Command {
            port,
            started,
            target,
            vicinity,
            unsafe_set,
            phase: Phase::Active,
            judged: None,
            clearance: 0.0,
            entered: false,
            overdue: false,
        }
    }

    /// The violation if the robot has now entered the unsafe set; reported once. The way between two
    /// poses is assumed to be straight. The set is checked only if the robot can have reached it.
    pub fn check_safety(&mut self, at: Time, robot: RobotId, position: Point) -> Option<String> {
        let from = self.judged.replace(position).unwrap_or(position);
        self.clearance -= from.distance(position);
        if self.entered || self.clearance > 0.0 {
            return None;
        }
        self.clearance = f64::INFINITY;
        for (index, obstacle) in self.unsafe_set.iter().enumerate() {
            if obstacle.blocks_segment(from, position, 0.0) {
                self.entered = true;
                let way = at.since(self.started);
                return Some(format!(
                    "robot {robot} went from {from} to {position}, into obstacle {index} of the unsafe \
                     set of the command to {} that it was given {way} before",
                    self.target,
                ));
            }
            self.clearance = self.clearance.min(obstacle.distance(position));
        }
        None
    }
}
