//! The messages between robots about participants.

use super::ticket::Ticket;
use alloc::collections::BTreeMap;
use serde::{Deserialize, Serialize};
use starl_core::event::agreement::ListId;
use starl_core::{Area, Point, RobotId, Time};

/// Identifies a list among all lists: later lists are greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct ViewId {
    /// When it was computed, by the clock of the robot that did; later than every list that one of its
    /// members knew of.
    pub time: Time,
    /// The robot that computed it.
    pub coordinator: RobotId,
    /// The coordinator's incarnation.
    pub incarnation: u32,
}

impl From<ViewId> for ListId {
    fn from(id: ViewId) -> ListId {
        ListId {
            time: id.time,
            coordinator: id.coordinator,
            incarnation: id.incarnation,
        }
    }
}

/// Before all others.
pub(super) const NO_VIEW: ViewId = ViewId {
    time: Time::ZERO,
    coordinator: RobotId(0),
    incarnation: 0,
};

/// Robots with their tickets.
pub(super) type Roll = BTreeMap<RobotId, Ticket>;

/// A list of participants (the view of group membership protocols).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct View {
    pub id: ViewId,
    pub roll: Roll,
}

/// A message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Packet {
    /// To all: the sender takes part.
    Announce(Announcement),
    /// The sender asks all of this list to agree on it.
    Propose(View),
    /// To the coordinator: the sender agrees and shows no earlier list.
    Accept {
        id: ViewId,
        /// Others that it knows to take part.
        also: Roll,
    },
    /// The sender shows a later list, or has agreed on one.
    Refuse {
        id: ViewId,
        promised: ViewId,
        /// Others that it knows to take part.
        also: Roll,
    },
    /// All have agreed.
    Commit(ViewId),
    /// The sender's registration with this ticket is over.
    Leave { ticket: Ticket },
    /// The receiver's registration with this ticket counts as over.
    Over { ticket: Ticket },
}

/// A participant's announcement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Announcement {
    pub ticket: Ticket,
    /// Its neighbourhood; none for the whole fleet.
    pub area: Option<Area>,
    /// Where it is, metres.
    pub here: Point,
    /// It shows no list that is earlier than this.
    pub promised: ViewId,
    /// The list that it shows.
    pub view: Option<View>,
    /// How often it has announced itself since it last showed a list.
    pub count: u32,
    /// The robot whose list it waits for.
    pub waits_for: Option<(RobotId, Ticket)>,
}
