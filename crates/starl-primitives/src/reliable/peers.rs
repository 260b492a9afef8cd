//! The states of a robot's peers. Most peers are at rest, and then a few bytes are all that there is to know of each:
//! a fleet of thousands, in which each robot has tens in reach, is simulated in one process.
//!
//! Invariant: each peer is in one of the two maps; it is among the busy ones only if its resting form would not say all of
//! its state.

use super::sorted::Sorted;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt::Debug;
use starl_core::RobotId;

/// A state with a short form at rest.
pub(super) trait Rest: Default {
    /// The state at rest.
    type Resting: Copy + Debug;
    /// The short form; none if it would leave something out.
    fn at_rest(&self) -> Option<Self::Resting>;
    /// The state of which this is the short form.
    fn woken(resting: Self::Resting) -> Self;
}

/// The states by peer.
#[derive(Clone, Debug, Default)]
pub(super) struct Peers<T: Rest> {
    resting: Sorted<T::Resting>,
    busy: Sorted<Box<T>>,
}

impl<T: Rest> Peers<T> {
    pub fn len(&self) -> usize {
        self.resting.len() + self.busy.len()
    }

    /// All peers, in the order of their numbers.
    pub fn numbers(&self) -> Vec<RobotId> {
        let resting = self.resting.iter().map(|(peer, _)| peer);
        let mut numbers: Vec<RobotId> = resting.chain(self.busy().map(|(peer, _)| peer)).collect();
        numbers.sort_unstable();
        numbers
    }

    /// The result of `read` for the state of a peer; none if it has no state.
    pub fn read<R>(&self, peer: RobotId, read: impl FnOnce(&T) -> R) -> Option<R> {
        match self.resting.get(peer) {
            Some(resting) => Some(read(&T::woken(*resting))),
            None => self.busy.get(peer).map(|state| read(state)),
        }
    }

    /// Takes a peer's state out. The caller puts it back with [`Peers::put`].
    pub fn take(&mut self, peer: RobotId) -> Option<T> {
        if let Some(resting) = self.resting.remove(peer) {
            return Some(T::woken(resting));
        }
        let state = self.busy.remove(peer)?;
        self.busy.trim();
        Some(*state)
    }

    /// Sets the state of a peer that has none here.
    pub fn put(&mut self, peer: RobotId, state: T) {
        match state.at_rest() {
            Some(resting) => self.resting.insert(peer, resting),
            None => self.busy.insert(peer, Box::new(state)),
        }
    }

    /// The peers that are not at rest, in the order of their numbers.
    pub fn busy(&self) -> impl Iterator<Item = (RobotId, &T)> {
        self.busy.iter().map(|(peer, state)| (peer, &**state))
    }

    /// The state of a peer that is not at rest. The change must not put it at rest.
    pub fn busy_mut(&mut self, peer: RobotId) -> Option<&mut T> {
        self.busy.get_mut(peer).map(|state| &mut **state)
    }

    /// Changes all peers that are not at rest.
    pub fn change_busy(&mut self, change: impl Fn(&mut T)) {
        for (peer, mut state) in self.busy.drain() {
            change(&mut state);
            match state.at_rest() {
                Some(resting) => self.resting.insert(peer, resting),
                None => self.busy.insert(peer, state),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::inbox::{Arrived, Inbox, Owed};
    use super::super::outgoing::Receiver;
    use super::*;
    use alloc::collections::BTreeMap;
    use starl_core::{Payload, Random};

    #[test]
    fn peers_agree_with_a_plain_map() {
        let mut random = Random::keyed(1, &[]);
        let mut peers: Peers<Receiver> = Peers::default();
        let mut plain: BTreeMap<RobotId, (u32, bool)> = BTreeMap::new();
        for _ in 0..2000 {
            let peer = RobotId(random.below(20));
            let state = peers.take(peer);
            let found = state.map(|state| (state.taken.next(), state.token.is_some()));
            assert_eq!(found, plain.remove(&peer));
            let (next, is_busy) = (random.below(1000), random.chance(0.5));
            let mut state = Receiver::woken(next);
            state.token = is_busy.then_some(7);
            peers.put(peer, state);
            plain.insert(peer, (next, is_busy));
            if random.chance(0.05) {
                peers.change_busy(|state| state.token = None);
                plain.values_mut().for_each(|state| state.1 = false);
            }
            let numbers: Vec<RobotId> = plain.keys().copied().collect();
            assert_eq!(peers.numbers(), numbers);
            assert_eq!(peers.len(), numbers.len());
            let busy = plain.values().filter(|state| state.1).count();
            assert_eq!(peers.busy().count(), busy);
            assert_eq!(peers.read(peer, |state| state.taken.next()), Some(next));
        }
    }

    #[test]
    fn a_sender_at_rest_keeps_its_life_and_its_numbers() {
        let sender = RobotId(3);
        let mut peers: Peers<Inbox> = Peers::default();
        peers.put(sender, Inbox::woken((7, 5)));
        assert_eq!(peers.busy().count(), 0);
        let mut inbox = peers.take(sender).expect("it is known");
        assert!(inbox.lives.of(6).is_none(), "an earlier life is not heard");
        let mut arrived = Arrived::new();
        let sequence = inbox.lives.of(7).expect("the present life is heard");
        sequence.take(4, Payload::new(), 8, &mut arrived);
        assert!(arrived.is_empty(), "it was taken before");
        sequence.take(6, Payload::new(), 8, &mut arrived);
        assert_eq!(arrived.len(), 1);
        assert_eq!(inbox.at_rest(), None, "5 is missing");
        inbox.owed = Owed::Taken;
        peers.put(sender, inbox);
        assert_eq!(peers.busy().count(), 1);
    }

    #[test]
    fn peers_at_rest_take_a_few_bytes() {
        let receiver = size_of::<(RobotId, <Receiver as Rest>::Resting)>();
        let inbox = size_of::<(RobotId, <Inbox as Rest>::Resting)>();
        assert_eq!((receiver, inbox), (8, 12));
    }
}
