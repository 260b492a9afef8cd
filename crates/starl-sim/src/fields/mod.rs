//! The fields of a scenario file: what they may hold, and how they are read and written.
//!
//! A table of plain data is declared in one place, by the macro [`field_table`]: its structure, defaults, documentation,
//! reader and writer follow from that.

mod leaves;
pub(crate) mod path;
mod plain;
mod problem;
pub(crate) mod report;
pub mod schema;
pub(crate) mod section;
pub mod suggest;
pub(crate) mod tree;
mod unit;
pub(crate) mod value;
pub(crate) mod written;

pub(crate) use plain::{FieldTable, FieldValue, field_table, read_written, write_over};
pub use problem::{OneLine, Place, Problem, Problems};
pub use unit::Quantity;
