//! The tables that concern the run as a whole.

use crate::fields::field_table;
use crate::fields::schema::{Dimension, Kind, LENGTH, PERIOD, RATIO, Range, SPAN, SPEED, TIME};
use starl_core::{Duration, Point};
use starl_motion::avoidance;

field_table! {
    /// The resolution of motion.
    #[derive(Copy)]
    pub struct Physics {
        /// The physics step.
        step: Duration = PERIOD, Value("25ms");
        /// Whether bodies stop each other and are stopped by obstacles.
        collisions: bool = Kind::Flag, Value("true");
    }
}

field_table! {
    /// The simulated positioning system.
    #[derive(Copy)]
    pub struct Positioning {
        /// Time between two estimates.
        period: Duration = PERIOD, Value("50ms");
        /// Standard deviation of each coordinate of an estimate.
        position_noise: f64 = LENGTH, Value("0m");
        /// Standard deviation of each angle of an estimate.
        heading_noise: f64 = Kind::Quantity(Dimension::Angle, Range::NotNegative), Value("0deg");
        /// Standard deviation of each component of an estimated velocity.
        velocity_noise: f64 = SPEED, Value("0m/s");
    }
}

field_table! {
    /// The accuracy of motion, and the avoidance of other robots.
    pub struct Motion {
        /// Standard deviation of the relative error of commanded speeds. The limits of the model still apply.
        speed_noise: f64 = RATIO, Value("0");
        /// Standard deviation of the relative error of rates of turn.
        turn_noise: f64 = RATIO, Value("0");
        /// The time from one draw of these errors to the next; they change smoothly between.
        noise_period: Duration = PERIOD, Value("500ms");
        /// Reciprocal avoidance of other robots; `false` switches it off.
        avoidance: Option<avoidance::Options> = Kind::Switch(avoidance::Options::FIELDS), Value("true");
    }
}

/// Reciprocal avoidance.
type Avoidance = avoidance::Options;

field_table! {
    impl Avoidance besides period, largest_radius {
        /// Room that each robot keeps on its side of the border between two bodies.
        margin: f64 = LENGTH, Value("30mm");
        /// Free height at which robots above one another need not avoid each other in the plane.
        vertical_clearance: f64 = LENGTH, Value("100mm");
        /// Time without progress, while a neighbour is in the way, after which a robot may yield.
        patience: f64 = SPAN, Value("800ms");
        /// Longest time a robot yields before it tries again.
        longest_yield: f64 = SPAN, Value("6s");
    }
}

field_table! {
    /// The storage of the robots.
    #[derive(Copy)]
    pub struct Storage {
        /// Whether robots have storage that survives a crash. Without it, a restarted robot has lost the state of its
        /// earlier lives.
        kept: bool = Kind::Flag, Value("false");
        /// The duration of a write. A crash before its end undoes it. A robot sends nothing that depends on unwritten
        /// values.
        write_time: Duration = TIME, Value("5ms");
        /// The probability that a crash erases a robot's storage.
        loss: f64 = Kind::Probability, Value("0");
    }
}

field_table! {
    /// Moving air, the same everywhere: a steady part and a gust that swings as a sine.
    #[derive(Copy)]
    pub struct Wind {
        /// Steady velocity of the air.
        steady: Point = Kind::Velocity, Value("[0, 0, 0]");
        /// Amplitude of the gust.
        gust: Point = Kind::Velocity, Value("[0, 0, 0]");
        /// Period of the gust.
        gust_period: Duration = SPAN, Value("10s");
    }
}

field_table! {
    /// The options of the trace.
    #[derive(Copy)]
    pub struct Trace {
        /// Time between two records of each robot's true pose.
        pose_period: Duration = PERIOD, Value("100ms");
    }
}
