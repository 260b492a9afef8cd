//! The fields of a scenario's top level, and the tables that concern the run as a whole.

use super::*;
use crate::scenario::{FaultRates, Motion, Physics, Positioning, Properties, Storage, Trace, Wind};

/// All fields of a scenario.
pub const SCENARIO: &[Field] = fields! {
    /// The title of the run.
    title = Kind::Text, Depends("the file's name");
    /// The program of the robots, unless their group names another.
    program = Kind::Text, Depends("each group names its own");
    /// Decides every random draw of the run.
    seed = Kind::Count(0, i64::MAX as u64), Value("1");
    /// The time at which the run ends at the latest.
    duration = SPAN, Value("120s");
    /// The goal of the run. `finished`: every robot that is up has finished, and the run ends then. `duration`: the run
    /// has lasted its duration. Anything else is a condition over the robots in the StarL language, such as `forall r:
    /// r.visited == 3`; the run ends when it is true.
    goal = Kind::Text, Value("finished");
    /// The parameters of every program, unless its group overrides them.
    parameters = Kind::Parameters, Word("none");
    /// The world of the robots.
    world = Kind::Table(world::WORLD), Value("all at their defaults");
    /// The fleet, a table for each group of robots of the same kind. They are numbered through from 0 in the order of
    /// the file.
    robots = Kind::Tables(robots::ROBOTS), Required;
    /// The resolution of motion.
    physics = Kind::Table(Physics::FIELDS), Value("all at their defaults");
    /// The positioning of the robots.
    positioning = Kind::Table(Positioning::FIELDS), Value("all at their defaults");
    /// The accuracy of motion, and the avoidance of other robots.
    motion = Kind::Table(Motion::FIELDS), Value("all at their defaults");
    /// The storage of the robots.
    storage = Kind::Table(Storage::FIELDS), Value("all at their defaults");
    /// Moving air, the same everywhere: a steady part and a gust that swings as a sine. Robots on the ground do not
    /// feel it.
    wind = Kind::Table(Wind::FIELDS), Value("all at their defaults");
    /// The network.
    network = Kind::Table(network::NETWORK), Value("all at their defaults");
    /// The faults, with their times.
    fault = Kind::Tables(faults::FAULT), Word("none");
    /// Other events, with their times: faults, changes of the world and of the network, orders, robots that join and
    /// leave.
    event = Kind::Tables(event::EVENT), Word("none");
    /// Faults at random, drawn from the seed as Poisson processes.
    fault_rates = Kind::Table(FaultRates::FIELDS), Value("all at their defaults");
    /// The properties that are checked during the run.
    properties = Kind::Table(Properties::FIELDS), Value("all at their defaults");
    /// The options of the trace.
    trace = Kind::Table(Trace::FIELDS), Value("all at their defaults");
};
