//! Campaigns: single runs and searches for smaller scenarios, in any process, and shrunk failures.

use crate::engine::{Engine, registry};
use crate::sweep::refused;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::json;
use starl_catalog::trial::{Answers, Extent, Shrinking, Size, Subject};
use starl_sim::Scenario;
use starl_sim::profile::Profile;
use starl_sweep::{Attempt, CampaignPlan, Settings};
use std::collections::BTreeMap;

/// The runs of a scenario, or of several, under profiles of faults.
#[pyclass(frozen, module = "starl._native")]
pub struct Campaign {
    campaign: starl_sweep::Campaign,
    /// The names that programs have everywhere, by those that they have in the scenario.
    global_names: BTreeMap<String, String>,
}

#[pymethods]
impl Campaign {
    /// A campaign of the scenario of a simulation. The seeds follow `first_seed`.
    #[new]
    fn new(
        py: Python<'_>,
        engine: &Engine,
        simulation: u32,
        profiles: Vec<String>,
        first_seed: u64,
        seeds: u64,
        most_trials: u64,
    ) -> PyResult<Campaign> {
        let application = engine.application(py, simulation)?;
        let global_names = engine.global_names(py, simulation)?;
        let profile = |name: &String| {
            let message = || format!("there is no profile {name:?}");
            Profile::by_name(name).ok_or_else(|| PyValueError::new_err(message()))
        };
        let settings = Settings {
            profiles: profiles.iter().map(profile).collect::<PyResult<_>>()?,
            first_seed,
            seeds,
            most_trials,
        };
        let subject = py.detach(|| Subject::new(&application, false));
        let subject = subject
            .map_err(|error| PyValueError::new_err(application.problem(error).to_string()))?;
        Ok(Campaign {
            campaign: starl_sweep::Campaign::new(vec![subject], settings),
            global_names,
        })
    }

    /// The campaign of a plan, of this class or of the command, with these programs in Python.
    #[staticmethod]
    #[pyo3(signature = (plan, programs=None))]
    fn from_plan(
        py: Python<'_>,
        plan: &[u8],
        programs: Option<BTreeMap<String, Py<PyAny>>>,
    ) -> PyResult<Campaign> {
        let plan: CampaignPlan = serde_json::from_slice(plan)
            .map_err(|error| PyValueError::new_err(format!("the plan: {error}")))?;
        let registry = registry(py, programs)?;
        let campaign = py.detach(|| starl_sweep::Campaign::of_plan(plan, &registry));
        Ok(Campaign {
            campaign: campaign.map_err(refused)?,
            global_names: BTreeMap::new(),
        })
    }

    /// The plan with all its texts, for another process.
    fn plan<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, json!(self.campaign.plan()).to_string().as_bytes())
    }

    /// How many runs there are.
    fn __len__(&self) -> usize {
        self.campaign.runs() as usize
    }

    /// The profile and the seed of a run.
    fn at(&self, number: u64) -> PyResult<(&'static str, u64)> {
        let (_, profile, seed) = self.campaign.at(self.checked(number)?);
        Ok((profile.name(), seed))
    }

    /// Makes a run and gives its result in JSON, which depends on the plan and the number alone.
    fn attempt<'py>(&self, py: Python<'py>, number: u64) -> PyResult<Bound<'py, PyBytes>> {
        let number = self.checked(number)?;
        let attempt = py.detach(|| self.campaign.attempt(number));
        Ok(PyBytes::new(py, json!(attempt).to_string().as_bytes()))
    }

    /// Looks for a smaller scenario that fails as a run does, and gives in JSON the number of the run and what `smaller`
    /// needs to know.
    fn shrink<'py>(&self, py: Python<'py>, number: u64) -> PyResult<Bound<'py, PyBytes>> {
        let number = self.checked(number)?;
        let answers = py.detach(|| self.campaign.shrink(number));
        let found = json!((number, answers)).to_string();
        Ok(PyBytes::new(py, found.as_bytes()))
    }

    /// The smallest scenario that fails as a run does, in JSON, by what `attempt` and `shrink` found about the run; None if
    /// the run does not fail from a scenario of its own.
    fn smaller(&self, py: Python<'_>, attempt: &[u8], shrunk: &[u8]) -> PyResult<Option<String>> {
        let strange = |error| PyValueError::new_err(format!("the result: {error}"));
        let attempt: Attempt = serde_json::from_slice(attempt).map_err(strange)?;
        let (_, answers): (u64, Answers) = serde_json::from_slice(shrunk).map_err(strange)?;
        let Some(finding) = attempt.finding else {
            return Ok(None);
        };
        let (subject, profile, seed) = self.campaign.at(self.checked(attempt.number)?);
        let subject = &self.campaign.subjects()[subject];
        let name = profile.name();
        let head = format!("# Found with the profile {name} and seed {seed}.\n\n");
        let rename = |program: &str| {
            let known = self.global_names.get(program);
            known.map_or(program, String::as_str).to_string()
        };
        Ok(py.detach(|| {
            let shrinking = Shrinking::new(subject, (profile, seed), finding, head, &rename);
            let mut shrinking = shrinking.after(answers);
            let inputs = &subject.application.resolved().inputs;
            let most = self.campaign.settings().most_trials;
            let smaller = shrinking.search(most, inputs, &mut |_: &Scenario| true)?;
            let found = json!({
                "scenario": smaller.text,
                "before": Extent::from(shrinking.size()),
                "after": Extent::from(Size::of(&smaller.scenario)),
                "trials": smaller.trials,
                "minimal": smaller.is_minimal,
            });
            Some(found.to_string())
        }))
    }
}

impl Campaign {
    fn checked(&self, number: u64) -> PyResult<u64> {
        match number < self.campaign.runs() {
            true => Ok(number),
            false => Err(PyValueError::new_err(format!("there is no run {number}"))),
        }
    }
}
