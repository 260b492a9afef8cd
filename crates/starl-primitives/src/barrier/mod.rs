//! Barrier: no robot continues before all have arrived at the same point (of the original StarL; the
//! thesis mentions it among the synchronisation primitives).
//!
//! A barrier is used repeatedly; its crossings (generations) are numbered 1, 2, 3, ... A robot that has
//! arrived announces its generation to all. It passes when it knows that all others have arrived at that
//! generation, or that one of them has passed it (a dissemination of counters, as in the sense-reversing
//! barriers of Hensgen, Finkel and Manber 1988, with numbers instead of senses).
//!
//! A robot that has just started, or restarted without memory, does not know the next generation. It asks all
//! others, with its life, and takes the greatest number in their answers; answers to an earlier life do not count.
//! It passes nothing until all have answered, which costs no time, because it needs all of them to pass. Its
//! arrival does not count before, because its generation is unknown. A life that is new to a robot must answer a
//! number that the robot draws for it, so that late duplicates of earlier lives no longer count.
//!
//! These guarantees hold whatever the network does and whichever robots crash and restart, as long as
//! state is not corrupted:
//! - safety: no robot passes a generation before every participant has arrived at it, or at a later
//!   one;
//! - order: the generations that a robot passes in one life rise.
//!
//! If all have crashed since they last passed, generations start again with 1, with the same guarantees from
//! there.
//!
//! These hold if not all datagrams are lost:
//! - progress: when all participants have arrived and are up, all pass;
//! - failures are visible: while a missing participant is suspected, [`Barrier::failed`] is true. If it returns and
//!   arrives, all pass.
//!
//! Announcements before a crash still count: the others do not wait for a robot that arrived and crashed
//! in that generation.
//!
//! Messages for n robots: n datagrams to all for each generation; 3n - 2 for the first, and up to n more
//! after a restart; and retransmissions.
//!
//! Self-stabilising: numbers that do not fit each other make robots ask all others again, and they agree on
//! the greatest. After a corruption of state robots may pass one generation too early.

mod corrupt;
mod hearing;
mod options;
mod packet;
mod saying;

pub use options::Options;

use crate::handshake::Handshake;
use crate::incarnation::Incarnation;
use alloc::collections::{BTreeMap, BTreeSet};
use starl_core::event::BarrierEvent;
use starl_core::{Input, Port, Primitive, Robot, RobotId, Time, TimerKey, timers};

/// Robots cannot have counted to greater numbers.
const GREATEST: u64 = 1 << 62;

timers! {
    enum Alarm {
        /// The robot must repeat its announcement.
        Repeat,
    }
}

/// A point at which all robots arrive before any continues. See the [module](self).
#[derive(Clone, Debug)]
pub struct Barrier {
    port: Port,
    options: Options,
    /// The robots that must arrive; none for the whole fleet.
    participants: Option<BTreeSet<RobotId>>,
    incarnation: Incarnation,
    /// The generation that it waits for, or will wait for next.
    generation: u64,
    /// Whether this is certain: all others have answered since this robot began to ask.
    knows: bool,
    /// Whether it ever arrived.
    has_come: bool,
    waits: bool,
    /// The others, as far as they were heard.
    peers: BTreeMap<RobotId, Peer>,
    /// Those that need to hear from this robot.
    owed: BTreeSet<RobotId>,
    suspects: BTreeSet<RobotId>,
    /// How often it was said that this robot waits.
    repetitions: u32,
    /// When it is to be said again.
    due: Option<Time>,
}

/// Another robot.
#[derive(Clone, Debug)]
struct Peer {
    /// The announcements of its present life.
    lives: Handshake<Words>,
    /// The number that others must answer.
    echo: u32,
    /// Whether that is a token that it drew for this robot's present life.
    asks_anew: bool,
    /// Whether it has received this robot's position in the barrier.
    is_told: bool,
}

/// The announcements of a life since it heard of this robot's present one.
#[derive(Clone, Copy, Debug, Default)]
struct Words {
    /// The generation that it waits for, or will wait for next, or more if it does not know.
    generation: u64,
    waits: bool,
    knows: bool,
}

impl Barrier {
    /// An instance; those of the same name on all robots are the same barrier. `participants` must arrive, the whole
    /// fleet if none are given; they must be the same on all robots.
    pub fn new(name: &str, participants: Option<BTreeSet<RobotId>>, options: Options) -> Barrier {
        Barrier {
            port: Port::named(name),
            options,
            participants,
            incarnation: Incarnation::default(),
            generation: 1,
            knows: false,
            has_come: false,
            waits: false,
            peers: BTreeMap::new(),
            owed: BTreeSet::new(),
            suspects: BTreeSet::new(),
            repetitions: 0,
            due: None,
        }
    }

    /// Announces that this robot has arrived. It waits from now on; if it waits already nothing happens.
    /// A robot that is not a participant also waits for them, and no robot waits for it.
    pub fn arrive(&mut self, robot: &mut Robot<'_>) {
        if self.waits {
            return;
        }
        let participants = self.all(robot).into_iter().collect();
        robot.report(self.port, BarrierEvent::Arrive { participants });
        (self.waits, self.has_come) = (true, true);
        self.repetitions = 0;
        self.move_on(robot);
        if self.knows {
            self.report_waiting(robot);
        }
        self.say(robot, None);
        self.learn_generation(robot);
        self.pass_if_all_have_come(robot);
    }

    /// Whether all have arrived since this robot last arrived; false before its first arrival.
    pub fn passed(&self) -> bool {
        self.has_come && !self.waits
    }

    /// Whether this robot has arrived and not passed.
    pub fn is_waiting(&self) -> bool {
        self.waits
    }

    /// Whether this robot waits for a suspected robot. It continues to wait, and passes if that robot returns and
    /// arrives.
    pub fn failed(&self) -> bool {
        // Robots that have arrived by now are not waited for, dead or alive.
        self.waits
            && self
                .suspects
                .iter()
                .any(|suspect| self.takes_part(*suspect) && !self.has_arrived(*suspect))
    }

    /// The number of the crossing that this robot waits for, or will wait for next. Not certain before the
    /// first crossing in its present life.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    fn takes_part(&self, robot: RobotId) -> bool {
        let participants = self.participants.as_ref();
        participants.is_none_or(|participants| participants.contains(&robot))
    }

    /// The robots that must arrive, in the order of their numbers.
    fn all(&self, robot: &Robot<'_>) -> BTreeSet<RobotId> {
        let fleet = robot.fleet().iter().copied();
        fleet.filter(|peer| self.takes_part(*peer)).collect()
    }

    fn timer(&self) -> TimerKey {
        TimerKey::new(self.port, Alarm::Repeat)
    }
}

impl Primitive for Barrier {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Message(message) if message.port == self.port => self.receive(robot, message),
            Input::Timer(key) if *key == self.timer() => self.say_again(robot),
            Input::Activate => self.set_right(robot),
            Input::Suspected(peer) => {
                self.suspects.insert(*peer);
            }
            Input::Trusted(peer) => {
                self.suspects.remove(peer);
            }
            _ => {}
        }
    }
}
