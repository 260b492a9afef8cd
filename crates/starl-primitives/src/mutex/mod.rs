//! Mutual exclusion on sets of named resources (thesis, section 3.4.3).
//!
//! A robot asks for several resources at once, gets all of them at once, and gives them back one by one
//! or together. The algorithm is Ricart and Agrawala's (1981) with sets, as in the thesis: a request goes
//! to all participants, each permits it unless it has or earlier asked for one of the same resources, and
//! then permits it when it has given those back; a request that all have permitted is granted.
//!
//! Where it differs: requests are repeated until they are permitted, so that it bears loss, duplication
//! and reordering without another protocol below. And a robot that waits itself, and permits a request of a
//! robot that has restarted or that it had not heard of, asks that robot's permission anew
//! (an attempt of the same request): what was permitted before is forgotten there, or was never asked for.
//!
//! Properties, for participants that ask each other:
//! - safety: no resource is held by two robots at once, whatever the network does and whichever robots
//!   crash and restart;
//! - progress: if every holder gives back what it holds, every request is granted, in the order of
//!   Lamport's clock where requests overlap: nobody starves, and overlapping sets do not deadlock;
//! - non-interference: a request that overlaps with nobody's is granted after one exchange of messages, two
//!   where robots hear of each other for the first time;
//! - nobody waits unaware: where a participant whose permission is missing is suspected by the program's
//!   [`crate::FailureDetector`], [`Mutex::failed`] says so, until the robot is trusted again.
//!
//! What a robot held when it crashed stays locked until it is up again, when it holds nothing.
//!
//! Messages for a request among n robots: 2(n - 1), the n - 1 requests being one datagram to all; and one
//! more for each repetition.
//!
//! Not self-stabilising: after a corruption of state two robots may believe that they hold a resource,
//! until they give it back. From then on all holds again.

mod options;
mod packet;
mod protocol;

pub use options::Options;

use crate::incarnation::Incarnation;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use packet::{Packet, RequestId, Wish};
use starl_core::event::Name;
use starl_core::{Destination, Input, Port, Primitive, Random, Robot, RobotId, TimerKey, Value};

const KIND: &str = "mutex";

/// A clock this far ahead is none that robots' requests could have driven it to.
const FURTHEST: u64 = 1 << 40;

/// Names of resources.
pub type Resources = BTreeSet<Box<str>>;

/// Locks on named resources, held by one robot at a time. See the [module](self).
#[derive(Clone, Debug)]
pub struct Mutex {
    port: Port,
    options: Options,
    /// Who is asked; none for all of the fleet.
    participants: Option<BTreeSet<RobotId>>,
    incarnation: Incarnation,
    /// Counts requests.
    last_number: u32,
    /// Lamport's clock (1978).
    clock: u64,
    held: Resources,
    waiting: Option<Waiting>,
    /// The latest requests that are to be permitted later.
    deferred: BTreeMap<RobotId, Wish>,
    /// The incarnation of each robot that was permitted something.
    known: BTreeMap<RobotId, u32>,
    suspects: BTreeSet<RobotId>,
}

/// A request that is not granted yet.
#[derive(Clone, Debug)]
struct Waiting {
    wish: Wish,
    /// Those whose permission is missing, and the first attempt that their answer may be to.
    missing: BTreeMap<RobotId, u32>,
    /// How often it was repeated.
    repetitions: u32,
}

/// Why a request was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AcquireError {
    /// The robot holds resources already. Two robots that held some and waited for others could wait
    /// for each other for ever, so all that is needed is to be asked for at once.
    HoldsOthers,
}

impl Mutex {
    /// An instance; those of the same name on all robots lock the same resources. `participants` are
    /// asked for permission: all of the fleet, if none are given. Whoever may ask for the same resource
    /// must be a participant of the others.
    pub fn new(name: &str, participants: Option<BTreeSet<RobotId>>, options: Options) -> Mutex {
        Mutex {
            port: Port::named(name),
            options,
            participants,
            incarnation: Incarnation::default(),
            last_number: 0,
            clock: 0,
            held: Resources::new(),
            waiting: None,
            deferred: BTreeMap::new(),
            known: BTreeMap::new(),
            suspects: BTreeSet::new(),
        }
    }

    /// Changes who is asked from the next request on.
    pub fn set_participants(&mut self, participants: Option<BTreeSet<RobotId>>) {
        self.participants = participants;
    }

    /// Asks for all of these resources at once (the thesis's do_mutex). A request that is under way
    /// already is withdrawn, unless it is for the same resources. Nothing is asked for an empty set, which
    /// counts as held.
    ///
    /// # Errors
    /// Where the robot holds something.
    pub fn acquire(
        &mut self,
        robot: &mut Robot<'_>,
        resources: Resources,
    ) -> Result<(), AcquireError> {
        if !self.held.is_empty() {
            return match self.held.is_superset(&resources) {
                true => Ok(()),
                false => Err(AcquireError::HoldsOthers),
            };
        }
        let same = |waiting: &Waiting| waiting.wish.resources == resources;
        if self.waiting.as_ref().is_some_and(same) {
            return Ok(());
        }
        self.withdraw(robot);
        if resources.is_empty() {
            return Ok(());
        }
        self.report(robot, "acquire", &resources);
        self.clock = self.clock.saturating_add(1);
        self.last_number = self.last_number.wrapping_add(1);
        self.waiting = Some(Waiting {
            missing: self.others(robot).map(|peer| (peer, 0)).collect(),
            wish: Wish {
                id: RequestId {
                    incarnation: self.incarnation.of(robot),
                    number: self.last_number,
                },
                attempt: 0,
                clock: self.clock,
                resources,
            },
            repetitions: 0,
        });
        self.ask(robot);
        self.enter_if_permitted(robot);
        Ok(())
    }

    /// Gives back resources, all that are held or some; those that are still waited for are no longer
    /// asked for.
    pub fn release(&mut self, robot: &mut Robot<'_>, resources: &Resources) {
        let left: Resources = self.held.intersection(resources).cloned().collect();
        self.held.retain(|resource| !resources.contains(resource));
        self.report(robot, "release", &left);
        let waits = |waiting: &Waiting| !waiting.wish.resources.is_disjoint(resources);
        if self.waiting.as_ref().is_some_and(waits) {
            self.withdraw(robot);
        }
        self.permit_deferred(robot);
    }

    /// Whether this robot holds all of these resources.
    pub fn holds(&self, resources: &Resources) -> bool {
        self.held.is_superset(resources)
    }

    /// What this robot holds.
    pub fn held(&self) -> &Resources {
        &self.held
    }

    /// Whether this robot holds anything (the thesis's crit, until all is given back).
    pub fn crit(&self) -> bool {
        !self.held.is_empty()
    }

    /// Whether a request is under way.
    pub fn is_waiting(&self) -> bool {
        self.waiting.is_some()
    }

    /// Whether a robot whose permission is missing is believed to have failed. The request stays, and
    /// goes on should the robot come back; [`Mutex::release`] withdraws it.
    pub fn failed(&self) -> bool {
        let is_suspected = |peer: &RobotId| self.suspects.contains(peer);
        self.waiting
            .as_ref()
            .is_some_and(|waiting| waiting.missing.keys().any(is_suspected))
    }

    /// Overwrites the state at random, as a transient fault would, given the resources that there are.
    pub fn corrupt(&mut self, random: &mut Random, resources: &Resources) {
        let mut some = || -> Resources {
            let chosen = resources.iter().filter(|_| random.chance(0.5));
            chosen.cloned().collect()
        };
        self.held = some();
        if let Some(waiting) = &mut self.waiting {
            waiting.wish.resources = some();
        }
        self.deferred.retain(|_, _| random.chance(0.5));
        self.suspects.retain(|_| random.chance(0.5));
        if let Some(waiting) = &mut self.waiting {
            waiting.missing.retain(|_, _| random.chance(0.5));
            waiting.wish.clock = u64::from(random.bits());
            waiting.repetitions = random.bits();
        }
        self.clock = u64::from(random.bits());
        self.last_number = random.bits();
    }

    fn report(&self, robot: &mut Robot<'_>, event: &'static str, resources: &Resources) {
        for resource in resources {
            let name = Value::Text(Name::Owned((**resource).into()));
            robot.emit_primitive(KIND, self.port, event, [("resource", name)]);
        }
    }

    fn timer(&self) -> TimerKey {
        TimerKey {
            port: self.port,
            kind: 0,
            number: 0,
        }
    }
}

impl Primitive for Mutex {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Message(message) if message.port == self.port => self.receive(robot, message),
            Input::Timer(key) if *key == self.timer() => self.ask_again(robot),
            Input::Suspected(peer) => {
                self.suspects.insert(*peer);
            }
            Input::Trusted(peer) => {
                self.suspects.remove(peer);
                if let Some(waiting) = &self.waiting
                    && waiting.missing.contains_key(peer)
                {
                    let request = Packet::Request(waiting.wish.clone());
                    robot.transmit(Destination::Robot(*peer), self.port, &request);
                }
            }
            _ => {}
        }
    }
}
