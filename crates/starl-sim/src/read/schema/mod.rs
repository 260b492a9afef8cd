//! Every field of a scenario: name, kind, default and meaning, in one table.
//!
//! The reader takes defaults, ranges and units from here and rejects other fields; `docs/reference/scenario.md` is
//! compared with it by a test. So a field cannot be read without being documented, nor documented without being read.
//! The tables that are plain data declare their fields with their structures, in [`crate::scenario`].

mod event;
mod faults;
mod network;
mod robots;
mod settings;
mod world;

pub use crate::fields::schema::*;
pub(super) use network::KNOB_NAMES;
pub use settings::SCENARIO;

use crate::fields::FieldTable;

/// A box in the floor plane, given by two corners.
const CORNERS: &[Field] = fields! {
    /// Corner with the lowest x and y.
    low = Kind::PlanarPoint, Required;
    /// Corner with the highest x and y.
    high = Kind::PlanarPoint, Required;
};
