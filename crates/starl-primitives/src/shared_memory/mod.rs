//! Shared memory: variables that all robots read and write (thesis, section 3.3.2).
//!
//! A multi-writer variable has one value, which any robot writes. A single-writer array has one element for each robot,
//! which that robot alone writes. Both exist from the first write on. Every robot reads its own copy, so reading and
//! writing never wait; a write is sent to all, and losses are repaired by comparing copies (anti-entropy: Demers et al.
//! 1987, "Epidemic Algorithms for Replicated Database Maintenance").
//!
//! Properties:
//! - eventual consistency: of the writes to a variable the one with the greatest [`Stamp`] wins. Robots that are up and
//!   connected, directly or through others, to one that has it eventually show it;
//! - a write whose writer knew another write wins over it, however wrong the clocks are. Of two writers that do not
//!   know each other's writes the one with the later clock wins, then the one with the greater number;
//! - a robot shows only values that were written, or the initial one, and never goes back to an earlier stamp of a
//!   variable while it runs;
//! - a robot that shows a write of a [causal](SharedMemory::make_causal) variable shows all writes of causal
//!   variables that the writer showed then, or later ones;
//! - after any corruption of memories all this holds again for later writes.
//!
//! The value of a variable may be lost permanently only together with all robots that have it. Then a robot
//! with a causal write that depends on it, and not shown yet, shows it only when the lost one is written
//! again.

mod causality;
mod compare;
mod corrupt;
mod error;
mod gossip;
mod options;
mod packet;
mod receiving;
mod report;
mod sending;
mod stamp;
mod store;
mod writing;

pub use error::WriteError;
pub use options::Options;
pub use stamp::Stamp;

use crate::incarnation::Incarnation;
use alloc::boxed::Box;
use alloc::collections::{BTreeMap, BTreeSet};
use causality::Held;
use gossip::Gossip;
use stamp::HybridClock;
use starl_core::event::SharedMemoryEvent;
use starl_core::{Input, Payload, Port, Primitive, Robot, RobotId, Time, TimerKey, timers};
use store::Store;

timers! {
    enum Alarm {
        /// New writes must be sent; any input does this.
        Flush,
        /// The memory must be announced.
        Gossip,
        /// The missing elements of other robots must be sent again.
        Repair,
    }
}

/// Longer names of variables are refused, bytes.
const LONGEST_NAME: usize = 255;

/// Variables shared by all robots. One instance holds any number of them, and sends all writes of one activation
/// together.
///
/// A structure whose parts belong together is one value. The thesis's attributes, which are written separately, are
/// separate variables, e.g. `position.x`.
#[derive(Clone, Debug)]
pub struct SharedMemory {
    port: Port,
    options: Options,
    clock: HybridClock,
    incarnation: Incarnation,
    store: Store,
    /// The values of multi-writer variables before any write.
    initial: BTreeMap<Box<str>, Payload>,
    /// The values of elements of arrays before any write.
    initial_elements: BTreeMap<Box<str>, Payload>,
    /// The variables that are causal.
    causal: BTreeSet<Box<str>>,
    /// The writes that arrived before their dependencies.
    held: Held,
    /// Written and not yet sent.
    unsent: BTreeSet<u64>,
    /// To be sent again, since some robot lacks it.
    repairs: BTreeSet<u64>,
    /// When the next of these go out.
    repair_due: Option<Time>,
    gossip: Gossip,
    /// When an element last changed.
    changed: Time,
}

impl SharedMemory {
    /// An instance; those of the same name on all robots are one memory.
    pub fn new(name: &str, options: Options) -> SharedMemory {
        SharedMemory {
            port: Port::named(name),
            options,
            clock: HybridClock::default(),
            incarnation: Incarnation::default(),
            store: Store::default(),
            initial: BTreeMap::new(),
            initial_elements: BTreeMap::new(),
            causal: BTreeSet::new(),
            held: Held::new(),
            unsent: BTreeSet::new(),
            repairs: BTreeSet::new(),
            repair_due: None,
            gossip: Gossip::default(),
            changed: Time::ZERO,
        }
    }

    /// Says what a multi-writer variable holds before any write (the thesis's create). It is not sent:
    /// each robot that wants it says so itself, as robots with the same program do.
    pub fn initialize(&mut self, robot: &mut Robot<'_>, variable: &str, value: Payload) {
        self.report_initial(robot, variable, false, &value);
        self.initial.insert(variable.into(), value);
    }

    /// Says what the elements of a single-writer array hold before any write: see
    /// [`SharedMemory::initialize`].
    pub fn initialize_elements(&mut self, robot: &mut Robot<'_>, variable: &str, value: Payload) {
        self.report_initial(robot, variable, true, &value);
        self.initial_elements.insert(variable.into(), value);
    }

    fn report_initial(
        &self,
        robot: &mut Robot<'_>,
        variable: &str,
        single_writer: bool,
        value: &Payload,
    ) {
        let initialize = SharedMemoryEvent::Initialize {
            variable: variable.into(),
            single_writer,
            value: report::value_hash(value),
        };
        robot.report(self.port, initialize);
    }

    /// Writes a multi-writer variable (the thesis's put).
    pub fn write(
        &mut self,
        robot: &mut Robot<'_>,
        variable: &str,
        value: Payload,
    ) -> Result<Stamp, WriteError> {
        self.set(robot, variable, None, value)
    }

    /// Reads a multi-writer variable (the thesis's get); none where neither a write nor an initial
    /// value is known.
    pub fn read(&self, variable: &str) -> Option<&[u8]> {
        let written = self.store.get(variable, None).map(|element| &element.value);
        written
            .map(|value| &value[..])
            .or_else(|| self.initial(variable))
    }

    /// The value of a multi-writer variable before any write, if this robot has said what it is.
    pub fn initial(&self, variable: &str) -> Option<&[u8]> {
        Some(self.initial.get(variable)?)
    }

    /// Writes this robot's element of a single-writer array. Writing the value that it has already does
    /// nothing.
    pub fn write_own(
        &mut self,
        robot: &mut Robot<'_>,
        variable: &str,
        value: Payload,
    ) -> Result<Stamp, WriteError> {
        let me = robot.id();
        match self.store.get(variable, Some(me)) {
            Some(present) if present.is_mine(me) && present.value == value => Ok(present.stamp),
            _ => self.set(robot, variable, Some(me), value),
        }
    }

    /// Reads a robot's element of a single-writer array; none where neither a write nor an initial
    /// value is known.
    pub fn read_of(&self, variable: &str, owner: RobotId) -> Option<&[u8]> {
        let element = self.store.get(variable, Some(owner));
        let written = element.map(|element| &element.value);
        Some(written.or_else(|| self.initial_elements.get(variable))?)
    }

    /// The known elements of a single-writer array, in the order of the robots' numbers. Elements of robots that have
    /// left the fleet remain.
    pub fn all(&self, variable: &str) -> impl Iterator<Item = (RobotId, &[u8])> {
        let elements = self.store.array(variable);
        elements.map(|(owner, element)| (owner, &element.value[..]))
    }

    /// The stamp of the value of [`SharedMemory::read`]; none before any write.
    pub fn stamp(&self, variable: &str) -> Option<Stamp> {
        Some(self.store.get(variable, None)?.stamp)
    }

    /// The stamp of the value of [`SharedMemory::read_of`]; none before any write.
    pub fn stamp_of(&self, variable: &str, owner: RobotId) -> Option<Stamp> {
        Some(self.store.get(variable, Some(owner))?.stamp)
    }

    /// The value of a variable that has this hash in events, among all values that this robot knows.
    pub fn with_hash(&self, variable: &str, hash: i64) -> Option<&[u8]> {
        let initial = self.initial_elements.get(variable);
        let own = [
            self.read(variable),
            self.initial(variable),
            initial.map(|value| &value[..]),
        ];
        let elements = self.all(variable).map(|(_, value)| value);
        let mut values = own.into_iter().flatten().chain(elements);
        values.find(|value| report::value_hash(value) == hash)
    }

    /// How many variables and elements are known.
    pub fn elements(&self) -> usize {
        self.store.len()
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    fn timer(&self, alarm: Alarm) -> TimerKey {
        TimerKey::new(self.port, alarm)
    }
}

impl Primitive for SharedMemory {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        self.clock.refresh();
        self.flush(robot);
        match input {
            Input::Message(message) if message.port == self.port => self.receive(robot, message),
            Input::Timer(key) if key.port == self.port => match key.read() {
                Some(Alarm::Gossip) => self.announce(robot),
                Some(Alarm::Repair) => self.repair(robot),
                Some(Alarm::Flush) | None => {}
            },
            _ => {}
        }
        self.keep_time(robot);
    }
}
