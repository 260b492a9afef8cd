//! The tests of `starl-node`, in one binary so that they link once.

mod beacons;
mod conforms;
mod hidden_obstacles;
mod last_events;
mod orders;
mod poses_on_record;
mod support;
