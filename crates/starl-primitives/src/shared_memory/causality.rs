//! Causal variables: a robot shows a write after all writes that it may depend on.
//!
//! A write of a causal variable may depend on all writes of causal variables that its writer shows (Ahamad,
//! Neiger, Burns, Kohli, Hutto 1995, "Causal Memory: Definitions, Implementation, and Programming"). It
//! carries their stamps, and a receiver holds it back until it shows each of these writes or a later one of
//! the same variable.
//!
//! Invariant: the dependencies of every shown element are covered by shown elements.
//!
//! Where ours differs from causal stores that send the nearest dependencies alone (Lloyd, Freedman, Kaminsky, Andersen
//! 2011, "Don't Settle for Eventual: Scalable Causal Consistency for Wide-Area Storage with COPS"): here copies are
//! compared, and a write that was overwritten is not delivered to all. A write that depends on it would lack the
//! dependencies of the overwritten one, so all dependencies are sent.

use super::SharedMemory;
use super::packet::{Dependency, Write};
use super::stamp::Stamp;
use super::store::{Store, key};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::SharedMemoryEvent;
use starl_core::{Robot, Time};

/// A robot asks for the dependencies of a write that it has held for this many times the time in which writes settle.
///
/// Comparisons ([`super::compare`]) are too rare for this where elements are written all the time and some links are
/// down: a robot that cannot hear another one needs all that a third robot shows at one moment.
const PATIENCE: u64 = 2;

/// Until it has held the write for this many times that time, it asks often.
const LONGEST_HASTE: u64 = 128;

/// The writes that arrived before their dependencies, by the keys of their elements.
pub(super) type Held = BTreeMap<u64, HeldWrite>;

/// The latest write of an element whose writes are held back.
#[derive(Clone, Debug)]
pub(super) struct HeldWrite {
    pub write: Write,
    /// The dependencies that were not shown when they were last looked up: most writes lack few of many.
    missing: Vec<Dependency>,
    /// Since when writes of this element have been held back, by the robot's own clock.
    pub since: Time,
}

impl Store {
    /// Whether this write, or a later one, is shown.
    fn shows(&self, dependency: &Dependency) -> bool {
        let shown = self.at(dependency.key);
        shown.is_some_and(|element| element.stamp >= dependency.stamp)
    }

    /// Those of these that are not shown.
    fn lacks(&self, depends: &[Dependency]) -> Vec<Dependency> {
        let lacking = depends.iter().filter(|dependency| !self.shows(dependency));
        lacking.copied().collect()
    }

    /// The dependencies of a write made now, except the element that it replaces.
    pub fn dependencies(&self, but: u64) -> Vec<Dependency> {
        let causal = self.range(0..=u64::MAX);
        let causal = causal.filter(|(key, element)| *key != but && element.depends.is_some());
        causal
            .map(|(key, element)| Dependency {
                key,
                stamp: element.stamp,
            })
            .collect()
    }
}

impl SharedMemory {
    /// Makes a variable, or an array, causal: what this robot writes to it from now on is shown by others
    /// only together with the writes to causal variables that this robot shows. All robots that write it
    /// should say so.
    pub fn make_causal(&mut self, robot: &mut Robot<'_>, variable: &str) {
        if self.causal.insert(variable.into()) {
            let variable = variable.into();
            robot.report(self.port, SharedMemoryEvent::Causal { variable });
        }
    }

    /// Holds a write back if a dependency is missing; otherwise returns it.
    pub(super) fn hold(&mut self, write: Write, now: Time) -> Option<Write> {
        let depends = write.depends.as_deref().unwrap_or_default();
        let missing = self.store.lacks(depends);
        if missing.is_empty() {
            return Some(write);
        }
        for dependency in depends {
            // So that what is written there next covers it, even if a corruption made it up.
            self.clock.observe(dependency.stamp.clock());
        }
        let owner = write.single_writer.then_some(write.stamp.writer);
        let key = key(&write.variable, owner);
        let order = |write: &Write| -> (Stamp, usize) {
            // Of two copies of a write the one with fewer dependencies is the corrected one.
            let count = write.depends.as_ref().map_or(0, Vec::len);
            (write.stamp, usize::MAX - count)
        };
        let has_room = self.held.len() < self.options.most_elements;
        match self.held.get_mut(&key) {
            Some(held) if order(&held.write) < order(&write) => {
                (held.write, held.missing) = (write, missing);
            }
            None if has_room => {
                let since = now;
                self.held.insert(
                    key,
                    HeldWrite {
                        write,
                        missing,
                        since,
                    },
                );
            }
            _ => {}
        }
        None
    }

    /// Asks the writer of a write that has been held for long for what is missing; whether it should ask again soon.
    pub(super) fn ask(&mut self, robot: &mut Robot<'_>) -> bool {
        let (now, me) = (robot.now(), robot.id());
        let held_for = |times: u64| now - self.options.settling() * times;
        let (soon, late) = (held_for(PATIENCE), held_for(LONGEST_HASTE));
        let long_held = self.held.iter().filter(|(_, held)| held.since <= soon);
        let of_others = long_held.filter(|(_, held)| held.write.stamp.writer != me);
        let candidates: Vec<(u64, &HeldWrite)> =
            of_others.map(|(&key, held)| (key, held)).collect();
        if candidates.is_empty() {
            return false;
        }
        let (key, held) = candidates[robot.random().below(candidates.len() as u32) as usize];
        let missing = self.store.lacks(&held.missing);
        let wanted = core::iter::once(key).chain(missing.iter().map(|dependency| dependency.key));
        let (writer, wanted) = (held.write.stamp.writer, wanted.collect());
        let is_urgent = held.since > late;
        self.send_wanted(robot, writer, wanted);
        is_urgent
    }

    /// The held writes whose dependencies are now complete. They must be shown together: two of them may depend on each
    /// other, if one is later than the other's dependency.
    pub(super) fn take_released(&mut self) -> Vec<Write> {
        for held in self.held.values_mut() {
            held.missing.retain(|missing| !self.store.shows(missing));
        }
        let mut ready = self.ready();
        let lacks = |key: &u64| {
            let depends = self
                .held
                .get(key)
                .and_then(|held| held.write.depends.as_ref());
            let mut depends = depends.into_iter().flatten();
            !depends.all(|needed| self.store.shows(needed) || is_in(&ready, needed))
        };
        // A corruption may have removed a write that was shown.
        if ready.keys().any(lacks) {
            for held in self.held.values_mut() {
                let depends = held.write.depends.as_deref();
                held.missing = self.store.lacks(depends.unwrap_or_default());
            }
            ready = self.ready();
        }
        let released = ready.into_keys();
        released
            .filter_map(|key| self.held.remove(&key))
            .map(|held| held.write)
            .collect()
    }

    /// The held writes that lack each other only.
    fn ready(&self) -> BTreeMap<u64, Stamp> {
        let held = self.held.iter();
        let mut ready: BTreeMap<u64, Stamp> =
            held.map(|(&key, held)| (key, held.write.stamp)).collect();
        loop {
            let lacks = |key: &u64| {
                let missing = self.held.get(key).map(|held| &held.missing);
                !missing
                    .into_iter()
                    .flatten()
                    .all(|needed| is_in(&ready, needed))
            };
            let lacking: Vec<u64> = ready.keys().copied().filter(lacks).collect();
            if lacking.is_empty() {
                return ready;
            }
            for key in lacking {
                ready.remove(&key);
            }
        }
    }
}

/// Whether a write, or a later one, is among these.
fn is_in(writes: &BTreeMap<u64, Stamp>, needed: &Dependency) -> bool {
    writes
        .get(&needed.key)
        .is_some_and(|stamp| *stamp >= needed.stamp)
}
