//! The fields of a scenario's top level, and the tables that concern the run as a whole.

use super::*;

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
    table("physics", PHYSICS, "The resolution of motion."),
    table("positioning", POSITIONING, "The positioning of the robots."),
    table(
        "motion",
        motion::MOTION,
        "The accuracy of motion, and the avoidance of other robots.",
    ),
    table("storage", STORAGE, "The storage of the robots."),
    table(
        "wind",
        WIND,
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
        faults::RATES,
        "Faults at random, drawn from the seed as Poisson processes.",
    ),
    table(
        "properties",
        PROPERTIES,
        "The properties that are checked during the run.",
    ),
    table("trace", TRACE, "The options of the trace."),
];

const PHYSICS: &[Field] = &[
    field("step", PERIOD, Default::Value("25ms"), "The physics step."),
    field(
        "collisions",
        Kind::Flag,
        Default::Value("true"),
        "Whether bodies stop each other and are stopped by obstacles.",
    ),
];

const POSITIONING: &[Field] = &[
    field(
        "period",
        PERIOD,
        Default::Value("50ms"),
        "Time between two estimates.",
    ),
    field(
        "position_noise",
        LENGTH,
        Default::Value("0m"),
        "Standard deviation of each coordinate of an estimate.",
    ),
    field(
        "heading_noise",
        Kind::Quantity(Dimension::Angle, Range::NotNegative),
        Default::Value("0deg"),
        "Standard deviation of each angle of an estimate.",
    ),
    field(
        "velocity_noise",
        Kind::Quantity(Dimension::Speed, Range::NotNegative),
        Default::Value("0m/s"),
        "Standard deviation of each component of an estimated velocity.",
    ),
];

const STORAGE: &[Field] = &[
    field(
        "kept",
        Kind::Flag,
        Default::Value("false"),
        "Whether robots have storage that survives a crash. Without it, a restarted robot has lost \
         the state of its earlier lives.",
    ),
    field(
        "write_time",
        TIME,
        Default::Value("5ms"),
        "The duration of a write. A crash before its end undoes it. A robot sends nothing that depends on \
         unwritten values.",
    ),
    field(
        "loss",
        Kind::Probability,
        Default::Value("0"),
        "The probability that a crash erases a robot's storage.",
    ),
];

const WIND: &[Field] = &[
    field(
        "steady",
        Kind::Velocity,
        Default::Value("[0, 0, 0]"),
        "Steady velocity of the air.",
    ),
    field(
        "gust",
        Kind::Velocity,
        Default::Value("[0, 0, 0]"),
        "Amplitude of the gust.",
    ),
    field(
        "gust_period",
        SPAN,
        Default::Value("10s"),
        "Period of the gust.",
    ),
];

const PROPERTIES: &[Field] = &[
    field(
        "no_collision",
        Kind::Flag,
        Default::Value("true"),
        "Bodies never touch.",
    ),
    field(
        "reach_avoid",
        Kind::Flag,
        Default::Value("true"),
        "Safety, goal and progress of ReachAvoid.",
    ),
    field(
        "progress_bound",
        SPAN,
        Default::Value("180s"),
        "Within this time of its start a ReachAvoid is no longer active.",
    ),
    field(
        "broadcast",
        Kind::Flag,
        Default::Value("true"),
        "Broadcasts reach every robot that is up.",
    ),
    field(
        "broadcast_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time, the thesis's d1.",
    ),
    field(
        "geocast",
        Kind::Flag,
        Default::Value("true"),
        "Exclusion and inclusion of Geocast.",
    ),
    field(
        "geocast_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time, the thesis's d2.",
    ),
    field(
        "unicast",
        Kind::Flag,
        Default::Value("true"),
        "Messages to one robot reach it, once.",
    ),
    field(
        "unicast_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time.",
    ),
    field(
        "shared_memory",
        Kind::Flag,
        Default::Value("true"),
        "Integrity, order, convergence and causality of shared memory.",
    ),
    field(
        "shared_memory_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time memories converge.",
    ),
    field(
        "election",
        Kind::Flag,
        Default::Value("true"),
        "The guarantees of leader elections.",
    ),
    field(
        "election_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time robots agree on a leader.",
    ),
    field(
        "mutex",
        Kind::Flag,
        Default::Value("true"),
        "Safety, non-interference and progress of Mutex, and that its numbers grow.",
    ),
    field(
        "mutex_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time a free resource is granted.",
    ),
    field(
        "register",
        Kind::Flag,
        Default::Value("true"),
        "Linearizability of registers.",
    ),
    field(
        "registration",
        Kind::Flag,
        Default::Value("true"),
        "The guarantees of registrations.",
    ),
    field(
        "registration_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time, the thesis's d2, robots agree on the participants.",
    ),
    field(
        "barrier",
        Kind::Flag,
        Default::Value("true"),
        "The guarantees of barriers.",
    ),
    field(
        "barrier_bound",
        SPAN,
        Default::Value("35s"),
        "Within this time of the arrival of the last robots pass a barrier.",
    ),
    field(
        "program",
        Kind::Flag,
        Default::Value("true"),
        "The properties that programs in the StarL language declare: `invariant`, `always` and `eventually`.",
    ),
];

const TRACE: &[Field] = &[field(
    "pose_period",
    PERIOD,
    Default::Value("100ms"),
    "Time between two records of each robot's true pose.",
)];
