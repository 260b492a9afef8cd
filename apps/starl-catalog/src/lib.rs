//! The catalog of the front ends: the examples, the programs that scenarios can name, and how a
//! scenario that names them is read and started.
//!
//! All front ends link this, so that a name means the same to all. Nothing here touches a clock, and only [`disk`],
//! which front ends hand in, a file: an example brings the files that its scenario names, and a program in the StarL
//! language is brought by the loader that brings the others.

pub mod disk;
pub mod examples;
mod explore;
pub mod language;
mod parameters;
pub mod programs;
pub mod recording;
pub mod schema;
pub mod service;
pub mod session;
mod start;
pub mod trial;

pub use parameters::Parameters;
pub use start::{Application, Refusal, read};
