//! How the inputs of a run are kept in a trace's header, and got back from it.
//!
//! The scenario and the files that it names are kept as they were written; what the command line
//! changed is kept beside them, in `options.json`.

use serde::{Deserialize, Serialize};
use starl_core::Obstacle;
use starl_properties::Setting;
use starl_sim::Scenario;
use starl_sim::read::{Content, Inputs, Override, Request, Resolved, Source};
use starl_trace::{Header, RobotEntry};
use std::collections::BTreeMap;
use thiserror::Error;

/// The file, among those in the trace, that says what the command line changed.
const OPTIONS: &str = "options.json";

/// Files that the scenario names are kept under this and their paths.
const FILES: &str = "scenario/";

/// The changes of a scenario that is read, and the libraries beside its programs.
#[derive(Serialize, Deserialize)]
struct Options {
    /// The scenario's name.
    name: String,
    overrides: Vec<Override>,
    robots: Option<String>,
    faults: Option<Source>,
    /// Which of the files are kept as hexadecimal digits.
    binary: Vec<String>,
}

/// The header of a run's trace.
pub fn header(resolved: &Resolved, setting: &Setting) -> Header {
    let scenario = &resolved.scenario;
    let mut programs: Vec<&str> = scenario
        .fleet
        .groups
        .iter()
        .map(|group| group.program.as_str())
        .collect();
    programs.sort_unstable();
    programs.dedup();
    Header {
        starl_version: env!("CARGO_PKG_VERSION").to_string(),
        program: programs.join(","),
        seed: scenario.seed,
        scenario: resolved.inputs.request.source.text.clone(),
        files: files(&resolved.inputs),
        setting: json(setting),
        robots: robots(scenario),
        way_points: scenario.world.way_points.clone(),
        obstacles: obstacles(scenario),
    }
}

/// Why a recorded run cannot be run again.
#[derive(Debug, Error)]
pub enum NoInputs {
    /// The trace comes from a host that records none.
    #[error("it holds no {OPTIONS}")]
    Missing,
    /// They are not as this version writes them.
    #[error("{OPTIONS}: {0}")]
    Malformed(#[from] serde_json::Error),
}

/// The inputs of the run that a trace with this header records.
///
/// # Errors
/// The trace holds no inputs, or others than this version reads.
pub fn inputs(header: &Header) -> Result<Inputs, NoInputs> {
    let options = header.files.get(OPTIONS);
    let options = options.ok_or(NoInputs::Missing)?;
    let options: Options = serde_json::from_str(options)?;
    let kept = header.files.iter().filter_map(|(name, text)| {
        let path = name.strip_prefix(FILES)?;
        let content = match options.binary.iter().any(|binary| binary == path) {
            true => Content::Hex(text.clone()),
            false => Content::Text(text.clone()),
        };
        Some((path.to_string(), content))
    });
    Ok(Inputs {
        files: kept.collect(),
        request: Request {
            source: Source::new(options.name, header.scenario.clone()),
            overrides: options.overrides,
            robots: options.robots,
            faults: options.faults,
        },
    })
}

fn files(inputs: &Inputs) -> BTreeMap<String, String> {
    let mut binary = Vec::new();
    let mut files = BTreeMap::new();
    for (path, content) in &inputs.files {
        let text = match content {
            Content::Text(text) => text,
            Content::Hex(digits) => {
                binary.push(path.clone());
                digits
            }
        };
        files.insert(format!("{FILES}{path}"), text.clone());
    }
    let Request {
        source,
        overrides,
        robots,
        faults,
    } = inputs.request.clone();
    let options = Options {
        name: source.name,
        overrides,
        robots,
        faults,
        binary,
    };
    files.insert(OPTIONS.to_string(), json(&options));
    files
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value)
        .unwrap_or_else(|error| unreachable!("plain data can be written as JSON: {error}"))
}

fn robots(scenario: &Scenario) -> Vec<RobotEntry> {
    let mut robots = Vec::new();
    for group in &scenario.fleet.groups {
        let body = group.model.body();
        for _ in &group.starts {
            let id = starl_core::RobotId(robots.len() as u32);
            robots.push(RobotEntry {
                id,
                name: scenario.fleet.name(id),
                model: group.model.name().to_string(),
                radius: body.radius,
                height: body.height,
                flies: body.flies(),
            });
        }
    }
    robots
}

fn obstacles(scenario: &Scenario) -> Vec<Obstacle> {
    scenario
        .world
        .obstacles
        .iter()
        .map(|entry| entry.obstacle.clone())
        .collect()
}
