//! The messages between robots about leaders.

use super::epoch::Epoch;
use serde::{Deserialize, Serialize};
use starl_core::{Duration, RobotId};

/// A message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Packet {
    /// Ballots: the sender's in this round.
    Ballot {
        /// Counts elections.
        round: u64,
        /// Its ballot.
        ballot: u32,
    },
    /// Ballots: the winner.
    Outcome(Outcome),
    /// Bully: the sender asks greater robots whether they are there.
    Election,
    /// Bully: the sender is, and sees to it that there is a leader.
    Answer,
    /// Bully: the sender leads.
    Lead,
    /// Ballots and Bully: the sender does not lead, or no longer.
    Resign,
    /// Leases: the sender asks for a vote.
    Claim(Claim),
    /// Leases: the sender votes for the receiver, for the time of a lease.
    Grant {
        /// In this epoch.
        epoch: Epoch,
        /// The number of the claim.
        number: u32,
    },
    /// Leases: it does not, since it has promised this epoch to another robot.
    Refuse {
        /// The epoch asked for.
        epoch: Epoch,
        /// The latest that it has promised.
        promised: Epoch,
    },
    /// Leases: the sender will not lead in this epoch, or no longer.
    Void(Epoch),
    /// Leases: the sender leads in this epoch, for so long.
    Lease {
        /// The epoch.
        epoch: Epoch,
        /// By its clock.
        remaining: Duration,
    },
    /// Leases: the sender has restarted, and asks for earlier promises.
    Ask {
        /// Counts its attempts.
        attempt: u32,
        /// How long it has been up, by its clock.
        up_for: Duration,
    },
    /// Leases: the answer.
    Tell(Memory),
}

/// Ballots: the winner and its round. Of two outcomes the greater is accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) struct Outcome {
    /// The election.
    pub round: u64,
    /// The winner's ballot.
    pub ballot: u32,
    /// The winner.
    pub leader: RobotId,
}

/// Leases: a request for a vote, for the first time or again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Claim {
    pub epoch: Epoch,
    /// Counts the claims of the sender.
    pub number: u32,
    /// For how long the sender leads already, by its clock.
    pub remaining: Duration,
}

/// Leases: what a robot remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Memory {
    /// The attempt that it answers.
    pub attempt: u32,
    /// The latest epoch that it has promised or heard of.
    pub promised: Epoch,
    /// Whether it remembers all its promises from before the receiver's start.
    pub remembers: bool,
    /// For how long it has been up, by its clock.
    pub up_for: Duration,
    /// The time since it started again with a majority, if it has.
    pub anew_for: Option<Duration>,
}
