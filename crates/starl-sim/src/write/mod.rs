//! Writes a scenario as TOML: the other way round of [`crate::read`].
//!
//! Invariant: the scenario read from the text behaves like the original, to the last bit of the run's
//! digest. The sources of a scenario are not kept: the text is complete without world files and images,
//! robots have their drawn starts, and default values are omitted. Only parts without effect are lost:
//! faults and events after the end, faults without robots, invalid events, and the jitter of a constant
//! delay.
//!
//! The structures are taken apart field by field, so that a knob that is not written does not compile.

mod events;
mod faults;
mod fleet;
mod network;
mod world;

use crate::Scenario;
use crate::fields::{FieldTable, written as table};
use crate::scenario::Goal;
use table::{Table, text, time};

/// The scenario as the text of a file.
///
/// Programs are named as the scenario names them; a path of a program leads from the folder of the file.
pub fn scenario(scenario: &Scenario) -> String {
    let Scenario {
        title,
        seed,
        duration,
        goal,
        world,
        fleet,
        physics,
        positioning,
        motion,
        storage,
        wind,
        network,
        faults,
        events,
        properties,
        trace,
    } = scenario;
    let mut root = Table::root();
    if !title.trim().is_empty() {
        root.set("title", text(title));
    }
    root.set("seed", seed.to_string());
    root.set("duration", time(*duration));
    match goal {
        Goal::AllFinished => {}
        Goal::Duration => root.set("goal", text("duration")),
        Goal::Condition(condition) => root.set("goal", text(condition)),
    }
    let mut out = root.finish();
    out += &world::write(world);
    out += &fleet::write(fleet);
    out += &physics.write("physics");
    out += &positioning.write("positioning");
    out += &motion.write("motion");
    out += &storage.write("storage");
    out += &wind.write("wind");
    out += &network::write(network, fleet);
    out += &faults::write(faults, fleet, *duration);
    out += &events::write(events, fleet, *duration);
    out += &properties.write("properties");
    out += &trace.write("trace");
    out
}
