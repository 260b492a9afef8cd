//! `starl test`: runs targets with many seeds and kinds of faults, on all cores, and shrinks what fails to
//! the smallest scenario that still does. See `docs/reference/testing.md`.

mod counterexample;
mod report;
mod search;
mod subject;

use crate::args::TestArguments;
use crate::console;
use crate::failure::Failure;
use crate::json;
use crate::progress::Count;
use crate::run::stop_on_interrupt;
use crate::threads;
use counterexample::Counterexample;
use report::Report;
use search::Search;
use starl_catalog::examples::EXAMPLES;
use starl_catalog::programs::Registry;
use starl_sim::profile::Profile;
use std::sync::atomic::Ordering;
use subject::Subject;

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
    let subjects: Result<Vec<Subject>, Failure> = targets
        .iter()
        .map(|target| Subject::read(target, arguments, registry))
        .collect();
    let search = Search {
        subjects: subjects?,
        profiles,
        first_seed: arguments.first_seed.into(),
        seeds: arguments.seeds.into(),
    };
    let threads = threads::for_runs(arguments.threads);
    std::fs::create_dir_all(&arguments.out)
        .map_err(|error| Failure::file(&arguments.out, error))?;
    let shown = !arguments.quiet && !arguments.json;
    let progress = Count::new(shown, search.runs());
    let found = search.run(threads, &stop, &progress);
    progress.clear();
    let mut counterexamples = Vec::new();
    for (case, times) in found.findings() {
        let limit = u64::from(arguments.shrink);
        let progress = Count::new(shown, limit);
        let subject = &search.subjects[case.subject];
        let counterexample = Counterexample::of(subject, &case, arguments, &stop, &progress)?;
        progress.clear();
        counterexamples.push((case, times, counterexample));
    }
    let interrupted = stop.load(Ordering::Relaxed);
    let report = Report::of(&search, &found, counterexamples, threads, interrupted);
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
