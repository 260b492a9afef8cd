//! `starl compare`: two versions of a program or a scenario with the same seeds. See `docs/reference/command.md`.

mod report;

use crate::args::{ChangeArguments, CompareArguments};
use crate::console;
use crate::failure::Failure;
use crate::json;
use crate::progress::Count;
use crate::run::stop_on_interrupt;
use crate::sweep::{Shown, refused, shown};
use crate::target::{self, Selection};
use crate::threads;
use report::{Circumstances, Report, Side};
use starl_catalog::programs::Registry;
use starl_sweep::{Comparison, Error, Plan, Row, Runner, Seeds, execute};
use std::time::Instant;

/// Compares what the arguments name; whether no seed became worse.
pub fn compare(arguments: &CompareArguments, registry: &Registry) -> Result<bool, Failure> {
    let metrics: Option<Vec<Shown>> = match arguments.runs.metric.is_empty() {
        true => None,
        false => Some(shown(&arguments.runs.metric)?),
    };
    let seeds: Seeds = arguments.runs.seeds.parse()?;
    let b = arguments.b.as_ref().unwrap_or(&arguments.a);
    let sides = [
        (&arguments.a, &arguments.set_a, "--set-a"),
        (b, &arguments.set_b, "--set-b"),
    ];
    let [a, b] = sides.map(|(target, set, option)| {
        plan(target, set, arguments, seeds, registry)
            .map_err(|failure| named_after(failure, set, option))
    });
    let plans = [a?, b?];
    let stop = stop_on_interrupt();
    let progress = Count::new(
        !arguments.runs.quiet && !arguments.runs.json,
        2 * seeds.count(),
    );
    let threads = threads::for_runs(arguments.runs.threads);
    let begun = Instant::now();
    // In turn, so that an interrupted comparison has pairs.
    let tasks = (0..2 * seeds.count()).map(|number| {
        let side = (number % 2) as usize;
        (side, plans[side].task(number / 2))
    });
    let mut rows: [Vec<Row>; 2] = Default::default();
    let runner = Runner::new(registry.clone());
    let done = execute(tasks, &runner, threads, &stop, |side: usize, measured| {
        rows[side].push(measured.row);
        progress.add(1);
        Ok::<(), Error>(())
    });
    progress.clear();
    done?;
    for rows in &mut rows {
        rows.sort_by_key(|row| row.seed);
    }
    let [a, b] = sides.map(|(target, set, _)| Side::new(target, set, &arguments.changes));
    let comparison = Comparison::of(&rows[0], &rows[1]);
    let report = Report::of(
        comparison,
        Circumstances {
            sides: [a, b],
            seeds,
            profile: arguments.runs.profile.clone(),
            wall_seconds: begun.elapsed().as_secs_f64(),
            threads,
        },
    );
    match arguments.runs.json {
        true => json::print(&report)?,
        false => console::print(&report.text(metrics.as_deref(), arguments.runs.quiet))?,
    }
    Ok(report.is_success())
}

/// The failure, with the option that set the field in place of `--set`.
fn named_after(failure: Failure, set: &[String], option: &str) -> Failure {
    let named = |change: &String| {
        let field = change.split('=').next().unwrap_or_default();
        let rest = failure.0.strip_prefix("--set ")?;
        let is_named = rest.strip_prefix(field)?.starts_with([':', '.']);
        is_named.then(|| Failure(format!("{option} {rest}")))
    };
    set.iter().find_map(named).unwrap_or(failure)
}

fn plan(
    target: &str,
    set: &[String],
    arguments: &CompareArguments,
    seeds: Seeds,
    registry: &Registry,
) -> Result<Plan, Failure> {
    let common = &arguments.changes;
    let changes = ChangeArguments {
        set: [&common.set[..], set].concat(),
        ..common.clone()
    };
    let quiet = arguments.runs.quiet || arguments.runs.json;
    let Selection {
        application,
        origin,
        ..
    } = target::read(&changes.of(target, None, quiet), registry)?;
    let profile = arguments.runs.profile.as_deref();
    let plan = Plan::new(target, &application, Vec::new(), seeds, profile, &origin);
    plan.map_err(|error| refused(error, &origin))
}
