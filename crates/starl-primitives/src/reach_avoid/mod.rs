//! ReachAvoid: go to a target, keep out of an unsafe set (thesis, section 3.2).
//!
//! It asks the host's planner for a path from where the robot has stopped, and passes its points to
//! the waypoint tracker one by one. It replans when the robot is pushed off the path or to where the
//! straight line is not free, when it makes no progress, and when an unknown obstacle is in the way.
//! Properties, under the thesis's assumptions (the actuators do not fail, positions are accurate to
//! half the vicinity, a path of some width exists):
//! - safety: the robot's position stays outside the unsafe set; where it does not, it has failed;
//! - goal: when it is done the robot has been within the vicinity of the target;
//! - wind: where it is stronger than the robot can hold against, the command has failed, also when it was done
//!   and the robot holds its target;
//! - progress: it is not active for ever. In each [`Options::stuck_after`] the way ahead shrinks by
//!   [`Options::least_progress`], or the turn that a robot on the ground has to make towards its next waypoint by 2
//!   degrees, or a re-plan is spent; there are [`Options::most_replans`] of them.
//!
//! [`ReachAvoid::drive_lane`] follows a line up to a limit that can be moved, at a distance from the robots on it.
//!
//! The flags are the thesis's: `active` while it is under way, `done`, `failed`, and none of them once
//! it has given up.

mod corrupt;
mod following;
mod lane;
mod options;
mod planning;
mod route;

pub use options::Options;

use alloc::boxed::Box;
use following::Mark;
use lane::Lane;
use route::Route;
use starl_core::event::ReachAvoidEvent;
use starl_core::event::moving::Trouble;
use starl_core::motion::Obstacles;
use starl_core::{Input, Point, Port, Primitive, Robot, Time, TimerKey, timers};

timers! {
    enum Alarm {
        /// The phase of the command has lasted long enough.
        TimeOut,
    }
}

/// Drives the robot to targets, around unsafe sets.
// In this order, since the first fields are read at each activation and the next at each estimate.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct ReachAvoid {
    /// The lane that the robot drives in; then the command is a part of it.
    lane: Option<Box<Lane>>,
    done: bool,
    failed: bool,
    /// Why the last command failed or was given up.
    reason: Option<Trouble>,
    port: Port,
    /// The command under way; none if inactive.
    command: Option<Command>,
    options: Options,
    /// The number of the last request to the planner.
    ticket: u32,
}

/// A command under way.
#[derive(Clone, Debug)]
struct Command {
    /// As given; the robot goes as near as it can be.
    target: Point,
    unsafe_set: Obstacles,
    /// The obstacles that the robot knew when it planned.
    known: Obstacles,
    phase: Phase,
    replans: u32,
    /// How often in a row no path was found.
    plan_failures: u32,
}

#[derive(Clone, Debug)]
enum Phase {
    /// The robot stops; then it asks for a path.
    Braking { around_robots: bool },
    /// The planner is to answer.
    Planning,
    /// The robot is on its way.
    Following {
        route: Route,
        /// The part of the route that was left when the time-out for progress began.
        mark: Mark,
        /// When the path was found.
        since: Time,
    },
    /// No path was found; it waits to try again.
    Pausing,
}

impl Default for ReachAvoid {
    fn default() -> ReachAvoid {
        ReachAvoid::new("reach_avoid", Options::default())
    }
}

impl ReachAvoid {
    /// An instance under this name.
    pub fn new(name: &str, options: Options) -> ReachAvoid {
        let port = Port::named(name);
        // Instances of other names count their tickets from elsewhere.
        ReachAvoid {
            port,
            options,
            command: None,
            lane: None,
            done: false,
            failed: false,
            reason: None,
            ticket: port.0,
        }
    }

    /// Goes to the target and keeps out of the unsafe set (the thesis's doReachAvoid); a command still
    /// under way is dropped. The target is put where the robot can be
    /// ([`starl_core::motion::Body::reachable`]). If it is not finite the command is given up at once;
    /// if the robot is in the unsafe set it has failed.
    pub fn reach_avoid(&mut self, robot: &mut Robot<'_>, target: Point, unsafe_set: Obstacles) {
        self.lane = None;
        let was_active = self.clear();
        if was_active {
            robot.halt();
        }
        if self.begin(robot, target, unsafe_set) {
            self.plan(robot, false);
        }
    }

    /// Goes to the last of these points through the others, straight from each to the next, and keeps out of the unsafe
    /// set (the sequence of points that the thesis's intersection sends to its motion control). It neither stops at the
    /// points nor before it sets out, so a robot that is under way drives on. Points are passed as those of a planned
    /// path are. Where one of the straight ways is not free a path to the last point is planned, and so whenever one
    /// has to be planned again. Without points it is given up at once.
    pub fn follow(&mut self, robot: &mut Robot<'_>, points: &[Point], unsafe_set: Obstacles) {
        self.lane = None;
        self.set_out_along(robot, points, unsafe_set);
    }

    /// Goes over these points.
    fn set_out_along(&mut self, robot: &mut Robot<'_>, points: &[Point], unsafe_set: Obstacles) {
        let Some(&target) = points.last() else {
            self.clear();
            return self.give_up(robot, Trouble::NoPoints);
        };
        let was_active = self.clear();
        if !self.begin(robot, target, unsafe_set) {
            return;
        }
        match self.given_route(robot, points) {
            Some(route) => self.set_out(robot, route),
            None => {
                if was_active {
                    robot.halt();
                }
                self.plan(robot, false);
            }
        }
    }

    /// Takes a command; says whether there is a way to be found for it.
    fn begin(&mut self, robot: &mut Robot<'_>, target: Point, unsafe_set: Obstacles) -> bool {
        let start = ReachAvoidEvent::Start {
            target,
            vicinity: self.options.vicinity,
            unsafe_set: unsafe_set.clone(),
        };
        robot.report(self.port, start);
        if !target.is_finite() {
            self.give_up(robot, Trouble::NotFinite);
            return false;
        }
        self.command = Some(Command {
            target,
            unsafe_set,
            known: robot.obstacles(),
            phase: Phase::Braking {
                around_robots: false,
            },
            replans: 0,
            plan_failures: 0,
        });
        !self.check_safety(robot)
    }

    /// Stops and stays; all flags become false.
    pub fn stop(&mut self, robot: &mut Robot<'_>) {
        self.lane = None;
        if self.clear() {
            robot.cancel_timer(self.timer());
            robot.report(self.port, ReachAvoidEvent::Stop);
        }
        robot.halt();
    }

    /// Whether a command is under way. In a lane it is until the robot comes to the limit, also while it waits.
    pub fn active(&self) -> bool {
        match self.is_at_limit() {
            Some(is_at_limit) => !is_at_limit,
            None => self.command.is_some(),
        }
    }

    /// Where the command under way leads, as it was given, metres; none if there is none.
    pub fn target(&self) -> Option<Point> {
        self.command.as_ref().map(|command| command.target)
    }

    /// Whether the last command brought the robot to the vicinity of its target, in a lane to its limit.
    pub fn done(&self) -> bool {
        self.is_at_limit().unwrap_or(self.done)
    }

    /// Whether the robot entered the unsafe set during the last command, or the wind is stronger than it can hold
    /// against.
    pub fn failed(&self) -> bool {
        self.failed
    }

    /// Why the last command failed or was given up; none while one is under way, and where it did neither.
    pub fn reason(&self) -> Option<Trouble> {
        self.reason
    }

    /// Where the path under way starts, then its waypoints, metres.
    pub fn path(&self) -> Option<&[Point]> {
        match &self.command.as_ref()?.phase {
            Phase::Following { route, .. } => Some(route.points()),
            _ => None,
        }
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Drops the command and all flags; says whether one was under way.
    fn clear(&mut self) -> bool {
        (self.done, self.failed, self.reason) = (false, false, None);
        self.command.take().is_some()
    }

    /// The wind is stronger than the robot can hold against.
    fn blown_away(&mut self, robot: &mut Robot<'_>) {
        self.done = false;
        self.give_up(robot, Trouble::Wind);
        self.failed = true;
    }

    /// The one timer: what it is for depends on the phase.
    fn timer(&self) -> TimerKey {
        TimerKey::new(self.port, Alarm::TimeOut)
    }
}

impl Primitive for ReachAvoid {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        if matches!(input, Input::Activate) {
            return self.look_ahead(robot);
        }
        let Some(command) = &self.command else {
            // The robot holds its target, and is blown off it.
            if self.done && matches!(input, Input::Overpowered) {
                self.blown_away(robot);
            }
            return;
        };
        match input {
            Input::Estimate => self.located(robot),
            Input::Timer(key) if *key == self.timer() => self.timed_out(robot),
            Input::Planned { ticket, path }
                if *ticket == self.ticket && matches!(command.phase, Phase::Planning) =>
            {
                self.planned(robot, path.as_ref());
            }
            Input::Overpowered => self.blown_away(robot),
            _ => {}
        }
    }
}
