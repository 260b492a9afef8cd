//! Leases: a grant ends by itself, so that a holder may crash (Gray and Cheriton 1989); and fencing numbers, so that
//! actions of a holder that does not know the end of its lease can be distinguished from those of the next holder.
//!
//! An arbiter's lease begins, by the arbiter's clock, when it hears a request; the robot counts it, by its
//! own clock, from when it sent the request, and shorter by what two clocks can differ in running. So the
//! robot's belief ends before the arbiter's lease, however long messages take.
//!
//! A grant's number is greater than all numbers that its arbiter has given or heard of for one of the resources. A
//! robot enters when a majority has granted it the same number (it asks those with lower ones to raise theirs). Two
//! majorities share an arbiter, so of two robots the one that it granted the resource later has the greater number, and
//! this does not depend on clocks. A storage or a motor that refuses lower numbers than it has seen (the sequencers of
//! Burrows 2006; fencing tokens, Kleppmann 2016) is safe even where clocks break their bound and a robot acts on a
//! lease that has ended. The last [`BITS`] of a number are the robot's own, so that no two robots can ever have the
//! same.

use super::{Options, Resources};
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use serde::{Deserialize, Serialize};
use starl_core::{Duration, Random, RobotId, Time};

/// How many bits of a number are its robot's.
const BITS: u32 = 20;
/// No number is greater: programs have signed ones.
const GREATEST: u64 = (1 << 62) - 1;
/// When numbers of more resources than this are known, the greatest stands for all.
const MOST_RESOURCES: usize = 4096;

/// How long a robot believes that it holds what arbiters have granted for a lease, if no two clocks differ by
/// more in running than two that run wrong by `drift`.
pub(super) fn belief(options: &Options) -> Duration {
    let drift = options.drift.clamp(0.0, 0.9);
    let share = (1.0 - drift) / (1.0 + drift);
    Duration((options.lease.0 as f64 * share) as u64)
}

/// The greatest numbers known, by resource.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Numbers {
    known: BTreeMap<Box<str>, u64>,
    /// At least this for every resource.
    floor: u64,
}

impl Numbers {
    /// The greatest number known for one of these.
    pub fn of(&self, resources: &Resources) -> u64 {
        let known = resources
            .iter()
            .filter_map(|resource| self.known.get(resource));
        known.copied().max().unwrap_or(0).max(self.floor)
    }

    /// The greatest of all.
    pub fn greatest(&self) -> u64 {
        self.known
            .values()
            .copied()
            .max()
            .unwrap_or(0)
            .max(self.floor)
    }

    /// From now on all numbers are greater.
    pub fn raise_floor(&mut self, number: u64) {
        self.floor = self.floor.max(number.min(GREATEST));
    }

    /// A number of a robot for these: the one that it asks for, if that is greater than all before.
    pub fn next(&mut self, robot: RobotId, resources: &Resources, wanted: u64) -> u64 {
        let (before, own) = (self.of(resources), own_bits(robot));
        let is_possible =
            wanted > before && wanted <= GREATEST && wanted & own_bits(RobotId(u32::MAX)) == own;
        let counted = ((before >> BITS) + 1) << BITS | own;
        let number = match is_possible {
            true => wanted,
            false if counted <= GREATEST => counted,
            // Only a corruption leads here: they start again.
            false => {
                *self = Numbers::default();
                1 << BITS | own
            }
        };
        self.learn(resources, number);
        number
    }

    /// Records a number.
    pub fn learn(&mut self, resources: &Resources, number: u64) {
        if number > GREATEST {
            return;
        }
        for resource in resources {
            let known = self.known.entry(resource.clone()).or_default();
            *known = number.max(*known);
        }
        if self.known.len() > MOST_RESOURCES {
            self.floor = self.greatest();
            self.known.clear();
        }
    }

    /// Adds the resources that a number is known of.
    pub fn add_resources(&self, known: &mut Resources) {
        known.extend(self.known.keys().cloned());
    }

    /// Overwrites the state at random.
    pub fn corrupt(&mut self, random: &mut Random) {
        self.known.retain(|_, _| random.chance(0.5));
        if random.chance(0.5) {
            self.floor = u64::from(random.bits()) << BITS;
        }
    }
}

/// A number greater than all numbers given before `now`, if each took a millisecond.
pub(super) fn number_at(now: Time) -> u64 {
    (now.0 / 1_000_000).saturating_mul(1 << BITS)
}

/// The bits of a number that are its robot's.
fn own_bits(robot: RobotId) -> u64 {
    u64::from(robot.0) & ((1 << BITS) - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_grow_for_each_resource_and_belong_to_one_robot() {
        let mut numbers = Numbers::default();
        let a = Resources::from(["a".into()]);
        let both = Resources::from(["a".into(), "b".into()]);
        let first = numbers.next(RobotId(3), &a, 0);
        let second = numbers.next(RobotId(1), &both, 0);
        assert!(first < second);
        assert_eq!(
            numbers.next(RobotId(1), &a, second + (5 << BITS)),
            second + (5 << BITS)
        );
        // Another robot's number, a lower one and an impossible one are not given.
        for wanted in [second + (9 << BITS) + 1, first, u64::MAX - 2] {
            let before = numbers.of(&a);
            let number = numbers.next(RobotId(1), &a, wanted);
            assert!(number > before && number != wanted && number & 1 == 1);
        }
    }

    #[test]
    fn many_resources_take_bounded_room() {
        let mut numbers = Numbers::default();
        let mut last = 0;
        for index in 0..3 * MOST_RESOURCES {
            let one = Resources::from([alloc::format!("r{index}").into()]);
            last = last.max(numbers.next(RobotId(0), &one, 0));
            assert!(numbers.known.len() <= MOST_RESOURCES);
        }
        assert!(numbers.greatest() >= last);
    }
}
