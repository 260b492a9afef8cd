//! Values of the world that properties can read: true poses and the actual state of robots, not their beliefs.

use super::Fleet;
use crate::machine::{Host, HostCall, Object, State};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::builtins::{name_of, way_point, way_point_group};
use crate::robot::code::Code;
use crate::robot::shape::{Shape, Signature};
use crate::robot::workbench::{Memo, robots};
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

/// A value that properties can read.
pub struct Observable {
    /// Its name, arguments and results.
    pub signature: Signature,
    /// The function that computes it.
    pub run: Run,
}

/// The function of an observable.
pub type Run = fn(&mut PropertyHost<'_>, &mut HostCall<'_>) -> Called;

/// An observable of this name.
pub(super) const fn observable(
    name: &'static str,
    parameters: &'static [Shape],
    result: Shape,
    run: Run,
) -> Observable {
    let signature = Signature {
        name,
        query: true,
        parameters,
        fields: false,
        result: Some(result),
    };
    Observable { signature, run }
}

const A_ROBOT: &[Shape] = &[Shape::Robot];

/// All of them. Those without a robot are the language's built-in names.
pub static OBSERVABLES: &[Observable] = &[
    observable("robot.all", &[], Shape::List(&Shape::Robot), all),
    observable("robot.all", &[], Shape::Set(&Shape::Robot), all),
    observable("robot.position", A_ROBOT, Shape::Point, |host, call| {
        let pose = host.pose(call)?;
        call.set_point(0, pose.position);
        Ok(0)
    }),
    observable("robot.heading", A_ROBOT, Shape::Float, |host, call| {
        let pose = host.pose(call)?;
        call.set_float(0, pose.yaw);
        Ok(0)
    }),
    observable("robot.velocity", A_ROBOT, Shape::Point, |host, call| {
        let robot = host.asked(call);
        let velocity = host.fleet.velocity(robot);
        call.set_point(0, velocity.ok_or_else(|| unknown(robot))?);
        Ok(0)
    }),
    observable("robot.finished", A_ROBOT, Shape::Bool, |host, call| {
        let robot = host.asked(call);
        call.set_bool(0, host.fleet.has_finished(robot));
        Ok(0)
    }),
    observable("robot.up", A_ROBOT, Shape::Bool, |host, call| {
        let robot = host.asked(call);
        call.set_bool(0, host.fleet.is_up(robot));
        Ok(0)
    }),
    observable("majority", &[], Shape::Bool, |host, call| {
        call.set_bool(0, host.has_majority);
        Ok(0)
    }),
    observable("crashed", &[], Shape::Int, |host, call| {
        let down = host
            .roster
            .iter()
            .filter(|&&robot| !host.fleet.is_up(robot) || host.is_pinned(robot));
        call.set_int(0, down.count() as i64);
        Ok(0)
    }),
    observable("now", &[], Shape::Time, |host, call| {
        call.set_nanoseconds(0, host.now.0);
        Ok(0)
    }),
    observable("undisturbed", &[], Shape::Duration, |host, call| {
        call.set_nanoseconds(0, host.fleet.undisturbed().0);
        Ok(0)
    }),
    observable("uncorrupted", &[], Shape::Duration, |host, call| {
        call.set_nanoseconds(0, host.fleet.uncorrupted().0);
        Ok(0)
    }),
    observable("peers", &[], Shape::Set(&Shape::Robot), |host, call| {
        let everyone = host.fleet.everyone();
        let everyone = everyone.unwrap_or_else(|| host.fleet.robots());
        call.set_object(0, host.memo.fleet(everyone));
        Ok(0)
    }),
    observable("robot_name", A_ROBOT, Shape::Text, |_, call| {
        let robot = Arguments::of(call).robot();
        call.set_object(0, name_of(robot));
        Ok(1)
    }),
    observable(
        "way_points",
        &[],
        Shape::List(&Shape::Point),
        |host, call| {
            let way_points = host.fleet.way_points().ok_or(NOT_KNOWN)?;
            call.set_object(0, host.memo.way_points(way_points));
            Ok(0)
        },
    ),
    observable(
        "way_point",
        &[Shape::Text],
        Shape::Optional(&Shape::Point),
        |host, call| {
            let way_points = host.fleet.way_points().ok_or(NOT_KNOWN)?;
            Ok(way_point(way_points, call))
        },
    ),
    observable(
        "way_point_group",
        &[Shape::Int],
        Shape::List(&Shape::Point),
        |host, call| {
            let way_points = host.fleet.way_points().ok_or(NOT_KNOWN)?;
            Ok(way_point_group(way_points, call))
        },
    ),
    observable("obstacles", &[], Shape::Obstacles, |host, call| {
        let obstacles = host.fleet.obstacles().ok_or(NOT_KNOWN)?;
        call.set_object(0, obstacles.into());
        Ok(0)
    }),
];

/// The distance, in metres, within which a wreck blocks a robot's target: somewhat less than two bodies of the usual
/// size side by side.
const BLOCKED: f64 = 0.6;

/// The distance, in metres, within which a wreck keeps a robot from moving: the wreck fell on it, or it drove against
/// the wreck.
const PINNED: f64 = 0.5;

pub(super) const NOT_KNOWN: &str = "this is not known where properties are judged";

fn unknown(robot: RobotId) -> Cow<'static, str> {
    alloc::format!("there is no robot {robot}").into()
}

impl PropertyHost<'_> {
    /// The robot that a call is about.
    fn asked(&self, call: &HostCall<'_>) -> RobotId {
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
    fn exists(&self, robot: RobotId) -> bool {
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
    fn is_pinned(&self, robot: RobotId) -> bool {
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

    fn pose(&self, call: &HostCall<'_>) -> Result<Pose, Cow<'static, str>> {
        let robot = self.asked(call);
        self.fleet.pose(robot).ok_or_else(|| unknown(robot))
    }
}

fn all(host: &mut PropertyHost<'_>, call: &mut HostCall<'_>) -> Called {
    if host.all.is_none() {
        let counted = host
            .roster
            .iter()
            .copied()
            .filter(|robot| host.exists(*robot));
        host.all = Some(robots(counted));
    }
    call.set_object(0, host.all.clone().unwrap_or_default());
    Ok(0)
}

impl Host for PropertyHost<'_> {
    fn call(&mut self, function: u32, call: &mut HostCall<'_>) -> Called {
        self.looked_elsewhere.set(true);
        let joint = self.code.joint(function);
        match joint.and_then(|joint| joint.in_property) {
            Some(run) => run(self, call),
            None => Err(NOT_KNOWN.into()),
        }
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.last.set(Some(robot));
        if self.first != Some(robot) {
            self.looked_elsewhere.set(true);
        }
        self.fleet.state_of(robot)
    }
}
