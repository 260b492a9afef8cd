//! A plan: all runs of a sweep, numbered.
//!
//! Combinations are numbered with the first axis slowest and the last fastest, and the seeds run fastest of all: task
//! `combination * seeds + seed`. So the numbers of a plan never depend on how it is carried out.

use crate::task::{named_profile, setting};
use crate::{Axis, Error, FLEET, Measured, Seeds, Task};
use serde::{Deserialize, Serialize};
use starl_catalog::{Application, read};
use starl_core::Digest;
use starl_sim::Scenario;
use starl_sim::read::{Inputs, Loader, Override};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A sweep that was found to be possible: every combination can be read. It is plain data that can be sent elsewhere.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Plan {
    /// The target as the person named it.
    target: String,
    /// The scenario with every file that some combination names.
    inputs: Arc<Inputs>,
    axes: Vec<Axis>,
    /// The models of the scenario's fleet with the number of each, where the number of robots is an axis.
    models: Vec<(String, u64)>,
    profile: Option<String>,
    seeds: Seeds,
}

/// A plan with more runs is a slip.
const MOST_RUNS: u64 = 10_000_000;

impl Plan {
    /// A plan for a target that was read with the first value of each axis. `loader` brings the files that the other
    /// combinations name.
    ///
    /// # Errors
    /// If an axis is given twice, the profile does not exist, or some combination has errors: all of the first one that
    /// has.
    pub fn new(
        target: &str,
        application: &Application,
        axes: Vec<Axis>,
        seeds: Seeds,
        profile: Option<&str>,
        loader: &dyn Loader,
    ) -> Result<Plan, Error> {
        check_axes(&axes, application)?;
        if let Some(name) = profile {
            named_profile(name)?;
        }
        let mut plan = Plan {
            target: target.to_string(),
            inputs: Arc::new(application.resolved().inputs.clone()),
            models: models(application.scenario()),
            axes,
            profile: profile.map(str::to_string),
            seeds,
        };
        plan.check_size()?;
        let mut files = plan.inputs.files.clone();
        for combination in 0..plan.combinations() {
            let task = plan.task(combination * seeds.count());
            let application = read(&task.request(true), loader, application.registry())?;
            files.extend(application.resolved().inputs.files.clone());
        }
        let request = plan.inputs.request.clone();
        plan.inputs = Arc::new(Inputs { request, files });
        Ok(plan)
    }

    fn check_size(&self) -> Result<(), Error> {
        let lengths = self.axes.iter().map(|axis| axis.values.len() as u64);
        let mut all = lengths.chain([self.seeds.count()]);
        let runs = all.try_fold(1_u64, |runs, length| runs.checked_mul(length));
        match runs {
            Some(runs) if runs <= MOST_RUNS => Ok(()),
            _ => {
                let message = format!("this sweep has more than {MOST_RUNS} runs");
                Err(Error::option(
                    "--set",
                    message,
                    "give fewer values or seeds",
                ))
            }
        }
    }

    /// The target as the person named it.
    pub fn target(&self) -> &str {
        &self.target
    }

    /// The axes, the slowest first.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The seeds of each combination.
    pub fn seeds(&self) -> Seeds {
        self.seeds
    }

    /// The profile of faults.
    pub fn profile(&self) -> Option<&str> {
        self.profile.as_deref()
    }

    /// The scenario with the files that it names.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// How many combinations there are, at least one.
    pub fn combinations(&self) -> u64 {
        let lengths = self.axes.iter().map(|axis| axis.values.len() as u64);
        lengths.product()
    }

    /// How many tasks there are.
    #[allow(clippy::len_without_is_empty, reason = "a plan has at least one task")]
    pub fn len(&self) -> u64 {
        self.combinations() * self.seeds.count()
    }

    /// The index in each axis of a combination's value.
    pub fn indices(&self, combination: u64) -> Vec<usize> {
        let mut rest = combination;
        let mut indices: Vec<usize> = (self.axes.iter().rev())
            .map(|axis| {
                let length = axis.values.len() as u64;
                let index = rest % length;
                rest /= length;
                index as usize
            })
            .collect();
        indices.reverse();
        indices
    }

    /// The value that a combination has of each axis.
    pub fn values(&self, combination: u64) -> Vec<&str> {
        let indices = self.indices(combination);
        let values = self.axes.iter().zip(indices);
        values.map(|(axis, index)| &*axis.values[index]).collect()
    }

    /// The combination of a task.
    pub fn combination(&self, number: u64) -> u64 {
        number / self.seeds.count()
    }

    /// The seed of a task.
    pub fn seed(&self, number: u64) -> u64 {
        self.seeds.first() + number % self.seeds.count()
    }

    /// A task.
    ///
    /// # Panics
    /// If there is no task of this number.
    pub fn task(&self, number: u64) -> Task {
        assert!(number < self.len(), "the plan has no task {number}");
        let values = self.values(self.combination(number));
        let mut settings: Vec<Override> = Vec::new();
        let mut robots = None;
        for (axis, value) in self.axes.iter().zip(values) {
            match &*axis.field {
                FLEET => robots = Some(self.fleet(value)),
                field => settings.push(setting(field, value)),
            }
        }
        Task {
            number,
            inputs: self.inputs.clone(),
            settings,
            robots,
            profile: self.profile.clone(),
            seed: self.seed(number),
        }
    }

    /// The numbers of the tasks without rows, in order.
    pub fn open(&self, rows: &BTreeMap<u64, Measured>) -> Vec<u64> {
        let all = 0..self.len();
        all.filter(|number| !rows.contains_key(number)).collect()
    }

    /// Identifies the plan with all its texts, for this version of StarL.
    pub fn identity(&self) -> String {
        let text = serde_json::to_vec(self);
        let text = text.unwrap_or_else(|error| unreachable!("a plan is plain data: {error}"));
        let mut digest = Digest::default();
        digest.bytes(env!("CARGO_PKG_VERSION").as_bytes());
        digest.bytes(&text);
        digest.to_string()
    }

    /// A fleet of so many robots, as `--robots` has it: each model keeps its share of the scenario's fleet. Robots that are
    /// left over go to the models with the largest remainders, and among equal ones to the first (Hamilton's method).
    fn fleet(&self, robots: &str) -> String {
        let robots: u64 = robots.parse().unwrap_or(0);
        let all: u64 = self.models.iter().map(|(_, count)| count).sum();
        let whole = |count: u64| robots * count / all;
        let mut shares: Vec<u64> = self.models.iter().map(|(_, count)| whole(*count)).collect();
        let mut order: Vec<usize> = (0..shares.len()).collect();
        order.sort_by_key(|&index| std::cmp::Reverse(robots * self.models[index].1 % all));
        let left = robots - shares.iter().sum::<u64>();
        for index in order.into_iter().take(left as usize) {
            shares[index] += 1;
        }
        let named = self.models.iter().zip(shares);
        let named = named.map(|((model, _), share)| format!("{model}={share}"));
        named.collect::<Vec<_>>().join(",")
    }
}

/// The models of a fleet with the number of each, in the order in which they appear.
fn models(scenario: &Scenario) -> Vec<(String, u64)> {
    let mut models: Vec<(String, u64)> = Vec::new();
    for group in &scenario.fleet.groups {
        let (name, count) = (group.model.name(), group.starts.len() as u64);
        match models.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => *known += count,
            None => models.push((name.to_string(), count)),
        }
    }
    models
}

fn check_axes(axes: &[Axis], application: &Application) -> Result<(), Error> {
    let mut fields = BTreeMap::new();
    for axis in axes {
        let option = crate::axis::option(&axis.field);
        if fields.insert(&*axis.field, ()).is_some() {
            let help = "list all its values in one option";
            return Err(Error::option(&option, "this axis is given twice", help));
        }
    }
    let request = &application.resolved().inputs.request;
    let has_own_option =
        |set: &&Override| !set.option.starts_with("--set") && fields.contains_key(&*set.path);
    if let Some(Override { option, path, .. }) = request.overrides.iter().find(has_own_option) {
        let message = format!("it contradicts {option}, which sets this field too");
        let help = "leave one of them out";
        return Err(Error::option(&crate::axis::option(path), message, help));
    }
    if fields.contains_key(FLEET) {
        let set = request.overrides.iter().map(|set| &*set.path);
        let counts = |path: &&str| {
            *path == "robots" || path.starts_with("robots.") && path.ends_with(".count")
        };
        let count = set.chain(fields.into_keys()).find(counts);
        if let Some(other) = request.robots.as_ref().map(|_| "--robots").or(count) {
            let help = "leave one of them out";
            let message = format!("it contradicts {other}, which sets robots too");
            return Err(Error::option("--set fleet", message, help));
        }
    }
    Ok(())
}
