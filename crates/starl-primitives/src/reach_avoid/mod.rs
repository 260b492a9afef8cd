//! ReachAvoid: go to a target, keep out of an unsafe set (thesis, section 3.2).
//!
//! It asks the host's planner for a path and feeds its points to the way-point tracker one by one. It
//! plans again when the robot is pushed off the path, when it comes no further, and when an obstacle
//! that it had not known is in the way. Properties, under the thesis's assumptions (the actuators do
//! not fail, positions are accurate to half the vicinity, a path of some width exists):
//! - safety: the robot's position stays outside the unsafe set; where it does not, it has failed;
//! - goal: when it is done the robot has been within the vicinity of the target;
//! - progress: it is not active for ever. In each [`Options::stuck_after`] the way ahead shrinks by
//!   [`Options::least_progress`] or a re-plan is spent; there are [`Options::most_replans`] of them.
//!
//! The flags are the thesis's: `active` while it is under way, `done`, `failed`, and none of them once
//! it has given up.

mod options;
mod route;

pub use options::Options;

use alloc::vec::Vec;
use route::Route;
use starl_core::motion::{Body, Obstacles, Path, PlanRequest};
use starl_core::{Input, Obstacle, Point, Port, Primitive, Robot, TimerKey, Value};

const KIND: &str = "reach_avoid";

/// Drives the robot to targets, around unsafe sets.
#[derive(Clone, Debug)]
pub struct ReachAvoid {
    port: Port,
    options: Options,
    /// The command under way; none if inactive.
    command: Option<Command>,
    done: bool,
    failed: bool,
    /// The number of the last request to the planner.
    ticket: u32,
}

/// A command under way.
#[derive(Clone, Debug)]
struct Command {
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
    /// The planner is to answer.
    Planning,
    /// The robot is on its way.
    Following {
        route: Route,
        /// How far it had to go when the time-out for progress began, metres.
        mark: f64,
    },
    /// No path was found; it waits to try again.
    Pausing,
}

impl Default for ReachAvoid {
    fn default() -> ReachAvoid {
        ReachAvoid::new(KIND, Options::default())
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
            done: false,
            failed: false,
            ticket: port.0,
        }
    }

    /// Goes to the target and keeps out of the unsafe set (the thesis's doReachAvoid); a command still
    /// under way is dropped. The target is put where the robot can be: [`Body::reachable`]. If it is
    /// not finite the command is given up at once; if the robot is in the unsafe set it has failed.
    pub fn reach_avoid(&mut self, robot: &mut Robot<'_>, target: Point, unsafe_set: Obstacles) {
        let was_active = self.clear();
        if was_active {
            robot.halt();
        }
        self.report(
            robot,
            "start",
            [
                ("target", target.into()),
                ("vicinity", self.options.vicinity.into()),
                ("unsafe_set", unsafe_set.clone().into()),
            ],
        );
        if !target.is_finite() {
            return self.give_up(robot, "target is not finite");
        }
        self.command = Some(Command {
            target: robot.body().reachable(target),
            unsafe_set,
            known: robot.obstacles(),
            phase: Phase::Planning,
            replans: 0,
            plan_failures: 0,
        });
        if !self.check_safety(robot) {
            self.plan(robot, false);
        }
    }

    /// Stops and stays; all flags become false.
    pub fn stop(&mut self, robot: &mut Robot<'_>) {
        if self.clear() {
            robot.cancel_timer(self.timer());
            self.report(robot, "stop", []);
        }
        robot.halt();
    }

    /// Whether a command is under way.
    pub fn active(&self) -> bool {
        self.command.is_some()
    }

    /// Whether the last command brought the robot to the vicinity of its target.
    pub fn done(&self) -> bool {
        self.done
    }

    /// Whether the robot entered the unsafe set during the last command.
    pub fn failed(&self) -> bool {
        self.failed
    }

    /// Where the path under way starts, then its way-points, metres.
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
        (self.done, self.failed) = (false, false);
        self.command.take().is_some()
    }

    /// Asks for a path from here.
    fn plan(&mut self, robot: &mut Robot<'_>, around_robots: bool) {
        let timer = self.timer();
        let Some(command) = &mut self.command else {
            return;
        };
        command.phase = Phase::Planning;
        command.known = robot.obstacles();
        self.ticket = self.ticket.wrapping_add(1);
        let random = robot.random();
        let seed = u64::from(random.bits()) << 32 | u64::from(random.bits());
        robot.plan(PlanRequest {
            ticket: self.ticket,
            target: command.target,
            vicinity: self.options.vicinity,
            unsafe_set: union(&command.unsafe_set, &command.known),
            around_robots,
            planner: self.options.planner,
            most_nodes: self.options.most_nodes,
            seed,
        });
        // Should no answer come, it counts as no path.
        robot.set_timer(timer, self.options.stuck_after);
    }

    /// Plans again, if it may.
    fn replan(&mut self, robot: &mut Robot<'_>, reason: &'static str, around_robots: bool) {
        let Some(command) = &mut self.command else {
            return;
        };
        if command.replans >= self.options.most_replans {
            return self.give_up(robot, reason);
        }
        command.replans += 1;
        self.report(robot, "replan", [("reason", reason.into())]);
        self.plan(robot, around_robots);
    }

    /// Takes the planner's answer.
    fn planned(&mut self, robot: &mut Robot<'_>, path: Option<&Path>) {
        let (body, position) = (*robot.body(), robot.position());
        let route = path.and_then(|path| Route::new(position, path.clone(), &body));
        let Some(command) = &mut self.command else {
            return;
        };
        let Some(route) = route else {
            return self.no_path(robot);
        };
        command.plan_failures = 0;
        let mark = to_go(&route, position, &body);
        let points = route.points().to_vec();
        command.phase = Phase::Following { route, mark };
        self.report(robot, "path", [("path", points.into())]);
        robot.set_timer(self.timer(), self.options.stuck_after);
        if !self.follow(robot) {
            self.track(robot);
        }
    }

    /// No path was found: waits and tries again, or gives up.
    fn no_path(&mut self, robot: &mut Robot<'_>) {
        let timer = self.timer();
        let Some(command) = &mut self.command else {
            return;
        };
        command.plan_failures += 1;
        if command.plan_failures >= self.options.most_plan_failures {
            return self.give_up(robot, "no path");
        }
        command.phase = Phase::Pausing;
        robot.halt();
        robot.set_timer(timer, self.options.plan_pause);
    }

    /// Takes a position estimate.
    fn located(&mut self, robot: &mut Robot<'_>) {
        if self.check_safety(robot) || self.check_arrival(robot) || self.check_path(robot) {
            return;
        }
        if self.follow(robot) {
            self.track(robot);
        }
    }

    /// Whether the robot is in the unsafe set; then the command has failed.
    fn check_safety(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(command) = &self.command else {
            return true;
        };
        let position = robot.position();
        if !command
            .unsafe_set
            .iter()
            .any(|obstacle| obstacle.contains(position))
        {
            return false;
        }
        self.clear();
        self.failed = true;
        robot.cancel_timer(self.timer());
        robot.halt();
        self.report(robot, "failed", [("position", position.into())]);
        true
    }

    /// Whether the robot is at the target; then the command is done. It goes on tracking the target,
    /// so that it comes to rest there and not short of it.
    fn check_arrival(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(command) = &self.command else {
            return true;
        };
        let (target, position) = (command.target, robot.position());
        let distance = match robot.body().flies() {
            true => position.distance(target),
            false => position.planar_distance(target),
        };
        if distance > self.options.vicinity {
            return false;
        }
        self.clear();
        self.done = true;
        robot.cancel_timer(self.timer());
        robot.track(target, None);
        self.report(robot, "done", [("position", position.into())]);
        true
    }

    /// Whether the path is of no use any more; then another one is asked for.
    fn check_path(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(command) = &mut self.command else {
            return true;
        };
        let Phase::Following { route, .. } = &command.phase else {
            return true;
        };
        let body = robot.body();
        let position = body.reachable(robot.position());
        let now_known = robot.obstacles();
        if !alloc::sync::Arc::ptr_eq(&now_known, &command.known) {
            let known = core::mem::replace(&mut command.known, now_known.clone());
            let news = || {
                now_known
                    .iter()
                    .filter(|obstacle| !known.contains(obstacle))
            };
            if route
                .ahead(position)
                .any(|(from, to)| news().any(|o| blocks(o, from, to, body)))
            {
                robot.halt();
                self.replan(robot, "obstacle on the path", false);
                return true;
            }
        }
        if route.cross_track(position) > self.options.off_path {
            self.replan(robot, "off the path", false);
            return true;
        }
        false
    }

    /// Moves on along the path as far as the robot has come; says whether that gave a new way-point.
    fn follow(&mut self, robot: &Robot<'_>) -> bool {
        let Some(command) = &mut self.command else {
            return false;
        };
        let Command {
            unsafe_set,
            known,
            phase: Phase::Following { route, .. },
            ..
        } = command
        else {
            return false;
        };
        let body = robot.body();
        let free = |from: Point, to: Point| {
            let mut obstacles = unsafe_set.iter().chain(known.iter());
            !obstacles.any(|obstacle| blocks(obstacle, from, to, body))
        };
        let Options {
            vicinity,
            pass_radius,
            ..
        } = self.options;
        route.advance(
            body.reachable(robot.position()),
            vicinity,
            pass_radius,
            free,
        )
    }

    /// Feeds the tracker the point to go to now.
    fn track(&self, robot: &mut Robot<'_>) {
        if let Some(Command {
            phase: Phase::Following { route, .. },
            ..
        }) = &self.command
        {
            robot.track(route.current(), route.next());
        }
    }

    /// The time-out of the phase is over.
    fn timed_out(&mut self, robot: &mut Robot<'_>) {
        let timer = self.timer();
        let Some(command) = &mut self.command else {
            return;
        };
        match &mut command.phase {
            Phase::Planning => self.no_path(robot),
            Phase::Pausing => self.replan(robot, "no path", false),
            Phase::Following { route, mark } => {
                let left = to_go(route, robot.position(), robot.body());
                if left > *mark - self.options.least_progress {
                    self.replan(robot, "stuck", true);
                } else {
                    *mark = left;
                    robot.set_timer(timer, self.options.stuck_after);
                }
            }
        }
    }

    /// Stops with all flags false.
    fn give_up(&mut self, robot: &mut Robot<'_>, reason: &'static str) {
        self.clear();
        robot.cancel_timer(self.timer());
        robot.halt();
        self.report(robot, "give_up", [("reason", reason.into())]);
    }

    fn report<const N: usize>(
        &self,
        robot: &mut Robot<'_>,
        name: &'static str,
        fields: [(&'static str, Value); N],
    ) {
        robot.emit_primitive(KIND, self.port, name, fields);
    }

    /// The one timer: what it is for depends on the phase.
    fn timer(&self) -> TimerKey {
        TimerKey {
            port: self.port,
            kind: 0,
            number: 0,
        }
    }
}

impl Primitive for ReachAvoid {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let Some(command) = &self.command else { return };
        match input {
            Input::Estimate => self.located(robot),
            Input::Timer(key) if *key == self.timer() => self.timed_out(robot),
            Input::Planned { ticket, path }
                if *ticket == self.ticket && matches!(command.phase, Phase::Planning) =>
            {
                self.planned(robot, path.as_ref());
            }
            _ => {}
        }
    }
}

/// Metres to go, the climb to the lowest height of travel included.
fn to_go(route: &Route, position: Point, body: &Body) -> f64 {
    let reachable = body.reachable(position);
    let climb = if body.flies() {
        position.distance(reachable)
    } else {
        0.0
    };
    climb + route.remaining(reachable)
}

fn blocks(obstacle: &Obstacle, from: Point, to: Point, body: &Body) -> bool {
    obstacle.blocks_body(from, to, body.radius, body.height)
}

/// All obstacles of either set.
fn union(a: &Obstacles, b: &Obstacles) -> Obstacles {
    let extra: Vec<&Obstacle> = match alloc::sync::Arc::ptr_eq(a, b) {
        true => Vec::new(),
        false => b.iter().filter(|obstacle| !a.contains(obstacle)).collect(),
    };
    match extra.is_empty() {
        true => a.clone(),
        false => a.iter().chain(extra).cloned().collect(),
    }
}
