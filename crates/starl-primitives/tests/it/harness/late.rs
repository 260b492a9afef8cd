//! Copies of datagrams that arrive long after they were sent, at whichever life of their receiver is up then.

use super::World;
use starl_core::{Destination, Duration, Event, Input, Message, Random, RobotId, Time};
use std::collections::BTreeMap;

/// Makes late copies of a world's datagrams. A copy of a datagram that the wire lost is a delayed datagram.
pub struct LateCopies {
    share: f64,
    longest: Duration,
    random: Random,
    /// The records up to here have been looked at.
    seen: usize,
    waiting: BTreeMap<(Time, u64), (RobotId, Message)>,
    count: u64,
}

impl LateCopies {
    /// This share of the datagrams that each robot is sent arrives again, within `longest`.
    pub fn new(share: f64, longest: Duration, seed: u64) -> LateCopies {
        LateCopies {
            share,
            longest,
            random: Random::keyed(seed, &[91]),
            seen: 0,
            waiting: BTreeMap::new(),
            count: 0,
        }
    }

    /// Delivers due copies, and makes copies of the datagrams sent since the last call.
    pub fn step(&mut self, world: &mut World) {
        while let Some((&key, _)) = self.waiting.first_key_value()
            && key.0 <= world.now
            && let Some((to, message)) = self.waiting.remove(&key)
        {
            let is_cut = world.wire.cut.contains(&(message.from.0, to.0));
            if world.program(to.index()).is_some() && !is_cut {
                world.input(to.index(), &Input::Message(message));
            }
        }
        let fleet = world.size() as u32;
        for (at, from, event) in &world.records[self.seen..] {
            let Event::Sent {
                destination,
                port,
                payload,
                ..
            } = event
            else {
                continue;
            };
            for to in (0..fleet).map(RobotId) {
                let is_meant = match *destination {
                    Destination::All => to != *from,
                    Destination::Robot(robot) => to == robot,
                };
                if !is_meant || !self.random.chance(self.share) {
                    continue;
                }
                let delay = self.longest.seconds() * self.random.between(0.0, 1.0);
                self.count += 1;
                let key = (*at + Duration::from_seconds_f64(delay), self.count);
                let message = Message {
                    from: *from,
                    port: *port,
                    payload: payload.clone(),
                };
                self.waiting.insert(key, (to, message));
            }
        }
        self.seen = world.records.len();
    }
}
