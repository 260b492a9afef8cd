//! The tests of `starl-race`, in one binary so that they link once.

#[allow(dead_code, reason = "the tests of the primitives use the rest")]
#[path = "../../../../crates/starl-primitives/tests/it/harness/mod.rs"]
mod harness;
mod race;
