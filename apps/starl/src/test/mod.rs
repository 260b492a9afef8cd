//! `starl test`: runs targets with many seeds and kinds of faults, on all cores, and shrinks what fails to
//! the smallest scenario that still does. See `docs/reference/testing.md`.

mod counterexample;
mod report;
mod search;
mod subject;

use crate::args::TestArguments;
use crate::cluster::Workers;
use crate::console;
use crate::failure::Failure;
use crate::json;
use crate::progress::Count;
use crate::run::stop_on_interrupt;
use counterexample::Counterexample;
use report::Report;
use search::Search;
use starl_catalog::examples::EXAMPLES;
use starl_catalog::programs::Registry;
use starl_sim::profile::Profile;
use starl_sweep::{Campaign, Settings};
use std::sync::atomic::Ordering;
use subject::Target;

/// Tests what the arguments say; whether nothing went wrong.
pub fn test(arguments: &TestArguments, registry: &Registry) -> Result<bool, Failure> {
    let stop = stop_on_interrupt();
    let profiles = profiles(&arguments.profile)?;
    let targets: Vec<String> = match arguments.all {
        true => EXAMPLES
            .iter()
            .map(|example| example.name.to_string())
            .collect(),
        false => arguments.targets.clone(),
    };
    let read = targets
        .iter()
        .map(|target| Target::read(target, arguments, registry));
    let (targets, subjects) = read
        .collect::<Result<Vec<_>, Failure>>()?
        .into_iter()
        .unzip();
    let settings = Settings {
        profiles,
        first_seed: arguments.first_seed.into(),
        seeds: arguments.seeds.into(),
        most_trials: arguments.shrink.into(),
    };
    let search = Search {
        targets,
        campaign: Campaign::new(subjects, settings),
    };
    std::fs::create_dir_all(&arguments.out)
        .map_err(|error| cannot_create(&arguments.out, &error))?;
    let mut workers = Workers::of(&arguments.cluster, arguments.threads, &stop)?;
    let shown = !arguments.quiet && !arguments.json;
    let progress = Count::new(shown, search.campaign.runs());
    let found = search.run(&mut workers, &stop, &progress);
    progress.clear();
    let found = found?;
    let cases = found.findings();
    let progress = Count::new(shown, cases.len() as u64);
    progress.say("failures shrunk,");
    let known = search.shrink(&cases, &mut workers, &stop, &progress);
    progress.clear();
    let mut known = known?;
    let mut counterexamples = Vec::new();
    for (case, times) in cases {
        let progress = Count::new(shown, u64::from(arguments.shrink));
        let known = known.remove(&case.number).unwrap_or_default();
        let counterexample =
            Counterexample::of(&search, &case, known, arguments, &stop, &progress)?;
        progress.clear();
        counterexamples.push((case, times, counterexample));
    }
    let interrupted = stop.load(Ordering::Relaxed);
    let report = Report::of(&search, &found, counterexamples, &workers, interrupted);
    match arguments.json {
        true => json::print(&report)?,
        false => console::print(&report.text(arguments.quiet))?,
    }
    Ok(report.is_success())
}

/// The profiles that are named, in their own order.
fn profiles(names: &[String]) -> Result<Vec<Profile>, Failure> {
    if names.is_empty() {
        return Ok(Profile::USUAL.to_vec());
    }
    let mut wanted = Vec::new();
    for name in names {
        match (name.as_str(), Profile::by_name(name)) {
            ("all", _) => wanted.extend(Profile::ALL),
            (_, Some(profile)) => wanted.push(profile),
            _ => {
                let known = Profile::ALL.map(Profile::name);
                let help = starl_sim::read::suggest::help(name, &known, "there are");
                return Err(Failure(format!(
                    "--profile {name}: there is no such profile; {}",
                    help.unwrap_or_default()
                )));
            }
        }
    }
    wanted.sort_unstable();
    wanted.dedup();
    Ok(wanted)
}

fn cannot_create(folder: &std::path::Path, error: &std::io::Error) -> Failure {
    if error.kind() == std::io::ErrorKind::AlreadyExists {
        return Failure::file(folder, "is a file; name a folder for --out".to_string());
    }
    let reason = starl_catalog::disk::reason(error);
    Failure::file(
        folder,
        format!("the folder cannot be created: {reason}; choose another path"),
    )
}
