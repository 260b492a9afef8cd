//! The built-in functions and names of the language that need the robot. Functions that depend on their arguments alone
//! are compiled to instructions.

mod driving;
mod sensing;
mod telling;

pub use sensing::{name_of, way_point, way_point_group};

use super::arguments::{Arguments, Called};
use super::host::RobotHost;
use super::primitives::give;
use super::shape::Shape::{
    self, Any, Area, Bool, Detection, Float, Int, List, Obstacles, Optional, Point, Robot, Set,
    Side, Text, Thing, Time,
};
use super::shape::Signature;
use super::stable;
use crate::machine::HostCall;
use starl_core::Command;

/// A built-in function or name.
#[derive(Debug)]
pub struct Builtin {
    /// Its name, arguments and results.
    pub signature: Signature,
    /// Whether its result can change only with its arguments or with an input.
    pub is_steady: bool,
    /// The function that runs it.
    pub run: Run,
}

/// The implementation of a built-in.
pub type Run = fn(&mut RobotHost<'_, '_>, &mut HostCall<'_>) -> Called;

/// One that only tells.
const fn query(
    name: &'static str,
    parameters: &'static [Shape],
    result: Shape,
    run: Run,
) -> Builtin {
    Builtin {
        signature: Signature::query(name, parameters, result),
        is_steady: false,
        run,
    }
}

/// One that tells what is the same as long as the robot runs, or until an order says that it has changed.
const fn steady(
    name: &'static str,
    parameters: &'static [Shape],
    result: Shape,
    run: Run,
) -> Builtin {
    Builtin {
        is_steady: true,
        ..query(name, parameters, result, run)
    }
}

/// One that does something.
const fn effect(
    name: &'static str,
    parameters: &'static [Shape],
    result: Option<Shape>,
    run: Run,
) -> Builtin {
    Builtin {
        signature: Signature::effect(name, parameters, result),
        is_steady: false,
        run,
    }
}

/// All of them, in the order of the language's table.
pub static BUILTINS: &[Builtin] = &[
    steady("me", &[], Robot, |host, call| {
        call.set_robot(0, host.context.robot.id());
        Ok(0)
    }),
    query("position", &[], Point, |host, call| {
        call.set_point(0, host.context.robot.position());
        Ok(0)
    }),
    query("heading", &[], Float, |host, call| {
        call.set_float(0, host.context.robot.heading());
        Ok(0)
    }),
    query("velocity", &[], Point, |host, call| {
        call.set_point(0, host.context.robot.velocity());
        Ok(0)
    }),
    query("now", &[], Time, |host, call| {
        call.set_nanoseconds(0, host.context.robot.now().0);
        Ok(0)
    }),
    query("peers", &[], Set(&Robot), |host, call| {
        let fleet = host.context.robot.fleet();
        call.set_object(0, host.context.memo.fleet(fleet));
        Ok(0)
    }),
    steady("robot_name", &[Robot], Text, sensing::robot_name),
    query("bumped", &[], Optional(&Side), sensing::bumped),
    query("ranges", &[], List(&Float), sensing::ranges),
    query("detected", &[], List(&Detection), sensing::detected),
    query("things", &[], List(&Thing), sensing::things),
    query("holding", &[], Optional(&Int), |host, call| {
        call.set_optional(0, host.context.robot.sensors().holding.map(u64::from));
        Ok(0)
    }),
    query("thing_name", &[Int], Text, sensing::thing_name),
    query("atomic_blocked", &[], Bool, |host, call| {
        let atomic = host.context.services.atomic.as_ref();
        call.set_bool(0, atomic.is_some_and(|atomic| atomic.is_blocked()));
        Ok(0)
    }),
    steady("way_points", &[], List(&Point), |host, call| {
        let way_points = host.context.robot.way_points();
        call.set_object(0, host.context.memo.way_points(way_points));
        Ok(0)
    }),
    steady("way_point", &[Text], Optional(&Point), |host, call| {
        let way_points = host.context.robot.way_points();
        Ok(way_point(way_points, call))
    }),
    steady("way_point_group", &[Int], List(&Point), |host, call| {
        let way_points = host.context.robot.way_points();
        Ok(way_point_group(way_points, call))
    }),
    query("obstacles", &[], Obstacles, |host, call| {
        call.set_object(0, host.context.robot.obstacles().into());
        Ok(0)
    }),
    steady("areas_of", &[Obstacles], List(&Area), sensing::areas_of),
    steady(
        "with_area",
        &[Obstacles, Area],
        Obstacles,
        sensing::with_area,
    ),
    effect("random", &[Float, Float], Some(Float), |host, call| {
        let mut arguments = Arguments::of(call);
        let (low, high) = (arguments.float(), arguments.float());
        let number = host.context.robot.random().between(low, high);
        // Rounding may give `high` itself.
        call.set_float(0, if number < high { number } else { low });
        Ok(0)
    }),
    effect("random_int", &[Int, Int], Some(Int), |host, call| {
        let mut arguments = Arguments::of(call);
        let (low, high) = (arguments.int(), arguments.int());
        if low >= high {
            return Err(alloc::format!("no Int is from {low} to below {high}").into());
        }
        let random = host.context.robot.random();
        let span = high.wrapping_sub(low) as u64;
        let offset = (u128::from(random.word()) * u128::from(span)) >> 64;
        call.set_int(0, low.wrapping_add(offset as i64));
        Ok(0)
    }),
    Builtin {
        signature: Signature {
            fields: true,
            ..Signature::effect("emit", &[Text], None)
        },
        is_steady: false,
        run: telling::emit,
    },
    effect("log", &[Text], None, telling::log),
    effect("draw_point", &[Text, Point], None, telling::draw_point),
    effect("draw_line", &[Text, List(&Point)], None, telling::draw_line),
    effect(
        "draw_circle",
        &[Text, Point, Float],
        None,
        telling::draw_circle,
    ),
    effect("draw_text", &[Text, Point], None, telling::draw_text),
    effect("draw_nothing", &[Text], None, telling::draw_nothing),
    effect("finish", &[], None, |host, _| {
        host.context.robot.finish();
        Ok(0)
    }),
    effect("fail", &[Text], None, telling::fail),
    effect("take", &[Int], None, |host, call| {
        // Numbers beyond these stand for no thing, so that there is nothing to take.
        if let Ok(thing) = u32::try_from(Arguments::of(call).int()) {
            host.context.robot.take(thing);
        }
        Ok(1)
    }),
    effect("put_down", &[], None, |host, _| {
        host.context.robot.put_down();
        Ok(1)
    }),
    effect("stop", &[], None, |host, _| {
        for slot in host.bound.iter_mut().flatten() {
            slot.is_stirred = true;
            slot.bound.halt(host.context.robot);
        }
        host.context.robot.halt();
        Ok(1)
    }),
    effect("drive_straight", &[Float], None, driving::straight),
    effect("drive_turn", &[Float], None, driving::turn),
    effect("drive_curve", &[Float, Float], None, driving::curve),
    effect("drive_wheels", &[Float, Float], None, driving::wheels),
    effect("drive_car", &[Float, Float], None, driving::car),
    effect(
        "drive_velocity",
        &[Point, Optional(&Float)],
        None,
        driving::velocity,
    ),
    effect(
        "drive_attitude",
        &[Float, Float, Float, Float],
        None,
        driving::attitude,
    ),
    effect("take_off", &[], None, |host, _| {
        driving::drive(host, Command::TakeOff)
    }),
    effect("hover", &[], None, |host, _| {
        driving::drive(host, Command::Hover)
    }),
    effect("land", &[], None, |host, _| {
        driving::drive(host, Command::Land)
    }),
    // Not in the language's table: a program that starts again does this first.
    effect("reset", &[], None, |host, _| {
        for slot in host.bound.iter_mut().flatten() {
            slot.is_stirred = true;
            slot.bound.reset(host.context.robot);
        }
        Ok(1)
    }),
    // Not in the language's table: the start of a program asks this for each stable variable, by its number.
    query("saved", &[Int], Optional(&Any), |host, call| {
        let variable = Arguments::of(call).int() as usize;
        let code = host.context.code;
        let saved = host.context.robot.saved();
        let value = saved.and_then(|saved| stable::saved(code.stable(), saved, variable));
        give(code.program(), call, &[value])
    }),
];
