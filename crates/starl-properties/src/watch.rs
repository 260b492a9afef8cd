//! All checkers and monitors of a run, and their verdicts.

use crate::{Checker, Excuse, Kinds, Monitor, Violation, Witness};
use starl_core::event::{Event, Name};
use starl_core::{Record, Time};

/// The checkers and monitors of a run, and their violations.
#[derive(Clone, Default)]
pub struct Watch {
    checkers: Vec<Box<dyn Checker>>,
    monitors: Vec<Box<dyn Monitor>>,
    violations: Vec<Violation>,
    /// The primitives that have reported something.
    used: Vec<String>,
    /// Those of the records that were shown last.
    kinds: Vec<Kinds>,
    /// Those of all records.
    seen: Kinds,
    /// Whether records of some robots are missing.
    lacks_robots: bool,
}

/// The verdict on one property.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The property.
    pub property: Name,
    /// How often it was violated.
    pub violations: usize,
    /// The first time.
    pub first: Option<Violation>,
    /// Whether it is open: not violated, with a deadline that has not passed.
    pub open: bool,
    /// Whether the property applies: that of an unused primitive does not.
    pub used: bool,
    /// Whether records of all kinds came that it is judged by.
    pub has_evidence: bool,
    /// Whether a deadline was pending, so that it could still be violated.
    pub owed: bool,
    /// Whether it was judged until the last record.
    pub to_the_end: bool,
    /// How often something was excused that speaks against it, by reason.
    pub excused: Vec<(Excuse, u64)>,
}

impl Watch {
    /// These checkers, before the first record.
    pub fn new(checkers: Vec<Box<dyn Checker>>) -> Watch {
        Watch {
            checkers,
            ..Watch::default()
        }
    }

    /// One more that watches; to be called before the run begins.
    pub fn add_monitor(&mut self, monitor: Box<dyn Monitor>) {
        self.monitors.push(monitor);
    }

    /// How many monitors there are.
    pub fn monitors(&self) -> usize {
        self.monitors.len()
    }

    /// Whether the monitor with this index is open.
    pub fn is_open(&self, monitor: usize) -> bool {
        let monitor = &self.monitors[monitor];
        (0..monitor.properties().len()).any(|property| monitor.is_open(property))
    }

    /// From now on the records of some robots are missing. Checkers that need those of all robots see nothing more.
    pub fn lack_robots(&mut self) {
        self.lacks_robots = true;
    }

    /// Shows the checkers the next records, in the order of their times, until `now`.
    pub fn observe(&mut self, records: &[Record], now: Time) {
        self.kinds.clear();
        self.kinds
            .extend(records.iter().map(|record| Kinds::of(&record.event)));
        self.seen = self.kinds.iter().fold(self.seen, |seen, &kind| seen | kind);
        for record in records {
            if let Event::Primitive { event, .. } = &record.event
                && !self.is_known(event.primitive())
            {
                self.used.push(event.primitive().to_string());
            }
        }
        let lacks_robots = self.lacks_robots;
        let checkers = self.checkers.iter_mut();
        for checker in checkers.filter(|checker| !lacks_robots || checker.bears_missing_robots()) {
            let mut heeds = checker.heeds();
            for (record, &kind) in records.iter().zip(&self.kinds) {
                if heeds.meets(kind) {
                    checker.observe(record, &mut self.violations);
                    heeds = checker.heeds();
                }
            }
            checker.advance(now, &mut self.violations);
        }
    }

    /// Shows the monitors the state of affairs.
    pub fn witness(&mut self, witness: &dyn Witness) {
        for monitor in &mut self.monitors {
            monitor.observe(witness, &mut self.violations);
        }
    }

    /// All violations so far.
    pub fn violations(&self) -> &[Violation] {
        &self.violations
    }

    /// The monitored properties.
    pub fn monitored(&self) -> impl Iterator<Item = Name> {
        let monitors = self.monitors.iter();
        monitors.flat_map(|monitor| monitor.properties())
    }

    /// How often something was excused that speaks against a property, and why.
    pub fn excused(&self) -> Vec<(Name, Excuse, u64)> {
        let checkers = self.checkers.iter();
        let properties = checkers.flat_map(|checker| {
            let properties = checker.properties().iter();
            properties.map(move |&property| (property, checker.excused(property)))
        });
        let counts = properties.flat_map(|(property, counts)| {
            let named = counts.into_iter();
            named.map(move |(excuse, count)| (Name::from(property), excuse, count))
        });
        let monitored = self.monitors.iter().flat_map(|monitor| {
            let properties = monitor.properties().into_iter().enumerate();
            properties.flat_map(|(index, property)| {
                let counts = monitor.excused(index).into_iter();
                counts.map(move |(excuse, count)| (property.clone(), excuse, count))
            })
        });
        counts.chain(monitored).collect()
    }

    /// The verdicts of checkers and monitors on each property.
    pub fn verdicts(&self) -> Vec<Verdict> {
        let checked = self.checkers.iter().flat_map(|checker| {
            let properties = checker.properties().iter();
            properties.map(|&property| {
                let verdict = self.verdict(property.into());
                let used = self.is_used(property) && checker.has_subject(property);
                Verdict {
                    used: used || verdict.used,
                    has_evidence: self.seen.hold(checker.needs(property)),
                    owed: checker.is_owed(property),
                    to_the_end: !self.lacks_robots || checker.bears_missing_robots(),
                    excused: checker.excused(property),
                    ..verdict
                }
            })
        });
        let monitored = self.monitors.iter().flat_map(|monitor| {
            let properties = monitor.properties().into_iter().enumerate();
            properties.map(|(index, property)| {
                let verdict = self.verdict(property);
                Verdict {
                    open: monitor.is_open(index) && verdict.first.is_none(),
                    used: true,
                    excused: monitor.excused(index),
                    ..verdict
                }
            })
        });
        checked.chain(monitored).collect()
    }

    /// Whether the primitive in the name of a checker's property has been used. A name without a primitive is
    /// about the world.
    fn is_used(&self, property: &str) -> bool {
        let primitive = property.split_once('.').map(|(primitive, _)| primitive);
        primitive.is_none_or(|primitive| self.is_known(primitive))
    }

    /// Whether a primitive has reported something.
    fn is_known(&self, primitive: &str) -> bool {
        self.used.iter().any(|used| used == primitive)
    }

    /// The verdict on a property, given its violations.
    fn verdict(&self, property: Name) -> Verdict {
        let mut against = self.violations.iter().filter(|v| v.property == property);
        let first = against.next().cloned();
        let violations = usize::from(first.is_some()) + against.count();
        Verdict {
            property,
            violations,
            open: false,
            used: first.is_some(),
            first,
            has_evidence: true,
            owed: false,
            to_the_end: true,
            excused: Vec::new(),
        }
    }
}
