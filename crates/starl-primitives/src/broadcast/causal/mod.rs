//! Causal order by vector clocks (Birman, Schiper and Stephenson 1991; the condition on deliveries as in
//! Raynal, Schiper and Toueg 1991).
//!
//! A message lists for each sender the last of its messages that its own sender had delivered. A receiver holds it back
//! until it has delivered as much. Below is the acknowledged protocol in FIFO order, which reports when a message of a
//! sender will not arrive.
//!
//! Invariant: when a message is delivered, every message on which it depends has been delivered, or
//! passed over permanently, which is recorded. A message that was passed over is not delivered later.
//!
//! Where ours differs: the clock counts the messages of robots' lives and not of robots, so that a restart is a
//! different sender. It has the current life of each robot. The later of two lives is found by asking the robot
//! ([`asking`]), not by remembering. No robot waits for ever: a message on which others depend is passed over if its
//! sender reports that it will not arrive, has restarted, or is suspected and does not answer, and in any case when
//! its sender must have given it up.

mod asking;
mod holding;
mod vector;

use super::{Gap, Gaps};
use crate::channel::Channel;
use crate::reliable::{Alarm, Arrival, MessageId, Notice, encode};
use alloc::collections::{BTreeMap, BTreeSet, VecDeque};
use alloc::vec::Vec;
use asking::{Answer, Doubt};
use holding::{Held, Need};
use serde::{Deserialize, Serialize};
use starl_core::event::BroadcastEvent;
use starl_core::{Duration, Input, Payload, Random, Robot, RobotId, TimerKey, message};
use vector::{After, Process, Vector};

/// The interval at which held messages are checked.
const LOOK: Duration = Duration::from_millis(250);

/// A suspected sender's messages are waited for at least this many looks.
const LEAST_LOOKS: u32 = 8;

/// Those of a sender that says nothing, though it is asked, this many.
const LONGEST_SILENCE: u32 = 40;

/// Messages are held back up to this number; with more, the oldest waits no longer.
const MOST_HELD: usize = 32_768;

/// Counts looks; it may wrap around.
type Look = u32;

/// One end of a causally ordered broadcast.
#[derive(Clone, Debug)]
pub(super) struct Causal {
    pub channel: Channel,
    vector: Vector,
    /// Messages that wait, by sender, in the order in which they arrived.
    held: BTreeMap<RobotId, VecDeque<Held>>,
    /// How many messages that are.
    count: usize,
    /// How many messages have arrived.
    arrivals: u64,
    suspects: BTreeSet<RobotId>,
    /// Counts looks.
    looks: Look,
    /// That count when a datagram of each robot last came.
    heard: BTreeMap<RobotId, Look>,
    /// The last question to each robot.
    doubts: BTreeMap<RobotId, Doubt>,
    gaps: Gaps,
    is_looking: bool,
}

/// The content of a datagram.
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
            held: BTreeMap::new(),
            count: 0,
            arrivals: 0,
            suspects: BTreeSet::new(),
            looks: 0,
            heard: BTreeMap::new(),
            doubts: BTreeMap::new(),
            gaps: Gaps::default(),
            is_looking: false,
        }
    }

    pub fn broadcast(&mut self, robot: &mut Robot<'_>, content: Payload) -> MessageId {
        let after = self.vector.now();
        let content = Bytes(&content);
        self.channel
            .send_to_peers(robot, encode(&Ordered { after, content }))
    }

    /// The messages passed over since the last call.
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
            // A robot is there too if what it sends waits below, in FIFO order, for a message that was lost.
            Input::Message(message)
                if message.port == self.channel.port && robot.fleet().contains(&message.from) =>
            {
                self.heard.insert(message.from, self.looks);
            }
            _ => {}
        }
        for notice in self.channel.hear(robot, input) {
            match notice {
                Notice::Arrived(arrival) => self.arrive(robot, arrival),
                Notice::Settled {
                    from,
                    incarnation,
                    before,
                    next,
                    ticket,
                } => {
                    let process = Process {
                        robot: from,
                        incarnation,
                    };
                    let answer = Answer {
                        process,
                        before,
                        next,
                        ticket,
                    };
                    self.answered(robot, &answer);
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
        let (from, message) = arrival.numbered();
        let process = Process {
            robot: from,
            incarnation: arrival.incarnation,
        };
        self.arrivals += 1;
        self.hear(robot, process);
        let Some(life) = self.vector.present(from) else {
            return;
        };
        let number = arrival.number;
        if number <= life.taken {
            self.ask(robot, from);
            return robot.report(self.channel.port, BroadcastEvent::Late { from, message });
        }
        // In FIFO order those before it have arrived or never will.
        life.settled = life.settled.max(number - 1);
        let me = robot.id();
        let is_other = |after: &After| after.process.robot != me && after.process != process;
        let mut after: Vec<After> = after.into_iter().filter(is_other).collect();
        after.push(After {
            process,
            number: number - 1,
        });
        let queue = self.held.entry(from).or_default();
        // Messages of the sender's earlier life are delivered first.
        let before = queue.back().map(|last| &last.arrival);
        after.extend(
            before
                .filter(|last| last.incarnation != process.incarnation)
                .map(|last| After {
                    process: Process {
                        robot: from,
                        incarnation: last.incarnation,
                    },
                    number: last.number,
                }),
        );
        let is_doubtful = self.vector.unheard(from).is_some();
        let unknown = after.iter().filter(|after| self.is_unknown(after));
        let mut unknown: Vec<RobotId> = unknown.map(|after| after.process.robot).collect();
        unknown.extend(is_doubtful.then_some(from));
        // A robot does not know its later lives.
        let need = |after: After| Need {
            after,
            is_over: after.process.robot == from && after.process != process,
        };
        let held = Held {
            arrival: Arrival { content, ..arrival },
            after: after.into_iter().map(need).collect(),
            place: self.arrivals,
            looks: self.looks,
        };
        self.held.entry(from).or_default().push_back(held);
        self.count += 1;
        for peer in unknown {
            self.ask(robot, peer);
        }
        self.hand_out_ready(robot);
        while self.count > MOST_HELD
            && let Some(oldest) = self.oldest()
        {
            self.force(robot, oldest);
        }
        if !self.held.is_empty() && !self.is_looking {
            self.is_looking = true;
            robot.set_timer(self.timer(), LOOK);
        }
    }

    /// The sender whose message has been held for longest.
    fn oldest(&self) -> Option<RobotId> {
        let firsts = self
            .held
            .iter()
            .filter_map(|(from, held)| Some((held.front()?.place, *from)));
        firsts.min().map(|(_, from)| from)
    }

    /// Looks after what is held back: asks those whose messages are missing, and waits no longer for
    /// what has waited too long.
    fn look(&mut self, robot: &mut Robot<'_>) {
        let patience = self.channel.reliable.options().failure_bound();
        let most_looks = (patience.seconds() / LOOK.seconds()) as u32;
        self.is_looking = false;
        self.looks = self.looks.wrapping_add(1);
        let firsts = self.held.values().filter_map(VecDeque::front);
        let due = firsts.filter(|held| {
            let age = self.age(held);
            age.is_power_of_two() || age.is_multiple_of(4)
        });
        let missing = due.filter_map(|held| self.missing(held));
        let missing: BTreeSet<RobotId> = missing.map(|after| after.process.robot).collect();
        for peer in missing {
            self.ask(robot, peer);
        }
        self.hand_out_ready(robot);
        while let Some(oldest) = self.oldest()
            && self
                .held
                .get(&oldest)
                .and_then(VecDeque::front)
                .is_some_and(|held| self.age(held) > most_looks)
        {
            self.force(robot, oldest);
        }
        if !self.held.is_empty() {
            self.is_looking = true;
            robot.set_timer(self.timer(), LOOK);
        }
    }

    /// Overwrites the state at random, as a transient fault would.
    pub fn corrupt(&mut self, random: &mut Random) {
        for life in self.vector.lives_mut() {
            if random.chance(0.5) {
                life.taken = random.bits() >> random.below(32);
            }
            if random.chance(0.5) {
                life.settled = random.bits() >> random.below(32);
            }
        }
        for held in self.held.values_mut().flatten() {
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
