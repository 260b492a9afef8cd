//! Robots patrol the waypoints. Each robot begins at the waypoint with its own number.

use starl_core::{Primitives, Program, Robot};
use starl_primitives::ReachAvoid;
use std::process::ExitCode;

#[derive(Clone, Default, Primitives)]
struct Patrol {
    motion: ReachAvoid,
    stops: u32,
    made: u32,
}

impl Program for Patrol {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.made += u32::from(self.motion.done());
        if self.made >= self.stops {
            robot.finish();
        } else if !self.motion.active() {
            let next = robot.id().index() + self.made as usize;
            if let Some(target) = robot.way_points().iter().cycle().nth(next) {
                self.motion
                    .reach_avoid(robot, target.position, robot.obstacles());
            }
        }
    }
}

fn patrol(parameters: &mut starl::Parameters<'_>) -> Patrol {
    let stops = parameters.count("stops", 3);
    Patrol {
        stops,
        ..Patrol::default()
    }
}

fn main() -> ExitCode {
    starl::command()
        .program("patrol", "drive from waypoint to waypoint", patrol)
        .run()
}
