//! Writes the tables that concern the run as a whole.

use super::table::{Table, flag, metres, number, quantity, seconds, spatial, time};
use crate::scenario::{Motion, Physics, Positioning, Properties, Scenario, Storage, Trace, Wind};
use starl_core::Duration;
use starl_motion::avoidance;

pub(super) fn physics(physics: &Physics) -> String {
    let Physics { step, collisions } = *physics;
    let default = Physics::default();
    let mut table = Table::named("physics");
    table.differing("step", step, default.step, time);
    table.differing("collisions", collisions, default.collisions, flag);
    table.finish()
}

pub(super) fn positioning(positioning: &Positioning) -> String {
    let Positioning {
        period,
        position_noise,
        heading_noise,
        velocity_noise,
    } = *positioning;
    let mut table = Table::named("positioning");
    table.differing("period", period, Positioning::default().period, time);
    table.differing("position_noise", position_noise, 0.0, metres);
    table.differing("heading_noise", heading_noise, 0.0, |noise| {
        quantity(noise, "rad")
    });
    table.differing("velocity_noise", velocity_noise, 0.0, |noise| {
        quantity(noise, "m/s")
    });
    table.finish()
}

pub(super) fn storage(storage: &Storage) -> String {
    let Storage {
        kept,
        write_time,
        loss,
    } = *storage;
    let default = Storage::default();
    let mut table = Table::named("storage");
    table.differing("kept", kept, default.kept, flag);
    table.differing("write_time", write_time, default.write_time, time);
    table.differing("loss", loss, default.loss, number);
    table.finish()
}

pub(super) fn motion(motion: &Motion) -> String {
    let Motion {
        speed_noise,
        turn_noise,
        noise_period,
        avoidance,
    } = motion;
    let default = Motion::default();
    let mut table = Table::named("motion");
    table.differing("speed_noise", *speed_noise, 0.0, number);
    table.differing("turn_noise", *turn_noise, 0.0, number);
    table.differing("noise_period", *noise_period, default.noise_period, time);
    match avoidance {
        None => table.set("avoidance", flag(false)),
        Some(options) => {
            if let Some(options) = self::avoidance(options) {
                table.set("avoidance", options);
            }
        }
    }
    table.finish()
}

fn avoidance(options: &avoidance::Options) -> Option<String> {
    let avoidance::Options {
        margin,
        vertical_clearance,
        patience,
        longest_yield,
        // These two follow from the positioning system and the fleet.
        period: _,
        largest_radius: _,
    } = *options;
    let default = avoidance::Options::default();
    let mut table = Table::root();
    table.differing("margin", margin, default.margin, metres);
    let clearance = default.vertical_clearance;
    table.differing("vertical_clearance", vertical_clearance, clearance, metres);
    table.differing("patience", patience, default.patience, seconds);
    let longest = default.longest_yield;
    table.differing("longest_yield", longest_yield, longest, seconds);
    table.inline()
}

pub(super) fn wind(wind: &Wind) -> String {
    let Wind {
        steady,
        gust,
        gust_period,
    } = *wind;
    let default = Scenario::default().wind;
    let mut table = Table::named("wind");
    table.differing("steady", steady, default.steady, spatial);
    table.differing("gust", gust, default.gust, spatial);
    table.differing("gust_period", gust_period, default.gust_period, time);
    table.finish()
}

/// A value that can be switched or bounded in `properties`.
trait Setting: Copy + PartialEq {
    fn show(self) -> String;
}

impl Setting for bool {
    fn show(self) -> String {
        flag(self)
    }
}

impl Setting for Duration {
    fn show(self) -> String {
        time(self)
    }
}

/// Takes a structure apart, all of it, and writes the fields that are not at their defaults.
macro_rules! all_fields {
    ($table:ident, $type:ident, $value:expr, { $($field:ident),* $(,)? }) => {
        let $type { $($field),* } = $value;
        let default = $type::default();
        $( $table.differing(stringify!($field), *$field, default.$field, Setting::show); )*
    };
}

pub(super) fn properties(properties: &Properties) -> String {
    let mut table = Table::named("properties");
    all_fields!(table, Properties, properties, {
        no_collision,
        reach_avoid,
        progress_bound,
        broadcast,
        broadcast_bound,
        geocast,
        geocast_bound,
        unicast,
        unicast_bound,
        shared_memory,
        shared_memory_bound,
        election,
        election_bound,
        mutex,
        mutex_bound,
        register,
        registration,
        registration_bound,
        barrier,
        barrier_bound,
        program,
    });
    table.finish()
}

pub(super) fn trace(trace: &Trace) -> String {
    let Trace { pose_period } = *trace;
    let mut table = Table::named("trace");
    table.differing(
        "pose_period",
        pose_period,
        Trace::default().pose_period,
        time,
    );
    table.finish()
}
