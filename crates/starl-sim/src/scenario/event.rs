//! Events of a run besides faults: things and waypoints appear, operators send orders, the world changes.

use super::Bounds;
use starl_core::{Intervention, RobotId, Time};

/// An event of a scenario. One that is not valid ([`Intervention::is_valid`]) does not take place.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioEvent {
    /// When it takes place.
    pub occasion: Occasion,
    /// The intervention.
    pub what: Intervention,
}

/// When an event takes place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Occasion {
    /// Once, at this time.
    At(Time),
    /// Again and again at random times, drawn from the seed as a Poisson process. Things and waypoints get
    /// the number of the occasion appended to their names.
    Rate {
        /// Occasions per second.
        per_second: f64,
        /// Things and waypoints appear at random places in this rectangle; at one place if there is none.
        within: Option<Bounds>,
    },
}

/// The moment of an event: its time, and its place in the scenario's list. Events take place in this order.
pub(crate) type Moment = (Time, usize);

/// The robots that join by events on schedule, in the order in which they get their numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Joins {
    /// The number of the first.
    first: u32,
    list: Vec<(Moment, String)>,
}

impl Joins {
    /// Robots that join a fleet of this size under these names.
    pub fn new(fleet: usize, mut list: Vec<(Moment, String)>) -> Joins {
        list.sort_by_key(|(moment, _)| *moment);
        let first = fleet as u32;
        Joins { first, list }
    }

    /// How many have joined before a moment.
    pub fn count(&self, before: Moment) -> u32 {
        self.list.partition_point(|(moment, _)| *moment < before) as u32
    }

    /// The last that has joined under a name before a moment.
    pub fn find(&self, name: &str, before: Moment) -> Option<RobotId> {
        let joined = &self.list[..self.count(before) as usize];
        let place = joined.iter().rposition(|(_, known)| known == name)?;
        Some(RobotId(self.first + place as u32))
    }

    /// A robot's name.
    pub fn name(&self, robot: RobotId) -> Option<&str> {
        let place = robot.0.checked_sub(self.first)?;
        self.list.get(place as usize).map(|(_, name)| name.as_str())
    }

    /// When a robot of this name joins first.
    pub fn first(&self, name: &str) -> Option<Time> {
        let mut list = self.list.iter();
        list.find(|(_, known)| known == name)
            .map(|((at, _), _)| *at)
    }
}
