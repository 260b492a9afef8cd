//! Causal order by vector clocks (Birman, Schiper and Stephenson 1991; the condition on deliveries as in
//! Raynal, Schiper and Toueg 1991).
//!
//! A message says of each sender up to which of its messages its own sender had taken them. A receiver
//! holds it back until it has taken as much. Below is the acknowledged protocol in FIFO order, which
//! says when a message of a sender will not come any more.
//!
//! Invariant: when a message is handed out, every message that it comes after has been handed out, or
//! passed over for good, which is on record. What was passed over and comes after all is not handed out.
//!
//! Where ours differs: the clock counts the messages of robots' lives and not of robots, so that a restart is
//! another sender; only lives that were heard of have an entry. And nobody waits for ever: a message that
//! others come after is passed over if its sender says that it will not come, has started anew, or is
//! suspected of having failed and does not answer, and in any case when its sender must have given it up.

mod asking;
mod holding;
mod vector;

use super::{Gap, Gaps};
use crate::channel::Channel;
use crate::reliable::{Alarm, Arrival, MessageId, Notice, encode};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use asking::Doubt;
use holding::Held;
use serde::{Deserialize, Serialize};
use starl_core::event::BroadcastEvent;
use starl_core::{Duration, Input, Payload, Random, Robot, RobotId, TimerKey, message};
use vector::{After, Process, Vector};

/// What is held back is looked at this often.
const LOOK: Duration = Duration::from_millis(250);

/// A suspected sender's messages are waited for at least this many looks.
const LEAST_LOOKS: u32 = 8;

/// Those of a sender that says nothing, though it is asked, this many.
const LONGEST_SILENCE: u32 = 40;

/// Messages are held back up to this number; with more, the oldest waits no longer.
const MOST_HELD: usize = 1024;

/// One end of a causally ordered broadcast.
#[derive(Clone, Debug)]
pub(super) struct Causal {
    pub channel: Channel,
    vector: Vector,
    /// What is held back, in the order in which it came.
    held: Vec<Held>,
    suspects: BTreeSet<RobotId>,
    /// Counts looks.
    looks: u32,
    /// That count when each sender was last heard.
    heard: BTreeMap<RobotId, u32>,
    /// Counts questions.
    questions: u32,
    /// The last question to each robot.
    doubts: BTreeMap<RobotId, Doubt>,
    gaps: Gaps,
}

/// What travels.
#[derive(Serialize, Deserialize)]
struct Ordered<C> {
    after: Vec<After>,
    content: C,
}

impl Causal {
    pub fn new(channel: Channel) -> Causal {
        Causal {
            channel,
            vector: Vector::default(),
            held: Vec::new(),
            suspects: BTreeSet::new(),
            looks: 0,
            heard: BTreeMap::new(),
            questions: 0,
            doubts: BTreeMap::new(),
            gaps: Gaps::default(),
        }
    }

    pub fn broadcast(&mut self, robot: &mut Robot<'_>, content: Payload) -> MessageId {
        let after = self.vector.now();
        let content = Bytes(&content);
        self.channel
            .send_to_peers(robot, encode(&Ordered { after, content }))
    }

    /// What was passed over since the last call.
    pub fn take_gaps(&mut self) -> Vec<Gap> {
        self.gaps.take()
    }

    pub fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Suspected(peer) => {
                self.suspects.insert(*peer);
            }
            Input::Trusted(peer) => {
                self.suspects.remove(peer);
            }
            Input::Timer(key) if *key == self.timer() => return self.look(robot),
            _ => {}
        }
        for notice in self.channel.hear(robot, input) {
            match notice {
                Notice::Arrived(arrival) => {
                    self.heard.insert(arrival.from, self.looks);
                    self.arrive(robot, arrival);
                }
                Notice::Settled {
                    from,
                    incarnation,
                    before,
                    next,
                    ticket,
                } => {
                    self.heard.insert(from, self.looks);
                    let process = Process {
                        robot: from,
                        incarnation,
                    };
                    self.settle(process, before);
                    self.clear_doubt(process, next, ticket);
                    self.hand_out_ready(robot);
                }
                _ => {}
            }
        }
    }

    fn arrive(&mut self, robot: &mut Robot<'_>, arrival: Arrival) {
        let Some(Ordered { after, content }) =
            message::decode::<Ordered<Payload>>(&arrival.content)
        else {
            return;
        };
        let process = Process {
            robot: arrival.from,
            incarnation: arrival.incarnation,
        };
        let known = self.vector.hear(process);
        if arrival.number <= known.taken {
            self.ask(robot, process);
            let (from, message) = arrival.numbered();
            return robot.report(self.channel.port, BroadcastEvent::Late { from, message });
        }
        // In FIFO order those before it have arrived or never will; and this life is not over.
        let before = arrival.number - 1;
        known.settled = match known.settled {
            u32::MAX => before,
            settled => settled.max(before),
        };
        let me = robot.id();
        let (own, mut after): (Vec<After>, Vec<After>) = after
            .into_iter()
            .filter(|after| after.process != process)
            .partition(|after| after.process.robot == me);
        after.push(After {
            process,
            number: arrival.number - 1,
        });
        self.held.push(Held {
            arrival: Arrival { content, ..arrival },
            after,
            own,
            looks: 0,
        });
        self.hand_out_ready(robot);
        while self.held.len() > MOST_HELD {
            self.force(robot, 0);
        }
        if !self.held.is_empty() {
            robot.set_timer(self.timer(), LOOK);
        }
    }

    /// Looks after what is held back: asks those whose messages are missing, and waits no longer for
    /// what has waited too long.
    fn look(&mut self, robot: &mut Robot<'_>) {
        let patience = self.channel.reliable.options().failure_bound();
        let most_looks = (patience.seconds() / LOOK.seconds()) as u32;
        let mut asked = BTreeSet::new();
        self.looks = self.looks.wrapping_add(1);
        for held in &mut self.held {
            held.looks = held.looks.saturating_add(1);
        }
        for place in 0..self.held.len() {
            let Some(held) = self.held.get(place) else {
                break;
            };
            if (held.looks.is_power_of_two() || held.looks % 4 == 0)
                && let Some(after) = self.missing(held)
                && asked.insert(after.process.robot)
            {
                self.ask(robot, after.process);
            }
        }
        self.hand_out_ready(robot);
        while let Some(place) = self.held.iter().position(|held| held.looks > most_looks) {
            self.force(robot, place);
        }
        if !self.held.is_empty() {
            robot.set_timer(self.timer(), LOOK);
        }
    }

    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        for known in self.vector.iter_mut() {
            if random.chance(0.5) {
                known.taken = random.bits() >> random.below(32);
            }
            if random.chance(0.5) {
                known.settled = random.bits() >> random.below(32);
            }
        }
        for held in &mut self.held {
            held.looks = random.bits();
            held.after.retain(|_| random.chance(0.5));
        }
        self.suspects.retain(|_| random.chance(0.5));
        self.looks = random.bits();
    }

    fn timer(&self) -> TimerKey {
        TimerKey::new(self.channel.port, Alarm::Look)
    }
}

/// Bytes that are written as a [`Payload`] is.
struct Bytes<'a>(&'a Payload);

impl Serialize for Bytes<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}
