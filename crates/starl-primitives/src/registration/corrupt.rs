//! Overwriting the state at random, as a transient fault would.

use super::roster::{Peer, Shunned};
use super::ticket::Ticket;
use super::{Registration, Stage};
use alloc::collections::BTreeSet;
use starl_core::{Random, RobotId, Time};

impl Registration {
    /// Overwrites the state at random, within its types: for a program's [`starl_core::Program::corrupt`]. The robot's
    /// participation does not change, because it is its program's last request.
    pub fn corrupt(&mut self, random: &mut Random) {
        if let Some(own) = &mut self.own {
            own.ticket = ticket(random);
            own.announcements = random.bits() >> random.below(32);
            own.gathers_until = Time(random.magnitude());
        }
        let known: BTreeSet<RobotId> = self.peers.keys().copied().collect();
        let mut some = || -> BTreeSet<RobotId> {
            known
                .iter()
                .copied()
                .filter(|_| random.chance(0.5))
                .collect()
        };
        let (unknown, garbled, suspects, members) = (some(), some(), some(), some());
        for (&peer, known) in self.peers.iter().filter(|(peer, _)| garbled.contains(peer)) {
            let over = Ticket {
                number: random.bits() >> random.below(32),
                ..known.ticket
            };
            self.past.ends(peer, over);
        }
        self.peers.retain(|peer, _| !unknown.contains(peer));
        for (peer, known) in &mut self.peers {
            if garbled.contains(peer) {
                *known = Peer {
                    ticket: ticket(random),
                    led_by: random.chance(0.5).then(|| RobotId(random.below(8))),
                    hears: random.chance(0.5),
                };
            }
        }
        self.suspects = suspects;
        self.shunned.retain(|_, _| random.chance(0.5));
        for shunned in self.shunned.values_mut() {
            *shunned = Shunned {
                until: Time(random.magnitude()),
                times: random.bits(),
            };
        }
        match &mut self.stage {
            Stage::Open => {}
            Stage::Proposed { missing, .. } => *missing = members,
            Stage::Accepted { repetitions, .. } => *repetitions = random.bits(),
            Stage::Agreed {
                view,
                members: shown,
                ..
            } => {
                view.roll.retain(|_, _| random.chance(0.5));
                if random.chance(0.5) {
                    view.id.time = Time(random.magnitude());
                }
                *shown = members;
            }
        }
        self.promised.time = Time(random.magnitude());
        self.latest = Time(random.magnitude());
        self.due = random.chance(0.5).then(|| Time(random.magnitude()));
        self.announces_at = Time(random.magnitude());
        self.failed = random.chance(0.5);
    }
}

fn ticket(random: &mut Random) -> Ticket {
    Ticket {
        life: random.bits(),
        number: random.bits(),
    }
}
