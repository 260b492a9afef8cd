//! Sweeps: one target run with every combination of some fields' values and with many seeds. And [`Campaign`]s, which
//! look for failures under faults.
//!
//! A [`Plan`] numbers all runs. Each is a [`Task`], plain data, which [`run_task`] turns into a [`Row`] on any machine:
//! the same task gives the same row, digest included, in any process and on any number of threads. [`execute`] runs
//! tasks on the cores of one machine, a [`Journal`] keeps finished rows, a [`Table`] writes them to a file, and
//! [`Summary`] and [`Comparison`] condense them.
//!
//! Invariant: this crate does not print, and only [`Journal`] and the fields `cpu_seconds` depend on the machine.

mod axis;
mod campaign;
mod compare;
mod error;
mod execute;
mod journal;
mod metric;
mod plan;
mod row;
mod seeds;
mod spread;
mod statistics;
mod summary;
mod table;
mod task;

pub use axis::{Axis, FLEET, Scale};
pub use campaign::{Attempt, Campaign, CampaignPlan, Settings};
pub use compare::{Comparison, Difference, GoalDifference, Pair};
pub use error::Error;
pub use execute::{Measured, execute};
pub use journal::Journal;
pub use metric::{METRICS, Metric};
pub use plan::Plan;
pub use row::Row;
pub use seeds::Seeds;
pub use spread::spread;
pub use statistics::{Interval, agresti_min, mean, wilson};
pub use summary::{Combination, Summary};
pub use table::{Column, Format, Table, Values};
pub use task::{Runner, Task, run_task};
