//! Where a robot stands: whether it takes part or has left, and how far the agreement is.

use super::packet::View;
use super::ticket::Ticket;
use alloc::collections::BTreeSet;
use starl_core::{Area, RobotId, Time};

/// A registration of this robot.
#[derive(Clone, Debug)]
pub(super) struct Own {
    pub ticket: Ticket,
    pub area: Option<Area>,
    /// Until then it listens for others.
    pub gathers_until: Time,
    /// Announcements since the last change from a list to none or back.
    pub announcements: u32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Leaving {
    pub ticket: Ticket,
    pub repetitions: u32,
}

/// How far the agreement is. Invariant: a list here is the one that was promised.
#[derive(Clone, Debug)]
pub(super) enum Stage {
    /// There is no list.
    Open,
    /// It has proposed a list, and these have not accepted it.
    Proposed {
        view: View,
        missing: BTreeSet<RobotId>,
        repetitions: u32,
    },
    /// It has accepted a list and waits to hear that all have.
    Accepted { view: View, repetitions: u32 },
    /// It shows a list.
    Agreed {
        view: View,
        members: BTreeSet<RobotId>,
        /// Whether another robot has announced the same since this one last did.
        heard: bool,
    },
}
