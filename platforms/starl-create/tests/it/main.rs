//! The tests of `starl-create`, in one binary so that they link once.

mod motion;
mod wire;
