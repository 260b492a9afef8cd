//! The machine's host where properties are judged: the fleet, and the robots that count.

use super::fleet::Fleet;
use crate::machine::{HostCall, Object};
use crate::robot::arguments::Arguments;
use crate::robot::code::Code;
use crate::robot::workbench::Memo;
use alloc::borrow::Cow;
use core::cell::Cell;
use starl_core::{Point, Pose, RobotId, Time};

/// The machine's host where properties are judged.
pub struct PropertyHost<'a> {
    pub code: &'a Code,
    pub fleet: &'a dyn Fleet,
    pub now: Time,
    /// The robots that have started, in ascending order.
    pub roster: &'a [RobotId],
    /// Those robots as an object, once requested.
    pub all: Option<Object>,
    /// Cached values.
    pub memo: &'a mut Memo,
    /// The robot that was read last.
    pub last: Cell<Option<RobotId>>,
    /// The first robot of the row.
    pub first: Option<RobotId>,
    /// The robots for which the property is judged.
    pub counted: Counted,
    /// Whether more than half of the robots have been up at every moment so far.
    pub has_majority: bool,
    /// Whether anything except this robot's state was read.
    pub looked_elsewhere: Cell<bool>,
}

/// The robots, among those that have started, for which a property is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// All of them.
    All,
    /// Those that are up.
    Up,
    /// Those that are up and that no wreck keeps from moving or from their target.
    Able,
}

/// The distance, in metres, within which a wreck blocks a robot's target: somewhat less than two bodies of the usual
/// size side by side.
const BLOCKED: f64 = 0.6;

/// The distance, in metres, within which a wreck keeps a robot from moving: the wreck fell on it, or it drove against
/// the wreck.
const PINNED: f64 = 0.5;

/// The error of a call whose answer only a robot knows.
pub const NOT_KNOWN: &str = "this is not known where properties are judged";

/// The error of a call about a robot that does not exist.
pub fn unknown(robot: RobotId) -> Cow<'static, str> {
    alloc::format!("there is no robot {robot}").into()
}

impl<'a> PropertyHost<'a> {
    /// A host for a property of all robots at a moment.
    pub fn new(
        code: &'a Code,
        fleet: &'a dyn Fleet,
        now: Time,
        roster: &'a [RobotId],
        memo: &'a mut Memo,
    ) -> PropertyHost<'a> {
        PropertyHost {
            code,
            fleet,
            now,
            roster,
            all: None,
            memo,
            last: Cell::new(None),
            first: None,
            counted: Counted::All,
            has_majority: true,
            looked_elsewhere: Cell::new(false),
        }
    }

    /// The robot that a call is about.
    pub fn asked(&self, call: &HostCall<'_>) -> RobotId {
        let robot = Arguments::of(call).robot();
        self.last.set(Some(robot));
        robot
    }

    /// Whether the property is judged for a robot.
    pub fn counts(&self, robot: RobotId) -> bool {
        match self.counted {
            Counted::All => true,
            Counted::Up => self.fleet.is_up(robot),
            Counted::Able => {
                self.fleet.is_up(robot) && !self.is_blocked(robot) && !self.is_pinned(robot)
            }
        }
    }

    /// Whether `exists` and `forall` inside a property range over a robot. They include a robot that cannot get to its
    /// target.
    pub fn exists(&self, robot: RobotId) -> bool {
        self.counted == Counted::All || self.fleet.is_up(robot)
    }

    /// Whether a wreck blocks the robot's target.
    fn is_blocked(&self, robot: RobotId) -> bool {
        let target = self.fleet.target(robot);
        target.is_some_and(|target| {
            let target = target.at_height(0.0);
            self.is_wreck_near(robot, |wreck| {
                wreck.at_height(0.0).distance(target) < BLOCKED
            })
        })
    }

    /// Whether a robot that is down touches the robot.
    pub fn is_pinned(&self, robot: RobotId) -> bool {
        let pose = self.fleet.pose(robot);
        pose.is_some_and(|pose| {
            self.is_wreck_near(robot, |wreck| wreck.distance(pose.position) < PINNED)
        })
    }

    /// Whether the position of some other robot that is down satisfies the condition.
    fn is_wreck_near(&self, robot: RobotId, is_near: impl Fn(Point) -> bool) -> bool {
        let others = self.roster.iter().filter(|other| **other != robot);
        let mut wrecks = others.filter(|other| !self.fleet.is_up(**other));
        wrecks.any(|other| {
            let pose = self.fleet.pose(*other);
            pose.is_some_and(|pose| is_near(pose.position))
        })
    }

    /// The true pose of the robot that a call is about.
    pub fn pose(&self, call: &HostCall<'_>) -> Result<Pose, Cow<'static, str>> {
        let robot = self.asked(call);
        self.fleet.pose(robot).ok_or_else(|| unknown(robot))
    }
}
