//! The requests of JavaScript to the simulator, made natively.

mod bad_requests_are_answered;
mod digests_are_those_of_the_command;
mod editors_are_served;
mod failures_are_found_and_shrunk;
mod files_are_checked;
mod frames_are_sampled;
mod records_are_handed_over_once;
mod robots_can_be_inspected;
mod runs_can_be_steered;
mod runs_stop_at_breakpoints;
mod support;
