//! Overwriting the state at random, as a transient fault would.

use super::{Barrier, Words};
use crate::handshake::Handshake;
use starl_core::{Random, Time};

impl Barrier {
    /// Overwrites the state at random, within its types: for a program's
    /// [`starl_core::Program::corrupt`].
    pub fn corrupt(&mut self, random: &mut Random) {
        self.generation = random.magnitude();
        self.knows = random.chance(0.5);
        if self.has_come {
            self.waits = random.chance(0.5);
        }
        self.peers.retain(|_, _| random.chance(0.7));
        for peer in self.peers.values_mut() {
            peer.echo = random.bits();
            peer.asks_anew = random.chance(0.5);
            peer.lives = Handshake::asking(random.bits());
            if random.chance(0.7) {
                let words = Words {
                    generation: random.magnitude(),
                    waits: random.chance(0.5),
                    knows: random.chance(0.5),
                };
                peer.lives.heard = Some((random.bits(), words));
            }
            peer.is_told = random.chance(0.5);
        }
        self.owed.retain(|_| random.chance(0.5));
        self.suspects
            .extend(self.peers.keys().filter(|_| random.chance(0.5)));
        self.repetitions = random.bits();
        self.due = random.chance(0.5).then(|| Time(random.magnitude()));
    }
}
