//! What properties may ask of the world: true poses and what robots have come to, not what they
//! believe.

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
pub struct Court<'a> {
    pub code: &'a Code,
    pub fleet: &'a dyn Fleet,
    pub now: Time,
    /// The robots that have started, in ascending order.
    pub roster: &'a [RobotId],
    /// Those robots as an object, once it was asked for.
    pub all: Option<Object>,
    /// Values that were made before.
    pub memo: &'a mut Memo,
    /// The robot that was asked about last.
    pub last: Cell<Option<RobotId>>,
    /// The robot that the row of robots begins with.
    pub first: Option<RobotId>,
    /// Which robots a property is about.
    pub counted: Counted,
    /// Whether more than half of the robots have been up at every moment so far.
    pub has_majority: bool,
    /// Whether anything else was looked at than this robot's state.
    pub looked_elsewhere: Cell<bool>,
}

/// Which of the robots that have started a property is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// All of them.
    All,
    /// Those that are up.
    Up,
    /// Those that are up and that no robot which is down keeps from moving or from its target.
    Able,
}

/// What properties may ask.
pub struct Observable {
    /// What it is called, takes and gives.
    pub signature: Signature,
    /// What it does.
    pub run: Run,
}

/// How an observable is observed.
pub type Run = fn(&mut Court<'_>, &mut HostCall<'_>) -> Called;

const fn observable(
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
    observable("robot.position", A_ROBOT, Shape::Point, |court, call| {
        let pose = court.pose(call)?;
        call.set_point(0, pose.position);
        Ok(0)
    }),
    observable("robot.heading", A_ROBOT, Shape::Float, |court, call| {
        let pose = court.pose(call)?;
        call.set_float(0, pose.yaw);
        Ok(0)
    }),
    observable("robot.velocity", A_ROBOT, Shape::Point, |court, call| {
        let robot = court.asked(call);
        let velocity = court.fleet.velocity(robot);
        call.set_point(0, velocity.ok_or_else(|| unknown(robot))?);
        Ok(0)
    }),
    observable("robot.finished", A_ROBOT, Shape::Bool, |court, call| {
        let robot = court.asked(call);
        call.set_bool(0, court.fleet.has_finished(robot));
        Ok(0)
    }),
    observable("robot.up", A_ROBOT, Shape::Bool, |court, call| {
        let robot = court.asked(call);
        call.set_bool(0, court.fleet.is_up(robot));
        Ok(0)
    }),
    observable("majority", &[], Shape::Bool, |court, call| {
        call.set_bool(0, court.has_majority);
        Ok(0)
    }),
    observable("crashed", &[], Shape::Int, |court, call| {
        let down = court
            .roster
            .iter()
            .filter(|&&robot| !court.fleet.is_up(robot) || court.is_pinned(robot));
        call.set_int(0, down.count() as i64);
        Ok(0)
    }),
    observable("now", &[], Shape::Time, |court, call| {
        call.set_nanoseconds(0, court.now.0);
        Ok(0)
    }),
    observable("undisturbed", &[], Shape::Duration, |court, call| {
        call.set_nanoseconds(0, court.fleet.undisturbed().0);
        Ok(0)
    }),
    observable("uncorrupted", &[], Shape::Duration, |court, call| {
        call.set_nanoseconds(0, court.fleet.uncorrupted().0);
        Ok(0)
    }),
    observable("peers", &[], Shape::Set(&Shape::Robot), |court, call| {
        let everyone = court.fleet.everyone();
        let everyone = everyone.unwrap_or_else(|| court.fleet.robots());
        call.set_object(0, court.memo.fleet(everyone));
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
        |court, call| {
            let way_points = court.fleet.way_points().ok_or(NOT_KNOWN)?;
            call.set_object(0, court.memo.way_points(way_points));
            Ok(0)
        },
    ),
    observable(
        "way_point",
        &[Shape::Text],
        Shape::Optional(&Shape::Point),
        |court, call| {
            let way_points = court.fleet.way_points().ok_or(NOT_KNOWN)?;
            Ok(way_point(way_points, call))
        },
    ),
    observable(
        "way_point_group",
        &[Shape::Int],
        Shape::List(&Shape::Point),
        |court, call| {
            let way_points = court.fleet.way_points().ok_or(NOT_KNOWN)?;
            Ok(way_point_group(way_points, call))
        },
    ),
    observable("obstacles", &[], Shape::Obstacles, |court, call| {
        let obstacles = court.fleet.obstacles().ok_or(NOT_KNOWN)?;
        call.set_object(0, obstacles.into());
        Ok(0)
    }),
];

/// A robot does not get to a target that is nearer than this to a robot which is down, metres: somewhat less than two
/// bodies of the usual size side by side.
const BLOCKED: f64 = 0.6;

/// A robot cannot move if another that is down is nearer than this, metres: a wreck fell on it, or it drove against it.
const PINNED: f64 = 0.5;

const NOT_KNOWN: &str = "this is not known where properties are judged";

fn unknown(robot: RobotId) -> Cow<'static, str> {
    alloc::format!("there is no robot {robot}").into()
}

impl Court<'_> {
    /// The robot that a call is about.
    fn asked(&self, call: &HostCall<'_>) -> RobotId {
        let robot = Arguments::of(call).robot();
        self.last.set(Some(robot));
        robot
    }

    /// Whether the property is about a robot.
    pub fn counts(&self, robot: RobotId) -> bool {
        match self.counted {
            Counted::All => true,
            Counted::Up => self.fleet.is_up(robot),
            Counted::Able => {
                self.fleet.is_up(robot) && !self.is_blocked(robot) && !self.is_pinned(robot)
            }
        }
    }

    /// Whether `exists` and `forall` inside a property run over a robot. A robot that cannot get to its target still
    /// stands where it stands.
    fn exists(&self, robot: RobotId) -> bool {
        self.counted == Counted::All || self.fleet.is_up(robot)
    }

    /// Whether a robot that is down lies where the robot is to go.
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

    /// Whether some other robot that is down lies at such a place.
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

fn all(court: &mut Court<'_>, call: &mut HostCall<'_>) -> Called {
    if court.all.is_none() {
        let counted = court
            .roster
            .iter()
            .copied()
            .filter(|robot| court.exists(*robot));
        court.all = Some(robots(counted));
    }
    call.set_object(0, court.all.clone().unwrap_or_default());
    Ok(0)
}

impl Host for Court<'_> {
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
