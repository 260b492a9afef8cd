//! A run that went wrong, shrunk, saved and drawn.

use super::search::{Case, Search};
use super::subject::Target;
use crate::args::TestArguments;
use crate::console;
use crate::diagram;
use crate::failure::Failure;
use crate::origin::Origin;
use crate::output::Output;
use crate::progress::Count;
use crate::run::quoted;
use starl_catalog::trial::{Answers, Shrinking, Size};
use starl_sim::Scenario;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// A scenario that fails, in a file.
#[derive(Clone, Debug)]
pub struct Counterexample {
    /// The scenario's file; none if the run could not be saved so that it fails again.
    pub scenario: Option<PathBuf>,
    /// The space-time diagram of it.
    pub diagram: Option<PathBuf>,
    /// Before and after.
    pub sizes: [Size; 2],
    /// The observation in the smallest one.
    pub text: String,
    /// How many scenarios were tried; none if someone stopped it before.
    pub trials: u64,
    /// Whether nothing more can be left out.
    pub is_minimal: bool,
    /// A command line that does the run before it was shrunk.
    pub again: String,
}

impl Counterexample {
    /// Shrinks a run and saves it; an interrupted search saves the smallest scenario so far. `known` contains a
    /// cluster's results for scenarios; the others are tried here.
    pub fn of(
        search: &Search,
        case: &Case,
        known: Answers,
        arguments: &TestArguments,
        stop: &AtomicBool,
        progress: &Count,
    ) -> Result<Counterexample, Failure> {
        let target = &search.targets[case.subject];
        let subject = &search.campaign.subjects()[case.subject];
        let is_stopped = || stop.load(Ordering::Relaxed);
        let path = free_path(&arguments.out, &name(target, case));
        let rename = |program: &str| target.origin.key_from(program, &path);
        let again = again(target, case, arguments);
        let head = head(target, case, &again);
        let key = (case.profile, case.seed);
        let shrinking = Shrinking::new(subject, key, case.finding.clone(), head, &rename);
        let mut shrinking = shrinking.after(known);
        let most = u64::from(arguments.shrink);
        let smaller = shrinking.search(most, &Origin::file(&path), &mut |scenario| {
            let go_on = !is_stopped();
            if go_on {
                progress.add(1);
                progress.say(describe(scenario));
            }
            go_on
        });
        let mut counterexample = Counterexample {
            scenario: None,
            diagram: None,
            sizes: [shrinking.size(); 2],
            text: case.text.clone(),
            trials: u64::from(!is_stopped()),
            is_minimal: false,
            again,
        };
        let Some(smaller) = smaller else {
            return Ok(counterexample);
        };
        // The report says how to find the run again, and is not lost with the file.
        if let Err(failure) = save(&path, smaller.text.as_bytes()) {
            console::error(&failure.to_string());
            counterexample.trials = 0;
            return Ok(counterexample);
        }
        let picture = path.with_extension("svg");
        let drawn = diagram::of_run(&smaller.application, &diagram::Extent::default())?;
        match save(&picture, &drawn.svg()) {
            Ok(()) => counterexample.diagram = Some(picture),
            Err(failure) => console::error(&failure.to_string()),
        }
        counterexample.text = smaller.trial.text;
        counterexample.sizes[1] = Size::of(&smaller.scenario);
        counterexample.trials = smaller.trials;
        counterexample.is_minimal = smaller.is_minimal && !is_stopped();
        counterexample.scenario = Some(path);
        Ok(counterexample)
    }
}

fn describe(scenario: &Scenario) -> String {
    let Size {
        robots,
        faults,
        duration,
    } = Size::of(scenario);
    format!("smaller ones: {robots} robots, {faults} faults, {duration};")
}

/// The head of the file.
fn head(target: &Target, case: &Case, again: &str) -> String {
    format!(
        "# {} fails here: {}.\n# Found by: {}\n\n",
        one_line(&target.name),
        one_line(&case.finding.to_string()),
        one_line(again)
    )
}

fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// The command line that finds a run again.
fn again(target: &Target, case: &Case, arguments: &TestArguments) -> String {
    let mut words = vec![format!("{} test", console::command()), quoted(&target.name)];
    let changes = &arguments.changes;
    let options = [
        ("--scenario", changes.scenario.clone()),
        ("--robots", changes.robots.clone()),
        ("--duration", changes.duration.clone()),
        (
            "--faults",
            changes
                .faults
                .as_ref()
                .map(|path| path.display().to_string()),
        ),
        ("--profile", Some(case.profile.name().to_string())),
        ("--first-seed", Some(case.seed.to_string())),
        ("--seeds", Some("1".to_string())),
    ];
    let sets = changes.set.iter().map(|set| ("--set", Some(set.clone())));
    for (option, value) in sets.chain(options) {
        if let Some(value) = value {
            words.push(format!("{option} {}", quoted(&value)));
        }
    }
    if arguments.demand_goal {
        words.push("--demand-goal".to_string());
    }
    words.join(" ")
}

/// The name of a run's files, without their suffixes.
fn name(target: &Target, case: &Case) -> String {
    let stem = Path::new(&target.name).file_stem().unwrap_or_default();
    let name = format!(
        "{}-{}-{}-{}",
        stem.display(),
        case.property(),
        case.profile.name(),
        case.seed
    );
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    name.replace(|c| !plain(c), "-")
}

/// The name of a file in a folder that is not there yet, nor a picture beside it.
fn free_path(folder: &Path, name: &str) -> PathBuf {
    let numbers = (2..).map(|number| format!("{name}-{number}"));
    let names = std::iter::once(name.to_string()).chain(numbers);
    // Files in the working folder are shown by their names alone.
    let folder = if folder == Path::new(".") {
        Path::new("")
    } else {
        folder
    };
    let mut paths = names.map(|name| folder.join(format!("{name}.toml")));
    let free = |path: &PathBuf| !path.exists() && !path.with_extension("svg").exists();
    paths.find(free).unwrap_or_else(|| folder.join(name))
}

fn save(path: &Path, content: &[u8]) -> Result<(), Failure> {
    let (output, file) = Output::create(path)?;
    output.write(file, content)
}
