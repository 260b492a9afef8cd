//! Why packets are refused, and how many were.

/// Why a packet was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// It is not a packet of this protocol.
    Malformed,
    /// It belongs to a session that this process does not know, perhaps one of an earlier life.
    UnknownSession,
    /// Its sender does not know the fleet's key, or it was changed on the way.
    NotAuthentic,
    /// It was taken before, or is too old to tell.
    Replayed,
}

/// How many packets were refused, by reason.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Refusals {
    /// No packets of this protocol.
    pub malformed: u64,
    /// Of unknown sessions.
    pub unknown_session: u64,
    /// Not authentic.
    pub not_authentic: u64,
    /// Replayed.
    pub replayed: u64,
}

impl Refusals {
    pub(super) fn count(&mut self, refusal: Refusal) {
        *match refusal {
            Refusal::Malformed => &mut self.malformed,
            Refusal::UnknownSession => &mut self.unknown_session,
            Refusal::NotAuthentic => &mut self.not_authentic,
            Refusal::Replayed => &mut self.replayed,
        } += 1;
    }

    /// All of them.
    pub fn total(&self) -> u64 {
        self.malformed + self.unknown_session + self.not_authentic + self.replayed
    }
}
