//! The events of primitives by which robots agree: Registration, LeaderElection, Mutex, Barrier, and the failure
//! detector.

use crate::geometry::Area;
use crate::{Duration, RobotId, Time};
use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;

group! {
    /// Names a list of a Registration.
    #[derive(Copy, PartialOrd, Ord)]
    ListId {
        /// When it was computed, by its coordinator's clock.
        time: Time,
        /// The robot that computed it.
        coordinator: RobotId,
        /// The coordinator's incarnation.
        incarnation: u32,
    }
}

events! {
    /// Commands to a Registration, and their results.
    RegistrationEvent {
        /// The robot takes part from now on.
        Register = "register" {
            /// How far the times of lists are apart at least.
            apart: Duration,
            /// With those in this area; with the whole fleet where there is none.
            area: Option<Box<Area>>,
        },
        /// It takes part no longer.
        Unregister = "unregister",
        /// It proposes a list.
        Propose = "propose" {
            /// Which.
            list: ListId,
            /// The robots in it.
            members: Vec<RobotId>,
        },
        /// It accepts a list that another robot proposes.
        Accept = "accept" {
            /// Which.
            list: ListId,
        },
        /// It shows a list from now on.
        Agree = "agree" {
            /// Which.
            list: ListId,
            /// The robots in it.
            members: Vec<RobotId>,
        },
        /// It shows no list from now on.
        Lose = "lose",
        /// It has had no list for long.
        Fail = "fail",
    }
}

words! {
    /// How a leader is found.
    #[derive(Default)]
    Algorithm {
        /// Votes of a majority, leases and epochs.
        #[default]
        Leases = "leases",
        /// The greatest of the random ballots wins (thesis, section 3.4.2).
        Ballots = "ballots",
        /// The greatest robot that is up wins (Garcia-Molina 1982).
        Bully = "bully",
    }
}

events! {
    /// Commands to a LeaderElection, and their results.
    ElectionEvent {
        /// The election begins on this robot.
        Start = "start" {
            /// How it goes.
            algorithm: Algorithm,
            /// The participants.
            participants: Vec<RobotId>,
        },
        /// The robot is a candidate.
        Elect = "elect",
        /// It stands no longer.
        Resign = "resign",
        /// It votes from now on.
        Vote = "vote" {
            /// Whether no robot could tell it the earlier promises.
            anew: bool,
        },
        /// It shows a leader from now on.
        Leader = "leader" {
            /// The robot.
            leader: RobotId,
            /// In which epoch, if the algorithm has epochs.
            epoch: Option<u64>,
            /// In which round of ballots, if the algorithm has ballots.
            round: Option<u64>,
            /// The leader's ballot in that round.
            ballot: Option<u32>,
        },
        /// It shows no leader from now on.
        Lost = "lost",
        /// It has had no leader for long.
        Fail = "fail",
    }
}

events! {
    /// Commands to a Mutex, and their results; one event for each resource.
    MutexEvent {
        /// The robot asks for a resource.
        Acquire = "acquire" {
            /// Which.
            resource: Arc<str>,
        },
        /// It asks no longer.
        Withdraw = "withdraw" {
            /// For which.
            resource: Arc<str>,
        },
        /// It holds a resource from now on.
        Enter = "enter" {
            /// Which.
            resource: Arc<str>,
            /// With leases: greater each time that the resource is granted.
            fencing: Option<u64>,
            /// With leases: as long as clocks are wrong by at most this share, no other robot holds it.
            drift: Option<f64>,
        },
        /// It gives a resource back.
        Release = "release" {
            /// Which.
            resource: Arc<str>,
        },
        /// It holds a resource no longer: its lease has ended, or it never had it.
        Expire = "expire" {
            /// Which.
            resource: Arc<str>,
        },
        /// With quorums and leases: it knows its earlier grants to others, and grants from now on.
        Ready = "ready" {
            /// How many robots take part.
            participants: u32,
            /// How many of them have to be ready for a request to be granted.
            needed: u32,
            /// With leases: the last number is unknown, because a majority has forgotten it or there was none.
            anew: bool,
        },
    }
}

events! {
    /// Commands to a Barrier, and their results.
    BarrierEvent {
        /// The robot has arrived.
        Arrive = "arrive" {
            /// All that have to.
            participants: Vec<RobotId>,
        },
        /// It knows the generation at which it has arrived.
        Wait = "wait" {
            /// Which.
            generation: u64,
        },
        /// All robots have arrived, and it continues.
        Pass = "pass" {
            /// To which generation.
            generation: u64,
            /// All that had to.
            participants: Vec<RobotId>,
        },
    }
}

words! {
    /// Why a robot is suspected.
    Suspicion {
        /// It was not heard for too long.
        Silence = "silence",
        /// It has restarted without its earlier state.
        Restart = "restart",
    }
}

events! {
    /// Findings of a failure detector.
    FailureDetectorEvent {
        /// A robot is believed to have failed.
        Suspect = "suspect" {
            /// Which.
            peer: RobotId,
            /// Why.
            reason: Suspicion,
        },
        /// A robot is trusted again.
        Trust = "trust" {
            /// Which.
            peer: RobotId,
        },
    }
}
