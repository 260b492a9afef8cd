//! Tasks on the cores of this machine.

use crate::{Error, Plan, Row, Runner, spread};
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

/// A row, and what it cost on this machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What came of the run.
    #[serde(flatten)]
    pub row: Row,
    /// Time that the run had of a processor, seconds. It differs from machine to machine.
    pub cpu_seconds: f64,
}

/// Runs the tasks of a plan that are not `done`, on so many threads, and gives each row to `take` as it comes. Ends early
/// when `stop` is set; runs under way are then given up.
///
/// # Errors
/// The first error of a task or of `take`.
pub fn execute(
    plan: &Plan,
    done: &BTreeMap<u64, Measured>,
    runner: &Runner,
    threads: usize,
    stop: &AtomicBool,
    mut take: impl FnMut(Measured) -> Result<(), Error>,
) -> Result<(), Error> {
    let open = (0..plan.len()).filter(|number| !done.contains_key(number));
    let work = |number: u64| {
        let before = ThreadTime::try_now();
        let task = plan.task(number);
        let row = runner.run_unless(&task, stop)?;
        let spent = before.and_then(|before| before.try_elapsed());
        Ok(row.map(|row| Measured {
            row,
            cpu_seconds: spent.map_or(0.0, |spent| spent.as_secs_f64()),
        }))
    };
    spread(threads, open, stop, work, |result: Result<_, Error>| {
        result?.map_or(Ok(()), &mut take)
    })
}
