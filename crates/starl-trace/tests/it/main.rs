//! The tests of `starl-trace`, in one binary so that they link once.

mod common;
mod comparison;
mod damage;
mod documentation;
mod inputs;
mod other_library;
mod round_trip;
mod unfinished;
