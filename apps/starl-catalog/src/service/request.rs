//! The requests to the service, as JSON: an object whose only member is the name of the request.

use crate::session::{Breakpoint, Files, Options, Recorded};
use serde::Deserialize;
use starl_core::{Duration, Intervention, RobotId, Time};
use starl_editor::Utf16Position;
use std::collections::BTreeMap;
use thiserror::Error;

/// A request.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    Examples {},
    Schema {},
    Check {
        files: Contents,
    },
    Hover {
        files: Contents,
        path: String,
        position: Utf16Position,
    },
    Complete {
        files: Contents,
        path: String,
        position: Utf16Position,
    },
    Definition {
        files: Contents,
        path: String,
        position: Utf16Position,
    },
    Outline {
        files: Contents,
        path: String,
    },
    Format {
        text: String,
    },
    Profiles {},
    Try {
        #[serde(default)]
        files: Contents,
        #[serde(default)]
        options: Options,
        profile: String,
        seed: String,
    },
    ProfileScenario {
        #[serde(default)]
        files: Contents,
        #[serde(default)]
        options: Options,
        profile: String,
        seed: String,
    },
    Shrink {
        #[serde(default)]
        files: Contents,
        #[serde(default)]
        options: Options,
        profile: String,
        seed: String,
        most: Option<u64>,
    },
    Open {
        #[serde(default)]
        files: Contents,
        #[serde(default)]
        options: Options,
        topics: Option<Vec<String>>,
    },
    OpenRecorded {
        recorded: Recorded,
        topics: Option<Vec<String>>,
    },
    Trace {
        simulation: u32,
    },
    Close {
        simulation: u32,
    },
    Status {
        simulation: u32,
    },
    Step {
        simulation: u32,
    },
    Run {
        simulation: u32,
        until: Option<Seconds>,
        steps: Option<u64>,
        sample: Option<Period>,
    },
    Breakpoints {
        simulation: u32,
        breakpoints: Vec<Breakpoint>,
    },
    Apply {
        simulation: u32,
        at: Option<Seconds>,
        intervention: Intervention,
    },
    Snapshot {
        simulation: u32,
    },
    Restore {
        simulation: u32,
        snapshot: u32,
    },
    Drop {
        simulation: u32,
        snapshot: u32,
    },
    Scenario {
        simulation: u32,
    },
    Records {
        simulation: u32,
        max: Option<usize>,
    },
    World {
        simulation: u32,
    },
    Fleet {
        simulation: u32,
    },
    States {
        simulation: u32,
    },
    Values {
        simulation: u32,
    },
    Robot {
        simulation: u32,
        robot: RobotId,
    },
    Report {
        simulation: u32,
    },
}

/// Files by path.
#[derive(Default, Deserialize)]
pub struct Contents(BTreeMap<String, Content>);

/// A file: a text, or its bytes.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a file is a text, or a list of its bytes")]
enum Content {
    Text(String),
    Bytes(Vec<u8>),
}

impl From<Contents> for Files {
    fn from(contents: Contents) -> Files {
        let files = contents.0.into_iter().map(|(path, content)| {
            let bytes = match content {
                Content::Text(text) => text.into_bytes(),
                Content::Bytes(bytes) => bytes,
            };
            (path, bytes)
        });
        files.collect()
    }
}

/// A number of seconds that is not the time that it should be.
#[derive(Debug, Error)]
pub enum NotATime {
    #[error("{0} is not a time; give seconds from 0")]
    Moment(f64),
    #[error("{0} is not a period; give seconds, at least 1e-9")]
    Period(f64),
}

/// A moment in seconds since the start of the run.
#[derive(Deserialize)]
#[serde(try_from = "f64")]
pub struct Seconds(pub Time);

impl TryFrom<f64> for Seconds {
    type Error = NotATime;
    fn try_from(seconds: f64) -> Result<Seconds, NotATime> {
        match seconds >= 0.0 && seconds.is_finite() {
            true => Ok(Seconds(Time::ZERO + Duration::from_seconds_f64(seconds))),
            false => Err(NotATime::Moment(seconds)),
        }
    }
}

/// A span of simulated time, in seconds.
#[derive(Deserialize)]
#[serde(try_from = "f64")]
pub struct Period(pub Duration);

impl TryFrom<f64> for Period {
    type Error = NotATime;
    fn try_from(seconds: f64) -> Result<Period, NotATime> {
        let period = Duration::from_seconds_f64(seconds);
        match period.is_zero() || !seconds.is_finite() {
            true => Err(NotATime::Period(seconds)),
            false => Ok(Period(period)),
        }
    }
}
