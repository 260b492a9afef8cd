//! Race: a fleet runs through shared waypoints; the first robot at each sends all on to the next
//! (thesis, section 2.2 and figure 2.1).
//!
//! This is the example of a program written in Rust. `race.starl` beside it is the same program in the
//! StarL language, and `starl run race` runs that one; a test shows that both do the same.
//!
//! The actions stand in the order and under the names of the figure. Where this differs from the
//! printed listing:
//! - `wait` there broadcasts the index after counting it up, and `receivedMessage` counts up again,
//!   so a robot that receives it would skip a point. Here the message says which waypoint was reached;
//! - there any message sets the index, so one that comes late sends the robot back. Here only a
//!   message about the present waypoint or a later one does something;
//! - the guard of `pick` there also holds once ReachAvoid is done, so the robot would set out for the
//!   same point again instead of telling the others. Here it holds unless the robot is on its way or
//!   has arrived: a robot that gave up tries again;
//! - `check` is added, for faults that overwrite the state. The platform makes checks for programs in the
//!   StarL language; a program in Rust makes its own;
//! - `finish` is added: the listing does not say when the application is over.

#![no_std]

use core::any::Any;
use starl_core::{Message, Primitive, Primitives, Program, Random, Robot, WayPoint};
use starl_primitives::{Broadcast, ReachAvoid, reach_avoid, reliable};

/// The state of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// Set out for the current waypoint.
    Pick,
    /// Wait until it is there.
    Wait,
}

/// Settings of [`Race`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// How to move.
    pub reach_avoid: reach_avoid::Options,
    /// How to tell the others.
    pub broadcast: reliable::Options,
}

/// The program of one robot.
#[derive(Clone, Debug, Primitives)]
pub struct Race {
    location: Location,
    /// The waypoint to go to, counted from 0; their number when there are no more.
    current_index: u32,
    reach_avoid: ReachAvoid,
    broadcast: Broadcast,
}

impl Default for Race {
    fn default() -> Race {
        Race::new(Options::default())
    }
}

impl Race {
    /// A robot that has not started.
    pub fn new(options: Options) -> Race {
        Race {
            location: Location::Pick,
            current_index: 0,
            reach_avoid: ReachAvoid::new("race/reach_avoid", options.reach_avoid),
            broadcast: Broadcast::new("race/broadcast", options.broadcast),
        }
    }

    /// The state of the robot.
    pub fn location(&self) -> Location {
        self.location
    }

    /// The waypoint it goes to, counted from 0.
    pub fn current_index(&self) -> u32 {
        self.current_index
    }

    /// Starts again if a fault has overwritten the state: the index is impossible, or the robot goes to another
    /// waypoint than that of the index.
    fn check(&mut self, robot: &mut Robot<'_>) {
        let is_there = self.current_index as usize <= robot.way_points().len();
        let goes_there = self.location == Location::Pick
            || !self.reach_avoid.active()
            || self.reach_avoid.target() == self.target(robot).map(|point| point.position);
        if !(is_there && goes_there) {
            self.reach_avoid.stop(robot);
            self.current_index = 0;
            self.location = Location::Pick;
            robot.emit("reset", []);
        }
    }

    fn pick(&mut self, robot: &mut Robot<'_>) {
        let Some(target) = self.target(robot) else {
            return;
        };
        let gave_up = !self.reach_avoid.active() && !self.reach_avoid.done();
        if self.location == Location::Pick || gave_up {
            robot.action("pick");
            self.reach_avoid
                .reach_avoid(robot, target.position, robot.obstacles());
            self.location = Location::Wait;
        }
    }

    fn wait(&mut self, robot: &mut Robot<'_>) {
        if self.location == Location::Wait && self.reach_avoid.done() {
            robot.action("wait");
            self.broadcast.broadcast(robot, &self.current_index);
            self.current_index += 1;
            self.location = Location::Pick;
        }
    }

    fn finish(&mut self, robot: &mut Robot<'_>) {
        if self.location == Location::Pick && self.target(robot).is_none() {
            robot.action("finish");
            self.reach_avoid.stop(robot);
            self.location = Location::Wait;
            robot.finish();
        }
    }

    /// The waypoint to go to; none if all are reached.
    fn target<'a>(&self, robot: &Robot<'a>) -> Option<&'a WayPoint> {
        robot.way_points().get(self.current_index as usize)
    }
}

impl Program for Race {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.check(robot);
        self.pick(robot);
        self.wait(robot);
        self.finish(robot);
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        self.check(robot);
        if message.port != self.broadcast.port() {
            return;
        }
        let Some(reached) = message.read::<u32>() else {
            return;
        };
        if reached >= self.current_index {
            self.current_index = reached.saturating_add(1);
            self.location = Location::Pick;
        }
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        let locations = [Location::Pick, Location::Wait];
        self.location = locations[random.below(2) as usize];
        self.current_index = random.bits() >> random.below(32);
    }
}
