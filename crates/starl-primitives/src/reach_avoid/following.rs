//! How ReachAvoid takes the robot along its path, and what it watches on the way.

use super::route::Route;
use super::{Command, Options, Phase, ReachAvoid};
use alloc::sync::Arc;
use starl_core::event::ReachAvoidEvent;
use starl_core::event::moving::Trouble;
use starl_core::motion::{Body, Obstacles};
use starl_core::{Obstacle, Point, Robot, math};

/// A turn towards the next waypoint by this counts as progress, radians: 2 degrees. In the default `stuck_after` that is
/// half a degree per second, half of the slowest turn that a model can be given, and more than estimates of the heading
/// usually err by.
const LEAST_TURN: f64 = math::PI / 90.0;

/// The part of the path that is left to a robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    /// Metres along the path, with the climb to the lowest height of travel.
    way: f64,
    /// From its heading to the next waypoint, radians; 0 for a robot that flies.
    turn: f64,
}

impl Mark {
    /// The part of the route that is left here and now.
    pub fn here(route: &Route, robot: &Robot<'_>) -> Mark {
        let (body, position) = (robot.body(), robot.position());
        let reachable = body.reachable(position);
        let climb = match body.flies() {
            true => position.distance(reachable),
            false => 0.0,
        };
        Mark {
            way: climb + route.remaining(reachable),
            turn: turn_towards(route, robot),
        }
    }

    /// Whether the robot has come farther than this; then that is the new mark. A turn counts only until the robot comes
    /// nearer, so it cannot make progress for ever by turning to and fro.
    fn advance(&mut self, now: Mark, least_progress: f64) -> bool {
        if now.way <= self.way - least_progress {
            *self = now;
            return true;
        }
        let turns = now.turn <= self.turn - LEAST_TURN;
        if turns {
            self.turn = now.turn;
        }
        turns
    }
}

impl ReachAvoid {
    /// Takes a position estimate.
    pub(super) fn located(&mut self, robot: &mut Robot<'_>) {
        if self.check_safety(robot) || self.check_arrival(robot) || self.check_path(robot) {
            return;
        }
        let phase = self.command.as_ref().map(|command| &command.phase);
        if let Some(&Phase::Braking { around_robots }) = phase {
            if self.at_rest(robot) {
                self.request(robot, around_robots);
            }
        } else if self.advance(robot) {
            self.track(robot);
        }
    }

    /// Whether the robot is in the unsafe set; then the command has failed.
    pub(super) fn check_safety(&mut self, robot: &mut Robot<'_>) -> bool {
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
        (self.failed, self.reason) = (true, Some(Trouble::Unsafe));
        robot.cancel_timer(self.timer());
        robot.halt();
        robot.report(self.port, ReachAvoidEvent::Failed { position });
        true
    }

    /// Whether the robot is at the target; then the command is done. It continues to the end of its
    /// path, so that it stops there and not before.
    fn check_arrival(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(command) = &self.command else {
            return true;
        };
        let target = robot.body().reachable(command.target);
        let position = robot.position();
        let distance = match robot.body().flies() {
            true => position.distance(target),
            false => position.planar_distance(target),
        };
        if distance > self.options.vicinity {
            return false;
        }
        // Where the target itself is not free, the path ends beside it.
        let end = match &command.phase {
            Phase::Following { route, .. } => route.end(),
            _ => position,
        };
        self.clear();
        self.done = true;
        robot.cancel_timer(self.timer());
        robot.track(end, None);
        robot.report(self.port, ReachAvoidEvent::Done { position });
        true
    }

    /// Whether the path has become useless; then another one is requested.
    fn check_path(&mut self, robot: &mut Robot<'_>) -> bool {
        let Some(command) = &mut self.command else {
            return true;
        };
        let Phase::Following { route, since, .. } = &command.phase else {
            return false;
        };
        let body = robot.body();
        let position = body.reachable(robot.position());
        let settled = robot.now().since(*since) >= self.options.plan_pause;
        let now_known = robot.known_obstacles();
        if !Arc::ptr_eq(now_known, &command.known) {
            let known = core::mem::replace(&mut command.known, now_known.clone());
            let news = || {
                now_known
                    .iter()
                    .filter(|obstacle| !known.contains(obstacle))
            };
            if route
                .ahead(position)
                .any(|(from, to)| news().any(|o| blocks(o, from, to, body, 0.0)))
            {
                robot.halt();
                self.replan(robot, Trouble::Obstacle, false);
                return true;
            }
        }
        // Avoidance of other robots, or wind, may have pushed it off its path so that the straight way to
        // the next point is not the one that was planned.
        let slack = 0.5 * self.options.vicinity;
        let blocked = |o: &Obstacle| blocks(o, position, route.current(), body, slack);
        if route.cross_track(position) > self.options.off_path
            || settled && either(&command.unsafe_set, &command.known).any(blocked)
        {
            self.replan(robot, Trouble::OffPath, false);
            return true;
        }
        false
    }

    /// Moves on along the path as far as the robot has come; says whether that gave a new waypoint.
    pub(super) fn advance(&mut self, robot: &Robot<'_>) -> bool {
        let Some(command) = &mut self.command else {
            return false;
        };
        let Command {
            unsafe_set,
            known,
            phase: Phase::Following { route, mark, .. },
            ..
        } = command
        else {
            return false;
        };
        let body = robot.body();
        let free = |from: Point, to: Point| {
            let mut obstacles = either(unsafe_set, known);
            !obstacles.any(|obstacle| blocks(obstacle, from, to, body, 0.0))
        };
        let Options {
            vicinity,
            pass_radius,
            ..
        } = self.options;
        let position = body.reachable(robot.position());
        // At a waypoint the remaining way is the planned one, except for a quarter of the vicinity.
        let has_passed = route.advance(position, 0.25 * vicinity, pass_radius, free);
        if has_passed {
            // It turns towards another waypoint from now on.
            mark.turn = turn_towards(route, robot);
        }
        has_passed
    }

    /// The way over these points; none if some straight way of it is not free.
    pub(super) fn given_route(&self, robot: &Robot<'_>, points: &[Point]) -> Option<Route> {
        let command = self.command.as_ref()?;
        let body = robot.body();
        let route = Route::new(robot.position(), points.to_vec(), body)?;
        let mut obstacles = either(&command.unsafe_set, &command.known);
        let is_blocked = |obstacle: &Obstacle| {
            let mut ways = route.ahead(body.reachable(robot.position()));
            ways.any(|(from, to)| blocks(obstacle, from, to, body, 0.0))
        };
        (!obstacles.any(is_blocked)).then_some(route)
    }

    /// Feeds the tracker the point to go to now.
    pub(super) fn track(&self, robot: &mut Robot<'_>) {
        if let Some(Command {
            phase: Phase::Following { route, .. },
            ..
        }) = &self.command
        {
            robot.track(route.current(), route.next());
        }
    }

    /// The time-out of the phase is over.
    pub(super) fn timed_out(&mut self, robot: &mut Robot<'_>) {
        let timer = self.timer();
        let Some(command) = &mut self.command else {
            return;
        };
        match &mut command.phase {
            Phase::Braking { around_robots } => {
                let around_robots = *around_robots;
                self.request(robot, around_robots);
            }
            Phase::Planning => self.no_path(robot),
            Phase::Pausing => self.replan(robot, Trouble::NoPath, false),
            Phase::Following { route, mark, .. } => {
                let now = Mark::here(route, robot);
                if mark.advance(now, self.options.least_progress) {
                    robot.set_timer(timer, self.options.stuck_after);
                } else {
                    self.replan(robot, Trouble::Stuck, true);
                }
            }
        }
    }
}

/// How far a robot on the ground has to turn towards the next waypoint, radians.
fn turn_towards(route: &Route, robot: &Robot<'_>) -> f64 {
    if robot.body().flies() {
        return 0.0;
    }
    let way = (route.current() - robot.position()).at_height(0.0);
    let turn = way
        .normalized()
        .map_or(0.0, |way| way.heading() - robot.heading());
    math::fabs(math::wrap_angle(turn))
}

/// The obstacles of either set; where they are the same, as with programs that keep out of all they know,
/// once.
fn either<'a>(a: &'a Obstacles, b: &'a Obstacles) -> impl Iterator<Item = &'a Obstacle> {
    let others = if Arc::ptr_eq(a, b) { &[][..] } else { &b[..] };
    a.iter().chain(others)
}

/// Whether the body comes nearer to the obstacle than `-slack` on the straight way, metres. Positions are
/// accurate to half the vicinity, so with that for slack a body beside the obstacle is not taken for one
/// that runs into it.
fn blocks(obstacle: &Obstacle, from: Point, to: Point, body: &Body, slack: f64) -> bool {
    obstacle.blocks_body(from, to, (body.radius - slack).max(0.0), body.height)
}
