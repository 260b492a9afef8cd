//! The file with the path to a violation and everything needed to repeat it: JSON, so that it is readable.

use crate::failure::Failure;
use crate::run::start_error;
use crate::target;
use serde::{Deserialize, Serialize};
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_explore::{Bounds, Counterexample, Setup, Step, Walk};
use starl_properties::Violation;
use starl_sim::read::Inputs;
use std::path::Path;

/// The explored part of a scenario.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Recording {
    /// The number of robots: the first ones of the scenario.
    pub robots: usize,
    /// Within these bounds.
    pub bounds: Bounds,
    /// Whether failure detectors sent heartbeats.
    pub heartbeats: bool,
    /// Ticks of the warm-up, if there is one.
    pub warm_up: Option<u16>,
}

/// The layout of the file; another number is another layout.
const LAYOUT: u32 = 1;

/// The content of the file.
#[derive(Serialize, Deserialize)]
pub struct Kept {
    counterexample_layout: u32,
    starl_version: String,
    /// The violated property.
    pub property: String,
    pub text: String,
    #[serde(flatten)]
    pub recording: Recording,
    /// The steps that lead there.
    pub steps: Vec<Step>,
    /// The scenario and its files.
    inputs: Inputs,
}

impl Recording {
    /// The setup of the exploration.
    pub fn setup(&self, application: &Application) -> Result<Setup, Failure> {
        application
            .exploration(self.robots, self.bounds, self.heartbeats)
            .map_err(|error| start_error(application, error))
    }

    /// The fleet at the beginning of the exploration, the number of steps before it, and the violations in them.
    pub fn begin(&self, setup: Setup) -> Result<(Walk, usize, Vec<Violation>), Failure> {
        let (mut walk, first) = Walk::start(setup);
        let mut violations = first.violations;
        let Some(ticks) = self.warm_up else {
            return Ok((walk, 0, violations));
        };
        let taken = walk
            .warm_up(ticks)
            .map_err(|impossible| Failure(format!("--warm-up: {impossible}")))?;
        let steps = taken.len();
        let moments = taken.into_iter().flat_map(|(_, moment)| moment.violations);
        violations.extend(moments);
        Ok((walk, steps, violations))
    }
}

/// The content of the file.
pub fn write(inputs: &Inputs, recording: &Recording, found: &Counterexample) -> String {
    let kept = Kept {
        counterexample_layout: LAYOUT,
        starl_version: env!("CARGO_PKG_VERSION").to_string(),
        property: found.violation.property.to_string(),
        text: found.violation.text.clone(),
        recording: *recording,
        steps: found.steps.clone(),
        inputs: inputs.clone(),
    };
    let text = serde_json::to_string_pretty(&kept)
        .unwrap_or_else(|error| unreachable!("it is plain data: {error}"));
    text + "\n"
}

/// Reads the file.
pub fn read(path: &Path, registry: &Registry) -> Result<(Kept, Application, Setup), Failure> {
    let kept: Kept = serde_json::from_str(&target::text(path)?)
        .map_err(|error| Failure::file(path, format!("is not a counterexample: {error}")))?;
    if kept.counterexample_layout != LAYOUT {
        return Err(Failure::file(
            path,
            format!(
                "is of layout {}, and this command reads layout {LAYOUT}: use StarL {}",
                kept.counterexample_layout, kept.starl_version
            ),
        ));
    }
    let application = starl_catalog::read(&kept.inputs.request, &kept.inputs, registry)
        .map_err(|refusal| Failure::file(path, format!("its inputs are refused: {refusal}")))?;
    let setup = kept.recording.setup(&application)?;
    Ok((kept, application, setup))
}
