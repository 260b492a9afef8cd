//! ReachAvoid in programs.

use super::kind::{Attention, Kind, Member, flag, method, query};
use crate::robot::arguments::Arguments;
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::shape::{MOTION_TROUBLES, PLANNERS, Shape};
use alloc::borrow::Cow;
use starl_core::{Point, Primitive, Random, Robot};
use starl_primitives::ReachAvoid;
use starl_primitives::reach_avoid::Options;

impl Kind for ReachAvoid {
    const NAME: &'static str = "ReachAvoid";

    /// Vicinity, pass radius and distance off the path, metres; time without progress; re-plans; the
    /// planner and how large its tree may be; the distance from others in a lane, metres.
    const CONSTRUCTOR: &'static [Shape] = &[
        Shape::Optional(&Shape::Float),
        Shape::Optional(&Shape::Float),
        Shape::Optional(&Shape::Float),
        Shape::Optional(&Shape::Duration),
        Shape::Optional(&Shape::Int),
        Shape::Optional(&Shape::Planner),
        Shape::Optional(&Shape::Int),
        Shape::Optional(&Shape::Float),
    ];

    const MEMBERS: &'static [Member<ReachAvoid>] = &[
        method(
            "reach_avoid",
            &[Shape::Point, Shape::Obstacles],
            None,
            |motion, context, call| {
                let mut arguments = Arguments::after_instance(call);
                let target = arguments.point();
                let unsafe_set = arguments.obstacles();
                motion.reach_avoid(context.robot, target, unsafe_set);
                Ok(10)
            },
        ),
        method(
            "follow",
            &[Shape::List(&Shape::Point), Shape::Obstacles],
            None,
            |motion, context, call| {
                let mut arguments = Arguments::after_instance(call);
                let points = arguments.points();
                let unsafe_set = arguments.obstacles();
                motion.follow(context.robot, &points, unsafe_set);
                Ok(10 + points.len() as u64)
            },
        ),
        method(
            "drive_lane",
            &[Shape::List(&Shape::Point), Shape::Float],
            None,
            |motion, context, call| {
                let mut arguments = Arguments::after_instance(call);
                let line = arguments.points();
                let until = arguments.float();
                motion.drive_lane(context.robot, &line, until);
                Ok(10 + line.len() as u64)
            },
        ),
        query("along", &[], Shape::Float, |motion, _, call| {
            call.set_scalar(0, motion.along().to_bits());
            Ok(0)
        }),
        query(
            "free",
            &[Shape::Optional(&Shape::Duration)],
            Shape::Float,
            |motion, context, call| {
                let standing = Arguments::after_instance(call).optional(Arguments::duration);
                let free = motion.free(context.robot.now(), standing.unwrap_or_default());
                call.set_scalar(0, free.to_bits());
                Ok(10)
            },
        ),
        query("stood", &[], Shape::Duration, |motion, context, call| {
            call.set_scalar(0, motion.stood(context.robot.now()).0);
            Ok(0)
        }),
        method("stop", &[], None, |motion, context, _| {
            motion.stop(context.robot);
            Ok(1)
        }),
        flag!("active", ReachAvoid::active),
        query(
            "target",
            &[],
            Shape::Optional(&Shape::Point),
            |motion, _, call| {
                let target = motion.target();
                call.set_bool(0, target.is_some());
                call.set_point(1, target.unwrap_or_default());
                Ok(0)
            },
        ),
        flag!("done", ReachAvoid::done),
        flag!("failed", ReachAvoid::failed),
        query(
            "reason",
            &[],
            Shape::Optional(&Shape::MotionTrouble),
            |motion, _, call| {
                let place = |reason| {
                    let mut troubles = MOTION_TROUBLES.iter();
                    let place = troubles.position(|(_, trouble)| *trouble == reason);
                    place.unwrap_or_default() as u64
                };
                call.set_optional(0, motion.reason().map(place));
                Ok(0)
            },
        ),
    ];

    const ATTENTION: Attention = Attention {
        activations: false,
        ..Attention::FULL
    };

    fn bind(
        instance: &Instance,
        _: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<ReachAvoid, Cow<'static, str>> {
        let default = Options::default();
        let options = Options {
            vicinity: length(arguments, "vicinity", default.vicinity)?,
            pass_radius: length(arguments, "pass_radius", default.pass_radius)?,
            off_path: length(arguments, "off_path", default.off_path)?,
            stuck_after: arguments.duration_or(default.stuck_after),
            most_replans: count(arguments, "most_replans", default.most_replans)?,
            planner: arguments.choice("planner", &PLANNERS, default.planner)?,
            most_nodes: count(arguments, "most_nodes", default.most_nodes)?,
            gap: length(arguments, "gap", default.gap)?,
            ..default
        };
        if options.stuck_after.is_zero() {
            return Err("`stuck_after` must be greater than 0 s".into());
        }
        Ok(ReachAvoid::new(&instance.name, options))
    }

    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Some(self)
    }

    fn corrupt(&mut self, random: &mut Random) {
        ReachAvoid::corrupt(self, random);
    }

    fn halt(&mut self, robot: &mut Robot<'_>) {
        if self.active() {
            self.stop(robot);
        }
    }

    fn reset(&mut self, robot: &mut Robot<'_>) {
        self.stop(robot);
    }

    fn target(&self) -> Option<Point> {
        self.target()
    }

    fn looks(&self) -> bool {
        self.is_in_lane()
    }
}

/// A number, which may be 0.
fn count(
    arguments: &mut Arguments<'_>,
    name: &str,
    default: u32,
) -> Result<u32, Cow<'static, str>> {
    match arguments.optional(Arguments::int) {
        None => Ok(default),
        Some(number @ 0..) => Ok(u32::try_from(number).unwrap_or(u32::MAX)),
        Some(_) => Err(alloc::format!("`{name}` is less than 0").into()),
    }
}

/// A length, which is more than nothing.
fn length(
    arguments: &mut Arguments<'_>,
    name: &str,
    default: f64,
) -> Result<f64, Cow<'static, str>> {
    match arguments.optional(Arguments::float) {
        None => Ok(default),
        Some(metres) if metres > 0.0 && metres.is_finite() => Ok(metres),
        Some(_) => Err(alloc::format!("`{name}` is not more than 0").into()),
    }
}
