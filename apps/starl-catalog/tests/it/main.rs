//! The tests of `starl-catalog`, in one binary so that they link once.

mod a_robot_alone;
mod corruption_is_recovered_from;
mod election_finds_leaders;
mod flocking_lines_up;
mod formation_forms_polygons;
mod goals_are_conditions;
mod intersection_breakdowns;
mod intersection_is_safe_and_live;
mod intersection_stream;
mod intersection_support;
mod intersection_throughput;
mod journals_replay;
mod line_is_even;
mod mutex_gives_turns;
mod policies_are_evaluated;
mod program_parameters;
mod programs_from_the_reference;
mod programs_steer;
mod race_in_both_languages;
mod race_thousand_seeds;
mod search_shares_rooms;
mod shared_variables_are_consistent;
mod shrinking_keeps_the_cause;
mod support;
mod traces_of_sessions;
