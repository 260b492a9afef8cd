//! The fields of a scenario's top level, and the tables that concern the run as a whole.

use super::*;
use crate::scenario::{FaultRates, Motion, Physics, Positioning, Properties, Storage, Trace, Wind};

/// All fields of a scenario.
pub const SCENARIO: &[Field] = &[
    field(
        "title",
        Kind::Text,
        Default::Depends("the file's name"),
        "The title of the run.",
    ),
    field(
        "program",
        Kind::Text,
        Default::Depends("each group names its own"),
        "The program of the robots, unless their group names another.",
    ),
    field(
        "seed",
        Kind::Count(0, i64::MAX as u64),
        Default::Value("1"),
        "Decides every random draw of the run.",
    ),
    field(
        "duration",
        SPAN,
        Default::Value("120s"),
        "The time at which the run ends at the latest.",
    ),
    field(
        "goal",
        Kind::Text,
        Default::Value("finished"),
        "The goal of the run. `finished`: every robot that is up has finished, and the run ends then. `duration`: the run \
         has lasted its duration. Anything else is a condition over the robots in the StarL language, such as \
         `forall r: r.visited == 3`; the run ends when it is true.",
    ),
    field(
        "parameters",
        Kind::Parameters,
        Default::Word("none"),
        "The parameters of every program, unless its group overrides them.",
    ),
    table("world", world::WORLD, "The world of the robots."),
    field(
        "robots",
        Kind::Tables(robots::ROBOTS),
        Default::Required,
        "The fleet, a table for each group of robots of the same kind. They are numbered through \
         from 0 in the order of the file.",
    ),
    table("physics", Physics::FIELDS, "The resolution of motion."),
    table(
        "positioning",
        Positioning::FIELDS,
        "The positioning of the robots.",
    ),
    table(
        "motion",
        Motion::FIELDS,
        "The accuracy of motion, and the avoidance of other robots.",
    ),
    table("storage", Storage::FIELDS, "The storage of the robots."),
    table(
        "wind",
        Wind::FIELDS,
        "Moving air, the same everywhere: a steady part and a gust that swings as a sine. Robots \
         on the ground do not feel it.",
    ),
    table("network", network::NETWORK, "The network."),
    tables("fault", faults::FAULT, "The faults, with their times."),
    tables(
        "event",
        event::EVENT,
        "Other events, with their times: faults, changes of the world and of the network, orders, robots that \
         join and leave.",
    ),
    table(
        "fault_rates",
        FaultRates::FIELDS,
        "Faults at random, drawn from the seed as Poisson processes.",
    ),
    table(
        "properties",
        Properties::FIELDS,
        "The properties that are checked during the run.",
    ),
    table("trace", Trace::FIELDS, "The options of the trace."),
];
