//! The tests of `starl-properties`, in one binary so that they link once.

mod barrier;
mod broadcast_delivery;
mod broadcast_order;
mod documented;
mod election_bounds;
mod election_leaders;
mod excuses;
mod failure_detector;
mod geocast_exclusion;
mod geocast_inclusion;
mod mutex_of_the_living;
mod mutex_progress;
mod mutex_safety;
mod no_collision;
mod reach_avoid_goal;
mod reach_avoid_progress;
mod reach_avoid_safety;
mod register_linearizability;
mod registration;
mod shared_memory_causality;
mod shared_memory_convergence;
mod shared_memory_integrity;
mod shared_memory_order;
mod support;
mod unicast;
