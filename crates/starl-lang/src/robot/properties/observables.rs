//! Values of the world that properties can read: true poses and the actual state of robots, not their beliefs.

use super::host::{NOT_KNOWN, PropertyHost, unknown};
use super::shared;
use crate::machine::{Host, HostCall, State};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::builtins::{name_of, way_point, way_point_group};
use crate::robot::shape::Shape::{
    self, Any, Bool, Duration, Float, Int, List, Map, Obstacles, Optional, Point, Robot, Set,
    Shared, Text, Time,
};
use crate::robot::shape::Signature;
use crate::robot::workbench::robots;
use starl_core::RobotId;

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
const fn observable(
    name: &'static str,
    parameters: &'static [Shape],
    result: Shape,
    run: Run,
) -> Observable {
    Observable {
        signature: Signature::query(name, parameters, result),
        run,
    }
}

const A_ROBOT: &[Shape] = &[Robot];

/// A shared variable, then the robot whose copy is read.
const SHARED_OF_A_ROBOT: &[Shape] = &[Shared, Robot];

/// All of them. Those without a robot are the language's built-in names.
pub static OBSERVABLES: &[Observable] = &[
    observable("robot.all", &[], List(&Robot), all),
    observable("robot.all", &[], Set(&Robot), all),
    observable("robot.position", A_ROBOT, Point, |host, call| {
        let pose = host.pose(call)?;
        call.set_point(0, pose.position);
        Ok(0)
    }),
    observable("robot.heading", A_ROBOT, Float, |host, call| {
        let pose = host.pose(call)?;
        call.set_float(0, pose.yaw);
        Ok(0)
    }),
    observable("robot.velocity", A_ROBOT, Point, |host, call| {
        let robot = host.asked(call);
        let velocity = host.fleet.velocity(robot);
        call.set_point(0, velocity.ok_or_else(|| unknown(robot))?);
        Ok(0)
    }),
    observable("robot.finished", A_ROBOT, Bool, |host, call| {
        let robot = host.asked(call);
        call.set_bool(0, host.fleet.has_finished(robot));
        Ok(0)
    }),
    observable("robot.up", A_ROBOT, Bool, |host, call| {
        let robot = host.asked(call);
        call.set_bool(0, host.fleet.is_up(robot));
        Ok(0)
    }),
    observable("majority", &[], Bool, |host, call| {
        call.set_bool(0, host.has_majority);
        Ok(0)
    }),
    observable("crashed", &[], Int, |host, call| {
        let down = host
            .roster
            .iter()
            .filter(|&&robot| !host.fleet.is_up(robot) || host.is_pinned(robot));
        call.set_int(0, down.count() as i64);
        Ok(0)
    }),
    observable("now", &[], Time, |host, call| {
        call.set_nanoseconds(0, host.now.0);
        Ok(0)
    }),
    observable("undisturbed", &[], Duration, |host, call| {
        call.set_nanoseconds(0, host.fleet.undisturbed().0);
        Ok(0)
    }),
    observable("uncorrupted", &[], Duration, |host, call| {
        call.set_nanoseconds(0, host.fleet.uncorrupted().0);
        Ok(0)
    }),
    observable("peers", &[], Set(&Robot), |host, call| {
        let everyone = host.fleet.everyone();
        let everyone = everyone.unwrap_or_else(|| host.fleet.robots());
        call.set_object(0, host.memo.fleet(everyone));
        Ok(0)
    }),
    observable("robot_name", A_ROBOT, Text, |_, call| {
        let robot = Arguments::of(call).robot();
        call.set_object(0, name_of(robot));
        Ok(1)
    }),
    observable("way_points", &[], List(&Point), |host, call| {
        let way_points = host.fleet.way_points().ok_or(NOT_KNOWN)?;
        call.set_object(0, host.memo.way_points(way_points));
        Ok(0)
    }),
    observable("way_point", &[Text], Optional(&Point), |host, call| {
        let way_points = host.fleet.way_points().ok_or(NOT_KNOWN)?;
        Ok(way_point(way_points, call))
    }),
    observable("way_point_group", &[Int], List(&Point), |host, call| {
        let way_points = host.fleet.way_points().ok_or(NOT_KNOWN)?;
        Ok(way_point_group(way_points, call))
    }),
    observable("obstacles", &[], Obstacles, |host, call| {
        let obstacles = host.fleet.obstacles().ok_or(NOT_KNOWN)?;
        call.set_object(0, obstacles.into());
        Ok(0)
    }),
    observable(
        "shared.read",
        SHARED_OF_A_ROBOT,
        Optional(&Any),
        shared::read,
    ),
    observable(
        "shared.element",
        &[Shared, Robot, Robot],
        Optional(&Any),
        shared::element,
    ),
    observable(
        "shared.all",
        SHARED_OF_A_ROBOT,
        Map(&Robot, &Any),
        shared::all,
    ),
];

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
            Some(number) => (OBSERVABLES[usize::from(number)].run)(self, call),
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
