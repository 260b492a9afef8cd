//! The fields of a group of robots.

use super::*;
use crate::scenario::SensorSuite;

/// Robots of the same kind.
pub(super) const ROBOTS: &[Field] = fields! {
    /// The model of the robots.
    model = Kind::Model, Required;
    /// The number of robots.
    count = Kind::Count(0, 10_000_000), Depends("as many as `start` has, or 1");
    /// Their name: this text and a number.
    name = Kind::Text, Depends("the model's");
    /// Whether the number is added; only a single robot can do without it.
    numbered = Kind::Flag, Value("true");
    /// The number of the first.
    first_number = Kind::Count(0, 1_000_000_000), Value("0");
    /// The program of the robots.
    program = Kind::Text, Depends("the scenario's `program`");
    /// The parameters of their program, which override the scenario's `parameters`.
    parameters = Kind::Parameters, Word("none");
    /// The starts of the robots, in the order of their numbers. A robot without one starts at the place in a world
    /// file, or else at random in `area`, clear of obstacles and robots.
    start = Kind::Tables(START), Word("none");
    /// The area in which robots without a start are placed.
    area = Kind::Table(CORNERS), Depends("the world's `start_area`");
    /// Least gap between a robot placed at random and any other robot or obstacle.
    spacing = LENGTH, Value("100mm");
    /// Time between two activations of the program.
    control_period = PERIOD, Value("100ms");
    /// The sensors of the robots.
    sensors = Kind::Table(SensorSuite::FIELDS), Value("all at their defaults");
    /// The errors of their clocks. A robot's clock reads offset + (1 + drift) * time; both are drawn evenly for each
    /// robot.
    clock = Kind::Table(CLOCK), Value("all at their defaults");
    /// Changes the model; see `models.md` for the names.
    model_parameters = Kind::ModelParameters, Depends("the model's own");
};

const START: &[Field] = fields! {
    /// Centre of the body's base.
    position = Kind::Point, Required;
    /// Direction from the x axis, left positive.
    heading = Kind::Quantity(Dimension::Angle, Range::Any), Value("0deg");
};

const CLOCK: &[Field] = fields! {
    /// Greatest offset; clocks start between 0 and this.
    offset = TIME, Value("0s");
    /// Greatest drift either way, below 1, e.g. `"50ppm"`.
    drift = RATIO, Value("0");
};
