//! `starl replay`: runs the recorded inputs of a trace again and compares record by record.
//!
//! The trace is read twice: once in full, so that a damaged one is found before anything is run, and
//! once beside the run again.

use crate::args::ReplayArguments;
use crate::console::{self, grouped};
use crate::failure::Failure;
use crate::report::Ending;
use crate::{run, threads};
use starl_catalog::disk::{self, reason};
use starl_catalog::programs::Registry;
use starl_catalog::{Application, recording};
use starl_core::{Event, Intervention, Record, Time};
use starl_properties::Setting;
use starl_sim::Run;
use starl_trace::{Comparison, Difference, Header, Reader, Summary, TraceError};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Compares a trace with a run again; whether they are the same.
pub fn replay(arguments: &ReplayArguments, registry: &Registry) -> Result<bool, Failure> {
    let path = arguments.trace.as_path();
    let Contents {
        header,
        summary,
        records,
        steered,
        cut,
    } = read_through(path)?;
    if let Some(setting) = of_real_robots(&header) {
        let name = setting
            .only
            .map_or(&header.robots[0], |robot| &header.robots[robot.index()]);
        let what = format!(
            "is of real robots, which no simulation repeats; `--robot {}` repeats the software of one",
            run::quoted(&name.name)
        );
        return Err(Failure::file(path, what));
    }
    let application = inputs(path, &header, registry)?;
    let threads = threads::count(arguments.threads, application.scenario().fleet.len());
    let mut run = run::start(&application)?;
    run.set_parallel(threads > 1);
    run.repeat(steered);
    let end = summary.as_ref().map(|summary| summary.outcome.end);
    let found = threads::with(threads, || compare(path, &mut run, end, records))??;
    let (same, text) = match (found, &summary) {
        (Some(found), _) => (false, tell(&found, &header)),
        (None, Some(summary)) => ending(&run, summary),
        (None, None) => {
            let records = format!("{} records", grouped(records));
            (true, as_far_as_it_goes(&records))
        }
    };
    let version = match same {
        true => String::new(),
        false => other_version(&header),
    };
    let text = text + &version + &missing_end(cut.as_ref());
    console::print(&format!("{}: {text}\n", path.display()))?;
    Ok(same)
}

/// The setting of a trace that real robots have written; none for a simulated run.
pub fn of_real_robots(header: &Header) -> Option<Setting> {
    let setting: Setting = serde_json::from_str(&header.setting).ok()?;
    (!setting.simulated).then_some(setting)
}

pub fn open(path: &Path) -> Result<Reader<BufReader<File>>, Failure> {
    if path.is_dir() {
        return Err(Failure::file(path, "is a folder; name the trace in it"));
    }
    let file = disk::open(path).map_err(|error| {
        Failure::file(
            path,
            format!("cannot be read: {}; check the path", reason(&error)),
        )
    })?;
    Reader::new(BufReader::new(file)).map_err(|error| unreadable(path, &error))
}

pub fn unreadable(path: &Path, error: &TraceError) -> Failure {
    Failure::file(path, error)
}

/// The content of a trace.
struct Contents {
    header: Header,
    /// `None` if the end is missing.
    summary: Option<Summary>,
    records: u64,
    /// The interventions of the run, with their times.
    steered: Vec<(Time, Intervention)>,
    /// Why the end is missing.
    cut: Option<TraceError>,
}

/// Reads a trace from end to end, or as far as it goes.
fn read_through(path: &Path) -> Result<Contents, Failure> {
    let mut reader = open(path)?;
    let mut steered = Vec::new();
    let mut cut = None;
    for record in &mut reader {
        match record {
            Ok(record) => {
                if let Event::Intervention(what) = record.event {
                    steered.push((record.at, *what));
                }
            }
            Err(error) if error.is_missing_end() => cut = Some(error),
            Err(error) => return Err(unreadable(path, &error)),
        }
    }
    Ok(Contents {
        header: reader.header().clone(),
        summary: reader.summary().filter(|_| cut.is_none()).cloned(),
        records: reader.progress().records,
        steered,
        cut,
    })
}

/// The result for a trace whose end is missing.
pub fn as_far_as_it_goes(agreed: &str) -> String {
    format!("identical as far as the trace goes: {agreed}")
}

/// A line on the end of a trace, where it is missing.
pub fn missing_end(cut: Option<&TraceError>) -> String {
    cut.map_or_else(String::new, |error| format!("\n  {error}"))
}

/// The inputs with which the recorded run was started.
pub fn inputs(path: &Path, header: &Header, registry: &Registry) -> Result<Application, Failure> {
    let because = |what: String| {
        Failure::file(
            path,
            format!("the recorded inputs cannot be run again: {what}"),
        )
    };
    let inputs = recording::inputs(header).map_err(|error| because(error.to_string()))?;
    starl_catalog::read(&inputs.request, &inputs, registry)
        .map_err(|refusal| because(refusal.to_string()))
}

/// Runs again up to the recorded end, or to the last record of a trace whose end is missing.
fn compare(
    path: &Path,
    run: &mut Run,
    end: Option<Time>,
    records: u64,
) -> Result<Option<Difference>, Failure> {
    let recorded = open(path)?.take(usize::try_from(records).unwrap_or(usize::MAX));
    let mut comparison = Comparison::new(recorded);
    let is_past = |now, agreed| match end {
        Some(end) => now >= end,
        None => agreed == records,
    };
    while !run.is_over() && !is_past(run.simulation().now(), comparison.agreed()) {
        for record in run.step() {
            if end.is_none() && comparison.agreed() == records {
                break;
            }
            comparison
                .push(record)
                .map_err(|error| unreadable(path, &error))?;
        }
        if comparison.difference().is_some() {
            break;
        }
    }
    comparison
        .finish()
        .map_err(|error| unreadable(path, &error))
}

/// Whether the runs ended the same, once their records are, and the words for it.
fn ending(run: &Run, summary: &Summary) -> (bool, String) {
    let simulation = run.simulation();
    let recorded = &summary.outcome;
    let records = grouped(summary.records);
    let digest = simulation.digest();
    let interrupted = recorded.outcome == Ending::Interrupted.word();
    let outcome = Ending::of(run, interrupted).word();
    let different = |what: &str, recorded: &str, again: &str| {
        let text = format!(
            "different: all {records} records agree, but not the {what}\n  recorded:  {recorded}\n  run again: {again}"
        );
        (false, text)
    };
    if digest.value() != recorded.digest {
        return different(
            "digest",
            &format!("{:016x}", recorded.digest),
            &digest.to_string(),
        );
    }
    if simulation.now() != recorded.end {
        return different(
            "end",
            &recorded.end.to_string(),
            &simulation.now().to_string(),
        );
    }
    if outcome != recorded.outcome {
        return different("outcome", &recorded.outcome, outcome);
    }
    (
        true,
        format!("identical: {records} records, digest {digest}"),
    )
}

/// Says where two runs part.
fn tell(difference: &Difference, header: &Header) -> String {
    let Difference {
        agreed,
        recorded,
        rerun,
    } = difference;
    let place = match recorded.as_ref().or(rerun.as_ref()) {
        Some(record) => format!("at {:.9} s, {}", record.at.seconds(), whose(record, header)),
        None => "at the end".to_string(),
    };
    let agreed = grouped(*agreed);
    format!(
        "different: first {place}, after {agreed} equal records\n  recorded:  {}\n  run again: {}",
        show(recorded.as_ref(), header),
        show(rerun.as_ref(), header)
    )
}

fn whose(record: &Record, header: &Header) -> String {
    match record.robot {
        Some(robot) => match header.robots.get(robot.index()) {
            Some(entry) => format!("robot {}", entry.name),
            None => format!("robot {robot}"),
        },
        None => "the world".to_string(),
    }
}

fn show(record: Option<&Record>, header: &Header) -> String {
    const LONGEST: usize = 400;
    let Some(record) = record else {
        return "nothing more".to_string();
    };
    let event = format!("{:?}", record.event);
    let shown: String = event.chars().take(LONGEST).collect();
    let more = if shown.len() < event.len() { "..." } else { "" };
    format!(
        "{:.9} s, {}: {shown}{more}",
        record.at.seconds(),
        whose(record, header)
    )
}

/// A hint where another version made the trace.
pub fn other_version(header: &Header) -> String {
    let ours = env!("CARGO_PKG_VERSION");
    match header.starl_version == ours {
        true => String::new(),
        false => format!(
            "\n  the trace is by StarL {}, this is {ours}: use that version to repeat it",
            header.starl_version
        ),
    }
}
