//! The tests of `starl-sweep`, in one binary so that they link once.

mod campaign;
mod tasks;
