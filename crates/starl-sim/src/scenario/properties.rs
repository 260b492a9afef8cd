//! The checked properties, in the table `properties`.

use super::Properties;
use crate::fields::field_table;
use crate::fields::schema::{Kind, SPAN};
use starl_core::Duration;

field_table! {
    impl Properties {
        /// Bodies never touch.
        no_collision: bool = Kind::Flag, Value("true");
        /// Safety, goal and progress of ReachAvoid.
        reach_avoid: bool = Kind::Flag, Value("true");
        /// Within this time of its start a ReachAvoid is no longer active.
        progress_bound: Duration = SPAN, Value("180s");
        /// Broadcasts reach every robot that is up.
        broadcast: bool = Kind::Flag, Value("true");
        /// Within this time, the thesis's d1.
        broadcast_bound: Duration = SPAN, Value("35s");
        /// Exclusion and inclusion of Geocast.
        geocast: bool = Kind::Flag, Value("true");
        /// Within this time, the thesis's d2.
        geocast_bound: Duration = SPAN, Value("35s");
        /// Messages to one robot reach it, once.
        unicast: bool = Kind::Flag, Value("true");
        /// Within this time.
        unicast_bound: Duration = SPAN, Value("35s");
        /// Integrity, order, convergence and causality of shared memory.
        shared_memory: bool = Kind::Flag, Value("true");
        /// Within this time memories converge.
        shared_memory_bound: Duration = SPAN, Value("35s");
        /// The guarantees of leader elections.
        election: bool = Kind::Flag, Value("true");
        /// Within this time robots agree on a leader.
        election_bound: Duration = SPAN, Value("35s");
        /// Safety, non-interference and progress of Mutex, and that its numbers grow.
        mutex: bool = Kind::Flag, Value("true");
        /// Within this time one of several robots that ask for a free resource is granted it.
        mutex_bound: Duration = SPAN, Value("35s");
        /// Within this time a robot that alone asks for a free resource is granted it. Longer than a lease.
        mutex_alone_bound: Duration = SPAN, Value("20s");
        /// Linearizability of registers.
        register: bool = Kind::Flag, Value("true");
        /// The guarantees of registrations.
        registration: bool = Kind::Flag, Value("true");
        /// Within this time, the thesis's d2, robots agree on the participants.
        registration_bound: Duration = SPAN, Value("35s");
        /// The guarantees of barriers.
        barrier: bool = Kind::Flag, Value("true");
        /// Within this time of the arrival of the last robots pass a barrier.
        barrier_bound: Duration = SPAN, Value("35s");
        /// The guarantees of failure detectors.
        failure_detector: bool = Kind::Flag, Value("true");
        /// Within this time a robot that has crashed is suspected, and one that is heard is trusted.
        failure_detector_bound: Duration = SPAN, Value("35s");
        /// The properties that programs in the StarL language declare: `invariant`, `always` and `eventually`.
        program: bool = Kind::Flag, Value("true");
    }
}
