//! A map by robot that takes little room for few robots, and in which one of many is put and taken quickly.
//!
//! Invariant: a vector is sorted by number, and holds at most [`FEW`] entries.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::RobotId;

/// Up to so many entries stand in a vector, where putting one moves the others.
const FEW: usize = 256;

#[derive(Clone, Debug)]
pub(super) enum Sorted<V> {
    Few(Vec<(RobotId, V)>),
    Many(BTreeMap<RobotId, V>),
}

impl<V> Default for Sorted<V> {
    fn default() -> Sorted<V> {
        Sorted::Few(Vec::new())
    }
}

impl<V> Sorted<V> {
    pub fn len(&self) -> usize {
        match self {
            Sorted::Few(list) => list.len(),
            Sorted::Many(map) => map.len(),
        }
    }

    pub fn get(&self, robot: RobotId) -> Option<&V> {
        match self {
            Sorted::Few(list) => Some(&list[place(list, robot).ok()?].1),
            Sorted::Many(map) => map.get(&robot),
        }
    }

    pub fn get_mut(&mut self, robot: RobotId) -> Option<&mut V> {
        match self {
            Sorted::Few(list) => {
                let at = place(list, robot).ok()?;
                Some(&mut list[at].1)
            }
            Sorted::Many(map) => map.get_mut(&robot),
        }
    }

    pub fn remove(&mut self, robot: RobotId) -> Option<V> {
        match self {
            Sorted::Few(list) => {
                let at = place(list, robot).ok()?;
                Some(list.remove(at).1)
            }
            Sorted::Many(map) => {
                let value = map.remove(&robot);
                // Not at once, so that a number that goes up and down does not move all entries each time.
                if map.len() <= FEW / 2 {
                    *self = Sorted::Few(core::mem::take(map).into_iter().collect());
                }
                value
            }
        }
    }

    /// Adds an entry for a robot that has none.
    pub fn insert(&mut self, robot: RobotId, value: V) {
        match self {
            Sorted::Few(list) if list.len() == FEW => {
                let mut map: BTreeMap<RobotId, V> = core::mem::take(list).into_iter().collect();
                map.insert(robot, value);
                *self = Sorted::Many(map);
            }
            Sorted::Few(list) => {
                let (Ok(at) | Err(at)) = place(list, robot);
                if list.len() == list.capacity() {
                    // Doubling would leave a quarter of the room empty.
                    list.reserve_exact(list.len() / 4 + 1);
                }
                list.insert(at, (robot, value));
            }
            Sorted::Many(map) => _ = map.insert(robot, value),
        }
    }

    /// Gives room back that was needed for once.
    pub fn trim(&mut self) {
        if let Sorted::Few(list) = self {
            trim(list);
        }
    }

    /// All entries, in the order of the robots' numbers.
    pub fn iter(&self) -> impl Iterator<Item = (RobotId, &V)> {
        let (list, map) = match self {
            Sorted::Few(list) => (Some(list), None),
            Sorted::Many(map) => (None, Some(map)),
        };
        let list = list.into_iter().flatten();
        let map = map.into_iter().flatten();
        list.map(|(robot, value)| (*robot, value))
            .chain(map.map(|(robot, value)| (*robot, value)))
    }

    /// Takes all entries out, in the order of the robots' numbers.
    pub fn drain(&mut self) -> Vec<(RobotId, V)> {
        match core::mem::take(self) {
            Sorted::Few(list) => list,
            Sorted::Many(map) => map.into_iter().collect(),
        }
    }
}

fn place<V>(list: &[(RobotId, V)], robot: RobotId) -> Result<usize, usize> {
    list.binary_search_by_key(&robot, |(number, _)| *number)
}

/// Gives room back that was needed for once.
pub(super) fn trim<V>(list: &mut Vec<V>) {
    if list.capacity() > 4 + 4 * list.len() {
        list.shrink_to(2 * list.len());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::Random;

    #[test]
    fn entries_agree_with_a_plain_map_while_their_number_goes_up_and_down() {
        let mut random = Random::keyed(1, &[]);
        let mut sorted = Sorted::default();
        let mut plain = BTreeMap::new();
        let (mut most, mut was_many) = (0, 0);
        for step in 0..20_000u32 {
            let robot = RobotId(random.below(1000));
            // Grows for 5,000 steps, and shrinks for as many.
            let grows = step / 5000 % 2 == 0;
            if random.chance(if grows { 0.9 } else { 0.05 }) {
                if let Some(value) = sorted.get_mut(robot) {
                    *value = step;
                } else {
                    sorted.insert(robot, step);
                }
                plain.insert(robot, step);
            } else {
                assert_eq!(sorted.remove(robot), plain.remove(&robot));
            }
            most = most.max(sorted.len());
            was_many += u32::from(matches!(sorted, Sorted::Many(_)));
            let other = RobotId(random.below(1000));
            assert_eq!(sorted.get(other), plain.get(&other));
            assert_eq!(sorted.len(), plain.len());
            if step % 100 == 0 {
                let all: Vec<(RobotId, &u32)> = sorted.iter().collect();
                assert!(
                    all.into_iter()
                        .eq(plain.iter().map(|(robot, value)| (*robot, value)))
                );
            }
        }
        assert!(most > 2 * FEW, "{most}");
        assert!((1000..19_000).contains(&was_many), "{was_many} steps");
        let all: Vec<(RobotId, u32)> = plain.into_iter().collect();
        assert_eq!(sorted.drain(), all);
        assert_eq!(sorted.len(), 0);
    }
}
