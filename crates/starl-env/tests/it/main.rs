//! The tests of `starl-env`, in one binary so that they link once.

mod expressions;
mod independent_environments;
mod lidar_and_places;
mod messages;
mod moves_as_in_the_simulator;
mod support;
