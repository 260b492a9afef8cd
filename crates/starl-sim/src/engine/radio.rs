//! The fate of datagrams: their receivers and arrival times.
//!
//! Every draw is keyed by (sender, receiver, sequence number), so that what happens on one link does
//! not depend on any other traffic.

use super::inbox::{Calendar, Delivery, Transmission};
use super::record::Log;
use super::shared::{Shared, Window};
use super::simulated_robot::Outgoing;
use super::slots::Slots;
use super::{Stream, stream};
use crate::scenario::{DelayDistribution, Link};
use starl_core::event::DropReason;
use starl_core::geometry::Bounds;
use starl_core::{Destination, Digest, Duration, Event, Random, RobotId, Time};
use starl_host::Datagram;

/// One arrival of a datagram of a shard's outbox.
#[derive(Clone, Copy, Debug)]
pub struct Posted {
    /// Index in the outbox.
    pub outgoing: u32,
    pub to: RobotId,
    pub at: Time,
}

/// Decides the receivers and the arrival time of a datagram.
pub fn route(
    shared: &Shared,
    window: Window,
    (index, outgoing): (u32, &Outgoing),
    digest: &mut Digest,
    log: &mut Log,
    posted: &mut Vec<Posted>,
) {
    let network = &shared.network;
    let Outgoing { at, datagram } = outgoing;
    let from = datagram.message.from;
    let mut lost = |to, reason| {
        let sequence = datagram.sequence;
        let event = Event::Dropped {
            from,
            to: Some(to),
            sequence,
            reason,
        };
        // It may still be in the sender's queue, but its fate is known now.
        log.record(digest, from, (*at).min(window.to), event);
    };
    let mut offer = |to: RobotId| {
        if network.line_of_sight && occluded(shared, from, to) {
            lost(to, DropReason::Range);
            return;
        }
        if shared.parted(from, to) {
            lost(to, DropReason::Partition);
            return;
        }
        let link = network.link(from, to);
        let mut arrive = |delay: Duration| {
            posted.push(Posted {
                outgoing: index,
                to,
                at: *at + delay,
            });
        };
        if !is_random(link) {
            arrive(link.delay);
            return;
        }
        let key = [
            u64::from(from.0),
            u64::from(to.0),
            u64::from(datagram.sequence),
        ];
        let mut random = stream(shared.scenario.seed, Stream::Link, &key);
        if random.chance(link.loss) {
            lost(to, DropReason::Loss);
            return;
        }
        arrive(delay(link, &mut random));
        if random.chance(link.duplication) {
            arrive(delay(link, &mut random));
        }
    };
    match (datagram.destination, network.range) {
        (Destination::Robot(to), range) => {
            let exists = to.index() < shared.bodies.len();
            if exists && range.is_none_or(|range| apart(shared, from, to) <= range) {
                offer(to);
            } else {
                lost(to, DropReason::Range);
            }
        }
        (Destination::All, None) => {
            let others = shared.fleet.iter().filter(|&&to| to != from);
            others.copied().for_each(offer);
        }
        // Robots out of range of a message to all are not listed, because they may be nearly the
        // whole fleet.
        (Destination::All, Some(range)) => {
            let center = shared.bodies[from.index()].position;
            shared.grid.for_each_within(center, range, |entry| {
                let to = entry.robot();
                if to != from && apart(shared, from, to) <= range {
                    offer(to);
                }
            });
        }
    }
}

/// Moves what a shard has posted into the calendar; nothing arrives before `earliest`.
pub fn post(
    calendar: &mut Calendar,
    outbox: &[Outgoing],
    posted: &[Posted],
    earliest: Time,
    slots: Slots,
) {
    // The slots in which the datagram at hand arrives, and its index in each.
    let mut pages: Vec<(u64, u32)> = Vec::new();
    let mut at_hand = u32::MAX;
    for posting in posted {
        if posting.outgoing != at_hand {
            at_hand = posting.outgoing;
            pages.clear();
        }
        let at = posting.at.max(earliest);
        let slot = slots.number(at);
        let transmission = match pages.iter().find(|page| page.0 == slot) {
            Some(page) => page.1,
            None => {
                let Datagram {
                    sequence, message, ..
                } = &outbox[at_hand as usize].datagram;
                let index = calendar.add_transmission(
                    slot,
                    Transmission {
                        from: message.from,
                        sequence: *sequence,
                        port: message.port,
                        payload: message.payload.clone(),
                    },
                );
                pages.push((slot, index));
                index
            }
        };
        calendar.add_delivery(
            slot,
            Delivery {
                at,
                to: posting.to.0,
                transmission,
            },
        );
    }
}

fn apart(shared: &Shared, a: RobotId, b: RobotId) -> f64 {
    shared.bodies[a.index()]
        .position
        .distance(shared.bodies[b.index()].position)
}

/// Whether an obstacle or a third robot's body is between two robots' centres.
fn occluded(shared: &Shared, a: RobotId, b: RobotId) -> bool {
    let middle = |robot: RobotId| {
        let body = &shared.bodies[robot.index()];
        body.position.at_height(body.position.z + 0.5 * body.height)
    };
    let (start, end) = (middle(a), middle(b));
    if shared.map.blocks_segment(start, end, 0.0) {
        return true;
    }
    let center = start.lerp(end, 0.5);
    let reach = 0.5 * start.planar_distance(end) + shared.grid.greatest_radius();
    let span = Bounds::of_segment(start, end);
    let mut blocked = false;
    shared.grid.for_each_within(center, reach, |entry| {
        if blocked || entry.robot() == a || entry.robot() == b {
            return;
        }
        let body = &shared.bodies[entry.robot as usize];
        let (low, high) = (body.position.z, body.position.z + body.height);
        blocked = span.low.z < high
            && low < span.high.z
            && distance_to_segment(body.position, start, end) < body.radius;
    });
    blocked
}

/// Planar distance from a point to a segment.
fn distance_to_segment(p: starl_core::Point, a: starl_core::Point, b: starl_core::Point) -> f64 {
    let along = (b - a).at_height(0.0);
    let fraction = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    p.planar_distance(a.lerp(b, fraction))
}

/// Whether the link leaves anything to chance.
fn is_random(link: &Link) -> bool {
    link.loss > 0.0
        || link.duplication > 0.0
        || link.reordering > 0.0
        || !(link.distribution == DelayDistribution::Constant || link.jitter.is_zero())
}

fn delay(link: &Link, random: &mut Random) -> Duration {
    let (mean, jitter) = (link.delay.seconds(), link.jitter.seconds());
    let seconds = match link.distribution {
        DelayDistribution::Constant => mean,
        DelayDistribution::Uniform => {
            let half_width = jitter * 3.0f64.sqrt();
            random.between(mean - half_width, mean + half_width)
        }
        DelayDistribution::Normal => random.normal(mean, jitter),
        DelayDistribution::Exponential => mean - jitter + random.exponential(jitter),
    };
    let held_back = random.chance(link.reordering);
    let extra = if held_back {
        link.reordering_delay
    } else {
        Duration::ZERO
    };
    Duration::from_seconds_f64(seconds.max(0.0)) + extra
}
