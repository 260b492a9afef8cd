//! Judges properties as the run proceeds: finds the robots that have started, evaluates the properties and returns the
//! verdicts.

use super::evaluation::Evaluation;
use super::excuse::Excuse;
use super::fleet::Fleet;
use super::history::{History, Row, UNKNOWN};
use super::host::{Counted, PropertyHost};
use super::reads::Reads;
use super::violation::Violation;
use crate::machine::{Claim, Property};
use crate::robot::code::Code;
use crate::robot::workbench::Workbench;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Duration, RobotId, Time};

/// The status of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It holds; for an invariant, so far.
    Holds,
    /// A condition that it demands is still false, and its deadline has not passed.
    Open,
    /// It is violated.
    Violated,
}

/// After this time, a restarted robot has recovered the state that it must remember from the others.
const REMEMBERS: Duration = Duration::from_seconds(10);

/// Judges the properties of one program.
#[derive(Clone)]
pub struct Judge {
    code: Code,
    histories: Vec<History>,
    bench: Workbench,
    /// The last time at which each robot was down.
    down: BTreeMap<RobotId, Time>,
    /// Whether at some moment at most half of the robots were up and had recovered their memory.
    lost_majority: bool,
    /// The robots that have started.
    roster: Row,
    /// The versions of their states; [`UNKNOWN`] where they are not known.
    versions: Vec<u64>,
}

impl Judge {
    /// A judge of this program's properties that has not seen a state yet.
    pub fn new(code: &Code) -> Judge {
        let bytecode = code.program().bytecode();
        let history = |property: &Property| History {
            reads: Reads::of(bytecode, property.claim),
            ..History::default()
        };
        Judge {
            histories: bytecode.properties.iter().map(history).collect(),
            bench: Workbench::default(),
            roster: Row::new(),
            down: BTreeMap::new(),
            lost_majority: false,
            versions: Vec::new(),
            code: code.clone(),
        }
    }

    /// The program whose properties are judged.
    pub fn code(&self) -> &Code {
        &self.code
    }

    /// The properties, in the order of the text.
    pub fn properties(&self) -> &[Property] {
        &self.code.program().bytecode().properties
    }

    /// Observes the fleet at a moment no earlier than the previous one; time counts from the start of the run. Returns
    /// the violations that have not been reported.
    pub fn observe(&mut self, now: Time, fleet: &dyn Fleet) -> Vec<Violation> {
        let mut violations = Vec::new();
        self.find_started(fleet);
        self.count_majority(now, fleet);
        let bytecode = self.code.program().bytecode();
        for ((index, property), history) in bytecode
            .properties
            .iter()
            .enumerate()
            .zip(&mut self.histories)
        {
            let mut evaluation = Evaluation {
                host: PropertyHost {
                    counted: counted(property),
                    has_majority: !self.lost_majority,
                    ..PropertyHost::new(&self.code, fleet, now, &self.roster, &mut self.bench.memo)
                },
                workspace: &mut self.bench.workspace,
                versions: &self.versions,
                property,
                index,
                history,
                violations: &mut violations,
            };
            evaluation.run();
        }
        violations
    }

    /// Checks whether a majority of the robots is up.
    fn count_majority(&mut self, now: Time, fleet: &dyn Fleet) {
        for &robot in fleet.robots() {
            if !fleet.is_up(robot) {
                self.down.insert(robot, now);
            }
        }
        let is_back = |down: &Time| now.since(*down) >= REMEMBERS;
        self.down.retain(|_, down| !is_back(down));
        self.lost_majority |= !self.down.is_empty() && 2 * self.down.len() >= fleet.robots().len();
    }

    /// Finds the robots that have started, and their states.
    fn find_started(&mut self, fleet: &dyn Fleet) {
        let robots = fleet.robots().iter().copied();
        let started = || {
            robots
                .clone()
                .filter(|robot| fleet.state_of(*robot).is_some())
        };
        if !started().eq(self.roster.iter().copied()) {
            let before = core::mem::replace(&mut self.roster, started().collect());
            for history in &mut self.histories {
                history.rearrange(&before, &self.roster);
            }
        }
        self.versions.clear();
        let versions = self.roster.iter().map(|&robot| fleet.version(robot));
        self.versions
            .extend(versions.map(|version| version.unwrap_or(UNKNOWN)));
    }

    /// How often a property was false for some robots and excused, by reason.
    pub fn excused(&self, property: usize) -> impl Iterator<Item = (Excuse, u64)> + '_ {
        let histories = self.histories.get(property).into_iter();
        histories.flat_map(|history| {
            history
                .excused
                .iter()
                .map(|(excuse, count)| (*excuse, *count))
        })
    }

    /// The status of a property, by its index in [`Judge::properties`].
    pub fn standing(&self, property: usize) -> Standing {
        let Some(history) = self.histories.get(property) else {
            return Standing::Holds;
        };
        let claim = self.properties().get(property).map(|p| p.claim);
        let is_open = match claim {
            Some(Claim::Eventually { .. }) => history.lacks || !history.judged,
            _ => !history.waiting.is_empty(),
        };
        match (history.violated.is_empty(), is_open) {
            (false, _) => Standing::Violated,
            (true, true) => Standing::Open,
            (true, false) => Standing::Holds,
        }
    }

    /// The status of a property for one row of robots.
    pub fn standing_of(&self, property: usize, robots: &[RobotId]) -> Standing {
        let claim = self.properties().get(property).map(|p| p.claim);
        match self.histories.get(property) {
            Some(history) if history.violated.contains(robots) => Standing::Violated,
            Some(history) if history.waiting.contains_key(robots) => Standing::Open,
            Some(history)
                if matches!(claim, Some(Claim::Eventually { .. }))
                    && !history.settled.contains(robots) =>
            {
                Standing::Open
            }
            _ => Standing::Holds,
        }
    }
}

/// The robots for which a property is judged. Robots that are down are not judged, and no eventual condition is
/// demanded of a robot whose target is blocked by a wreck.
fn counted(property: &Property) -> Counted {
    match property.claim {
        _ if property.is_despite_crashes => Counted::All,
        Claim::Always(_) => Counted::Up,
        _ => Counted::Able,
    }
}
