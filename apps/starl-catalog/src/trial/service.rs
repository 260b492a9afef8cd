//! Trials of files in memory, as requests ask for them.

use super::{Extent, Shrinking, Size, Subject, Tried};
use crate::programs::Registry;
use crate::session::{Beside, Files, Opened, Options, Refused, open};
use serde::Serialize;
use starl_sim::profile::Profile;
use starl_sim::read::suggest;
use starl_sim::{Finding, Scenario, Trial, write};
use std::collections::BTreeMap;

/// Trials of files. The last subject is kept, so that many trials of the same files read and compile them once, and
/// shrinking continues where it was.
#[derive(Default)]
pub struct Trials {
    last: Option<Target>,
}

/// Files and options that are tried.
struct Target {
    files: Files,
    options: Options,
    subject: Subject,
    /// The path that the programs' names start from.
    path: String,
    global_names: BTreeMap<String, String>,
    shrinking: Option<((Profile, u64), Shrinking)>,
}

/// A profile of faults.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ProfileReport {
    /// Its name.
    pub name: &'static str,
    /// The faults, in one line.
    pub summary: &'static str,
    /// Whether it is tried unless others are named.
    pub usual: bool,
    /// Whether a run that does not reach its goal is held to be wrong.
    pub demands_goal: bool,
}

/// The smallest scenario that was found to fail.
#[derive(Clone, Debug, Serialize)]
pub struct Shrunk {
    /// Its file, which belongs into the folder of the scenario that was tried.
    pub scenario: String,
    /// The result.
    pub tried: Tried,
    /// How many scenarios were tried.
    pub trials: u64,
    /// Whether nothing more can be left out.
    pub minimal: bool,
    /// The size before.
    pub before: Extent,
    /// The size after.
    pub after: Extent,
}

/// Every profile.
pub fn profiles() -> [ProfileReport; Profile::ALL.len()] {
    Profile::ALL.map(|profile| ProfileReport {
        name: profile.name(),
        summary: profile.summary(),
        usual: Profile::USUAL.contains(&profile),
        demands_goal: profile.demands_goal(),
    })
}

/// A profile by its name, and a seed that a scenario can hold.
fn chosen(profile: &str, seed: &str) -> Result<(Profile, u64), Refused> {
    let found = Profile::by_name(profile).ok_or_else(|| {
        let known = Profile::ALL.map(Profile::name);
        let help = suggest::help(profile, &known, "the profiles are").unwrap_or_default();
        format!("there is no profile {profile:?}; {help}")
    })?;
    let number: i64 = (seed.parse().ok())
        .filter(|number| *number >= 0)
        .ok_or_else(|| {
            let most = i64::MAX;
            format!("{seed:?} is not a seed; use a whole number from 0 to {most}")
        })?;
    Ok((found, number.unsigned_abs()))
}

impl Trials {
    /// Runs files with the faults of a profile, until the run ends or fails.
    ///
    /// # Errors
    /// All problems of the files, and of the profile's name and the seed.
    pub fn try_out(
        &mut self,
        (files, options): (Files, Options),
        (profile, seed): (&str, &str),
        registry: &Registry,
    ) -> Result<Tried, Refused> {
        let (profile, seed) = chosen(profile, seed)?;
        let subject = &self.target(files, options, registry)?.subject;
        let (run, trial) = subject.try_out(profile, seed);
        Ok(Tried::of((profile, seed), &run, &trial))
    }

    /// The scenario with the faults of a profile, as the text of a file for the same folder.
    ///
    /// # Errors
    /// As for [`Trials::try_out`].
    pub fn scenario(
        &mut self,
        (files, options): (Files, Options),
        (profile, seed): (&str, &str),
        registry: &Registry,
    ) -> Result<String, Refused> {
        let (profile, seed) = chosen(profile, seed)?;
        let target = self.target(files, options, registry)?;
        let mut scenario = target.subject.scenario(profile, seed);
        for group in &mut scenario.fleet.groups {
            group.program = global_name(&target.global_names, &group.program);
        }
        Ok(write::scenario(&scenario))
    }

    /// Shrinks a run that goes wrong; tries `most` scenarios in all, those of earlier calls included if they were about
    /// the same run.
    ///
    /// # Errors
    /// As for [`Trials::try_out`], and where the run does not go wrong.
    pub fn shrink(
        &mut self,
        (files, options): (Files, Options),
        (profile, seed): (&str, &str),
        most: u64,
        registry: &Registry,
    ) -> Result<Shrunk, Refused> {
        let key = chosen(profile, seed)?;
        self.target(files, options, registry)?.shrink(key, most)
    }

    fn target(
        &mut self,
        files: Files,
        options: Options,
        registry: &Registry,
    ) -> Result<&mut Target, Refused> {
        let kept = self.last.take();
        let same = |last: &Target| last.files == files && last.options == options;
        let target = match kept.filter(same) {
            Some(target) => target,
            None => Target::open(files, options, registry)?,
        };
        Ok(self.last.insert(target))
    }
}

impl Target {
    fn open(files: Files, options: Options, registry: &Registry) -> Result<Target, Refused> {
        let Opened {
            application,
            path,
            global_names,
            ..
        } = open(&files, &options, registry)?;
        Ok(Target {
            subject: Subject::new(&application, false)
                .map_err(|error| application.problem(error))?,
            files,
            options,
            path,
            global_names,
            shrinking: None,
        })
    }

    fn shrink(&mut self, key: (Profile, u64), most: u64) -> Result<Shrunk, Refused> {
        let (profile, seed) = key;
        let (_, mut shrinking) = match self.shrinking.take().filter(|(known, _)| *known == key) {
            Some(known) => known,
            None => (key, self.begin(key)?),
        };
        let loader = Beside::new(&self.files, &self.path);
        let smaller = shrinking.search(most, &loader, &mut |_: &Scenario| true);
        let before = Extent::from(shrinking.size());
        self.shrinking = Some((key, shrinking));
        let smaller = smaller.ok_or_else(|| {
            let name = profile.name();
            format!(
                "{name}, seed {seed}: the run does not go wrong from a scenario file of its own"
            )
        })?;
        let key = (profile, smaller.scenario.seed);
        Ok(Shrunk {
            tried: Tried::of(key, &smaller.run, &smaller.trial),
            scenario: smaller.text,
            trials: smaller.trials,
            minimal: smaller.is_minimal,
            before,
            after: Size::of(&smaller.scenario).into(),
        })
    }

    fn begin(&self, (profile, seed): (Profile, u64)) -> Result<Shrinking, Refused> {
        let name = profile.name();
        let (_, Trial { finding, .. }) = self.subject.try_out(profile, seed);
        let finding: Finding = finding
            .ok_or_else(|| format!("{name}, seed {seed}: nothing goes wrong in this run"))?;
        let head = format!("# Found with the profile {name} and seed {seed}.\n\n");
        let rename = |program: &str| global_name(&self.global_names, program);
        Ok(Shrinking::new(
            &self.subject,
            (profile, seed),
            finding,
            head,
            &rename,
        ))
    }
}

fn global_name(names: &BTreeMap<String, String>, program: &str) -> String {
    names
        .get(program)
        .map_or(program, String::as_str)
        .to_string()
}
