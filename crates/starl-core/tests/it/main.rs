//! The tests of `starl-core`, in one binary so that they link once.

mod geometry_cases;
mod geometry_index;
mod geometry_obstacle;
mod geometry_path;
mod geometry_polygon;
mod random_streams;
mod timers;
mod typed_events;
