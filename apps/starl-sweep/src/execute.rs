//! Tasks on the cores of this machine.

use crate::{Error, Row, Runner, Task, spread};
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

/// A row, and its cost on this machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The result of the run.
    #[serde(flatten)]
    pub row: Row,
    /// Time that the run had of a processor, seconds. It differs from machine to machine.
    pub cpu_seconds: f64,
}

/// Runs tasks on this number of threads, and passes each finished row to `take`, with the key of its task. Ends early
/// when `stop` is set; current runs are then cancelled.
///
/// # Errors
/// The first error of a task or of `take`.
pub fn execute<K: Send>(
    tasks: impl Iterator<Item = (K, Task)> + Send,
    runner: &Runner,
    threads: usize,
    stop: &AtomicBool,
    mut take: impl FnMut(K, Measured) -> Result<(), Error>,
) -> Result<(), Error> {
    let work = |(key, task): (K, Task)| {
        let measured = runner.measure(&task, stop)?;
        Ok(measured.map(|measured| (key, measured)))
    };
    spread(threads, tasks, stop, work, |result: Result<_, Error>| {
        result?.map_or(Ok(()), |(key, measured)| take(key, measured))
    })
}

impl Runner {
    /// Runs a task to its end and measures its cost; none if `stop` was set before.
    ///
    /// # Errors
    /// As for [`run_task`](crate::run_task).
    pub fn measure(&self, task: &Task, stop: &AtomicBool) -> Result<Option<Measured>, Error> {
        let before = ThreadTime::try_now();
        let row = self.run_unless(task, stop)?;
        let spent = before.and_then(|before| before.try_elapsed());
        Ok(row.map(|row| Measured {
            row,
            cpu_seconds: spent.map_or(0.0, |spent| spent.as_secs_f64()),
        }))
    }
}
