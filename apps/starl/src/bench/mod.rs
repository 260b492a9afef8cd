//! `starl bench`: measures the simulator's speed and memory.
//!
//! A workload is an ordinary scenario with an ordinary program, read by the same reader and run by
//! the same engine as any other; nothing here has a path of its own.

mod measure;
mod workload;

use crate::args::{BenchArguments, Workload};
use crate::failure::Failure;
use crate::{console, json};

/// Measures a workload and prints the figures.
pub fn bench(arguments: &BenchArguments) -> Result<bool, Failure> {
    let (load, workload) = match &arguments.workload {
        Workload::Swarm(swarm) => (&swarm.load, workload::swarm(swarm)),
        Workload::Radio(radio) => (&radio.load, workload::radio(radio)),
        Workload::Geocast(geocast) => (&geocast.load, workload::geocast(geocast)),
        Workload::Race(race) => (&race.load, workload::race(race)),
    };
    let figures = measure::measure(&workload, load.threads as usize)?;
    if load.json {
        json::print(&figures)?;
    } else {
        console::print(&measure::text(&figures))?;
    }
    Ok(true)
}
