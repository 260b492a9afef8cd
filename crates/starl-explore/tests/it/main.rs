//! The tests of `starl-explore`, in one binary so that they link once.

mod any_copies;
mod arbitrated_mutexes_are_safe;
mod broadcasts_keep_their_order;
mod conforms;
mod covered_states_lead_nowhere_new;
mod elections_are_safe;
mod permission_mutex_is_safe;
mod registrations_agree;
mod steps_in_files;
mod support;
mod threads_change_nothing;
mod three_robots_with_a_crash;
mod ties_that_nobody_breaks_are_caught;
mod what_can_go_wrong_is_told_apart;
mod with_storage;
