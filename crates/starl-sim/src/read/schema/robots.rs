//! The fields of a group of robots.

use super::*;
use crate::scenario::SensorSuite;

/// Robots of the same kind.
pub(super) const ROBOTS: &[Field] = &[
    field(
        "model",
        Kind::Model,
        Default::Required,
        "The model of the robots.",
    ),
    field(
        "count",
        Kind::Count(0, 10_000_000),
        Default::Depends("as many as `start` has, or 1"),
        "The number of robots.",
    ),
    field(
        "name",
        Kind::Text,
        Default::Depends("the model's"),
        "Their name: this text and a number.",
    ),
    field(
        "numbered",
        Kind::Flag,
        Default::Value("true"),
        "Whether the number is added; only a single robot can do without it.",
    ),
    field(
        "first_number",
        Kind::Count(0, 1_000_000_000),
        Default::Value("0"),
        "The number of the first.",
    ),
    field(
        "program",
        Kind::Text,
        Default::Depends("the scenario's `program`"),
        "The program of the robots.",
    ),
    field(
        "parameters",
        Kind::Parameters,
        Default::Word("none"),
        "The parameters of their program, which override the scenario's `parameters`.",
    ),
    tables(
        "start",
        START,
        "The starts of the robots, in the order of their numbers. A robot without one starts at the place in a \
         world file, or else at random in `area`, clear of obstacles and robots.",
    ),
    field(
        "area",
        Kind::Table(CORNERS),
        Default::Depends("the world's `start_area`"),
        "The area in which robots without a start are placed.",
    ),
    field(
        "spacing",
        LENGTH,
        Default::Value("100mm"),
        "Least gap between a robot placed at random and any other robot or obstacle.",
    ),
    field(
        "control_period",
        PERIOD,
        Default::Value("100ms"),
        "Time between two activations of the program.",
    ),
    table("sensors", SensorSuite::FIELDS, "The sensors of the robots."),
    table(
        "clock",
        CLOCK,
        "The errors of their clocks. A robot's clock reads offset + (1 + drift) * time; both are \
         drawn evenly for each robot.",
    ),
    field(
        "model_parameters",
        Kind::ModelParameters,
        Default::Depends("the model's own"),
        "Changes the model; see `models.md` for the names.",
    ),
];

const START: &[Field] = &[
    field(
        "position",
        Kind::Point,
        Default::Required,
        "Centre of the body's base.",
    ),
    field(
        "heading",
        Kind::Quantity(Dimension::Angle, Range::Any),
        Default::Value("0deg"),
        "Direction from the x axis, left positive.",
    ),
];

const CLOCK: &[Field] = &[
    field(
        "offset",
        TIME,
        Default::Value("0s"),
        "Greatest offset; clocks start between 0 and this.",
    ),
    field(
        "drift",
        RATIO,
        Default::Value("0"),
        "Greatest drift either way, below 1, e.g. `\"50ppm\"`.",
    ),
];
