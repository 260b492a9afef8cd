//! The stored results of events: a digest per robot, counts, and the records themselves if
//! requested.

use serde::Serialize;
use starl_core::event::{DropReason, TransferEvent};
use starl_core::{Digest, Event, Record, RobotId, Time};

/// Counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Datagrams handed to the network.
    pub sent: u64,
    /// Arrivals.
    pub delivered: u64,
    /// Datagrams lost at random.
    pub lost: u64,
    /// Datagrams dropped for any other reason.
    pub drops: Drops,
    /// Retransmissions of Broadcast, Geocast and Unicast, for each receiver without acknowledgement.
    /// Retransmissions of other primitives do not appear in events, and are not counted here.
    pub retransmitted: u64,
    /// The number of contacts between two bodies, or a body and an obstacle.
    pub collisions: u64,
}

/// Counts of datagrams that were not lost but dropped, by the reasons of [`DropReason`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Drops {
    /// Out of radio range or sight.
    pub range: u64,
    /// A partition.
    pub partition: u64,
    /// The receiver was down.
    pub down: u64,
    /// The sender's queue was full.
    pub bandwidth: u64,
    /// Larger than the network carries.
    pub size: u64,
}

impl Drops {
    /// All of them.
    pub fn total(&self) -> u64 {
        self.range + self.partition + self.down + self.bandwidth + self.size
    }

    fn count(&mut self, reason: DropReason) {
        *match reason {
            DropReason::Loss => return,
            DropReason::Range => &mut self.range,
            DropReason::Partition => &mut self.partition,
            DropReason::Down => &mut self.down,
            DropReason::Bandwidth => &mut self.bandwidth,
            DropReason::Size => &mut self.size,
        } += 1;
    }

    fn add(&mut self, other: &Drops) {
        self.range += other.range;
        self.partition += other.partition;
        self.down += other.down;
        self.bandwidth += other.bandwidth;
        self.size += other.size;
    }
}

impl Tally {
    /// Adds another count.
    pub fn add(&mut self, other: &Tally) {
        self.sent += other.sent;
        self.delivered += other.delivered;
        self.lost += other.lost;
        self.drops.add(&other.drops);
        self.retransmitted += other.retransmitted;
        self.collisions += other.collisions;
    }

    fn count(&mut self, event: &Event) {
        match event {
            Event::Sent { .. } => self.sent += 1,
            Event::Delivered { .. } => self.delivered += 1,
            Event::Dropped {
                reason: DropReason::Loss,
                ..
            } => self.lost += 1,
            Event::Dropped { reason, .. } => self.drops.count(*reason),
            Event::Primitive { event, .. } => {
                let is_again = matches!(event.transfer(), Some(TransferEvent::Retransmit { .. }));
                self.retransmitted += u64::from(is_again);
            }
            _ => {}
        }
    }
}

/// Where the robots of one shard leave their events.
#[derive(Clone, Debug, Default)]
pub struct Log {
    /// Whether records are kept, not only counted and hashed.
    pub recording: bool,
    pub records: Vec<Record>,
    pub tally: Tally,
}

impl Log {
    /// Records an event of a robot whose digest is given.
    #[inline(always)]
    pub fn record(&mut self, digest: &mut Digest, robot: RobotId, at: Time, event: Event) {
        digest.event(at, &event);
        self.tally.count(&event);
        if self.recording {
            self.records.push(Record {
                at,
                robot: Some(robot),
                event,
            });
        }
    }
}
