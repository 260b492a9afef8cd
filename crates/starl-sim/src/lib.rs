//! The deterministic simulator of StarL.
//!
//! A discrete-event core with a physics step. Within a step robots are independent of each other:
//! each handles its inputs in the order of their times and moves. Messages and collisions are
//! settled between steps in a fixed order. So the same scenario and seed give the same run on any
//! number of threads and on any target.

pub mod cause;
pub mod engine;
mod fields;
pub mod profile;
pub mod read;
pub mod run;
pub mod scenario;
pub mod shrink;
pub mod trial;
pub mod write;

pub use cause::{Cause, History};
pub use engine::Simulation;
pub use profile::Profile;
pub use run::{Failure, Outcome, Run, setting};
pub use scenario::Scenario;
pub use trial::{Finding, Trial};
