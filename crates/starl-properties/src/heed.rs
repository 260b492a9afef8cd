//! Which events a checker does anything at. A run has a dozen checkers and most records are of datagrams, which
//! most checkers pass over: they are not called for those.

use starl_core::Event;
use std::ops::BitOr;

/// Kinds of events.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kinds(u32);

impl Kinds {
    /// None.
    pub const NONE: Kinds = Kinds(0);
    /// All.
    pub const ALL: Kinds = Kinds(u32::MAX);
    /// [`Event::Moved`].
    pub const MOVED: Kinds = Kinds(1 << 0);
    /// [`Event::Sent`].
    pub const SENT: Kinds = Kinds(1 << 1);
    /// [`Event::Delivered`].
    pub const DELIVERED: Kinds = Kinds(1 << 2);
    /// [`Event::Dropped`].
    pub const DROPPED: Kinds = Kinds(1 << 3);
    /// [`Event::Collided`].
    pub const COLLIDED: Kinds = Kinds(1 << 4);
    /// [`Event::Primitive`].
    pub const PRIMITIVE: Kinds = Kinds(1 << 5);
    /// [`Event::Fault`].
    pub const FAULT: Kinds = Kinds(1 << 6);
    /// [`Event::Failed`].
    pub const FAILED: Kinds = Kinds(1 << 7);
    /// Any other.
    pub const OTHER: Kinds = Kinds(1 << 8);
    /// [`Event::Intervention`].
    pub const INTERVENTION: Kinds = Kinds(1 << 9);

    /// The records that most checkers use: reports of primitives, and changes of robots'
    /// conditions.
    pub const REPORTS: Kinds = Kinds(Kinds::PRIMITIVE.0 | Kinds::FAULT.0 | Kinds::FAILED.0);

    /// The kind of one event.
    pub fn of(event: &Event) -> Kinds {
        match event {
            Event::Moved(_) => Kinds::MOVED,
            Event::Sent { .. } => Kinds::SENT,
            Event::Delivered { .. } => Kinds::DELIVERED,
            Event::Dropped { .. } => Kinds::DROPPED,
            Event::Collided { .. } => Kinds::COLLIDED,
            Event::Primitive { .. } => Kinds::PRIMITIVE,
            Event::Fault(_) => Kinds::FAULT,
            Event::Failed(_) => Kinds::FAILED,
            Event::Intervention(_) => Kinds::INTERVENTION,
            _ => Kinds::OTHER,
        }
    }

    /// Whether all of the other are among these.
    pub fn hold(self, other: Kinds) -> bool {
        self.0 & other.0 == other.0
    }

    /// Whether the two have one in common.
    pub fn meets(self, other: Kinds) -> bool {
        self.0 & other.0 != 0
    }
}

impl BitOr for Kinds {
    type Output = Kinds;

    fn bitor(self, other: Kinds) -> Kinds {
        Kinds(self.0 | other.0)
    }
}
