//! How ReachAvoid comes by a path: it asks, waits for the answer, asks again a bounded number of times,
//! and gives up.

use super::following::Mark;
use super::route::Route;
use super::{Phase, ReachAvoid};
use alloc::sync::Arc;
use alloc::vec::Vec;
use starl_core::event::ReachAvoidEvent;
use starl_core::event::moving::Trouble;
use starl_core::motion::{Obstacles, Path, PlanRequest};
use starl_core::{Obstacle, Robot};

impl ReachAvoid {
    /// Asks for a path once the robot stands. A path from where a robot is on the move would be left
    /// at once by the way it takes to brake, perhaps towards an obstacle.
    pub(super) fn plan(&mut self, robot: &mut Robot<'_>, around_robots: bool) {
        if self.at_rest(robot) {
            return self.request(robot, around_robots);
        }
        robot.halt();
        if let Some(command) = &mut self.command {
            command.phase = Phase::Braking { around_robots };
            robot.set_timer(self.timer(), self.options.stuck_after);
        }
    }

    /// Whether the robot hardly moves.
    pub(super) fn at_rest(&self, robot: &Robot<'_>) -> bool {
        robot.velocity().length() <= self.options.rest_speed
    }

    /// Asks for a path from here.
    pub(super) fn request(&mut self, robot: &mut Robot<'_>, around_robots: bool) {
        let timer = self.timer();
        let Some(command) = &mut self.command else {
            return;
        };
        command.phase = Phase::Planning;
        command.known = robot.obstacles();
        self.ticket = self.ticket.wrapping_add(1);
        let random = robot.random();
        let seed = random.word();
        robot.plan(PlanRequest {
            ticket: self.ticket,
            target: robot.body().reachable(command.target),
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
    pub(super) fn replan(&mut self, robot: &mut Robot<'_>, reason: Trouble, around_robots: bool) {
        let Some(command) = &mut self.command else {
            return;
        };
        if command.replans >= self.options.most_replans {
            return self.give_up(robot, reason);
        }
        command.replans += 1;
        robot.report(self.port, ReachAvoidEvent::Replan { reason });
        self.plan(robot, around_robots);
    }

    /// Takes the planner's answer.
    pub(super) fn planned(&mut self, robot: &mut Robot<'_>, path: Option<&Path>) {
        let route = path.and_then(|path| Route::new(robot.position(), path.clone(), robot.body()));
        match route {
            Some(route) => self.set_out(robot, route),
            None => self.no_path(robot),
        }
    }

    /// Sets out on a path from here.
    pub(super) fn set_out(&mut self, robot: &mut Robot<'_>, route: Route) {
        let Some(command) = &mut self.command else {
            return;
        };
        command.plan_failures = 0;
        let mark = Mark::here(&route, robot);
        let path = route.points().to_vec();
        command.phase = Phase::Following {
            route,
            mark,
            since: robot.now(),
        };
        robot.report(self.port, ReachAvoidEvent::Path { path });
        robot.set_timer(self.timer(), self.options.stuck_after);
        self.advance(robot);
        self.track(robot);
    }

    /// No path was found: waits and tries again, or gives up.
    pub(super) fn no_path(&mut self, robot: &mut Robot<'_>) {
        let timer = self.timer();
        let Some(command) = &mut self.command else {
            return;
        };
        command.plan_failures = command.plan_failures.saturating_add(1);
        if command.plan_failures >= self.options.most_plan_failures {
            return self.give_up(robot, Trouble::NoPath);
        }
        command.phase = Phase::Pausing;
        robot.halt();
        robot.set_timer(timer, self.options.plan_pause);
    }

    /// Stops with all flags false.
    pub(super) fn give_up(&mut self, robot: &mut Robot<'_>, reason: Trouble) {
        self.clear();
        self.reason = Some(reason);
        robot.cancel_timer(self.timer());
        robot.halt();
        robot.report(self.port, ReachAvoidEvent::GiveUp { reason });
    }
}

/// All obstacles of either set.
fn union(a: &Obstacles, b: &Obstacles) -> Obstacles {
    let extra: Vec<&Obstacle> = match Arc::ptr_eq(a, b) {
        true => Vec::new(),
        false => b.iter().filter(|obstacle| !a.contains(obstacle)).collect(),
    };
    match extra.is_empty() {
        true => a.clone(),
        false => a.iter().chain(extra).cloned().collect(),
    }
}
