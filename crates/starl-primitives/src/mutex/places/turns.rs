//! Robots that are seen near the places and say nothing: when others go without their permission.
//!
//! Such a robot has failed, or the network is in parts. In the second case it may think the same of the others, so two
//! robots must never go at once without each other's permission. Both know when the later of them arrived: the
//! one that arrived later goes at once, and after that they take turns of one patience each, the one with the lesser number
//! first. Before each turn there is time to see the other go.

use super::{Mutex, Places};
use crate::sight::Sighting;
use alloc::collections::BTreeSet;
use starl_core::{Duration, Robot, RobotId};

/// The part of a turn in which its robot may go.
const SHARE: f64 = 0.8;

impl Places {
    /// The robots that are seen near the places: in them, or about to ask for them.
    pub fn near(&self, robot: &Robot<'_>) -> impl Iterator<Item = (RobotId, &Sighting)> {
        let me = robot.id();
        self.sight.iter().filter(move |(other, sighting)| {
            let mut areas = self.areas.values();
            *other != me && areas.any(|area| area.distance(sighting.at) < self.options.near)
        })
    }

    /// Whether the robot may go without another that has stood there in silence. A robot that has not moved since it
    /// started does not know for how long it has stood.
    fn goes_without(&self, robot: &Robot<'_>, other: RobotId, sighting: &Sighting) -> bool {
        let (patience, now) = (self.options.patience, robot.now());
        let Some(own) = self.own.filter(|own| own.has_moved) else {
            return false;
        };
        if patience.is_zero() || now.since(sighting.since) < patience {
            return false;
        }
        let stood = now.since(own.since.max(sighting.since));
        let turn = stood.0 / patience.0;
        let is_first = robot.id() < other;
        let is_own = turn == 0 || (turn % 2 == 1) == is_first;
        is_own && ((stood.0 % patience.0) as f64) < SHARE * patience.0 as f64
    }
}

impl Mutex {
    /// The robots whose permission is needed: all that take part, and those that are seen near the places, which may
    /// take part unheard, but for silent ones that the robot may go without.
    pub(super) fn to_ask(&self, places: &Places, robot: &Robot<'_>) -> BTreeSet<RobotId> {
        let suspects = &self.common.suspects;
        let near = places.near(robot);
        let asked = near.filter(|(other, sighting)| {
            !suspects.contains(other) || !places.goes_without(robot, *other, sighting)
        });
        let asked = asked.map(|(other, _)| other);
        match &places.members {
            Some(members) => members.iter().copied().chain(asked).collect(),
            None => robot.fleet().iter().copied().chain(asked).collect(),
        }
    }

    /// Whether no robot near the places may go without this one while this one goes without its permission. A robot that
    /// was left out must be silent still. One that came later asks this robot, if it hears it, or if neither has
    /// stood for long.
    pub(super) fn is_agreed(&self, places: &Places, robot: &Robot<'_>) -> bool {
        let (Some(asked), Some(own)) = (&places.asked, places.own) else {
            return true;
        };
        let Places { options, .. } = places;
        let soon = Duration((SHARE * options.patience.0 as f64) as u64);
        places.near(robot).all(|(other, sighting)| {
            let is_silent = self.common.suspects.contains(&other);
            let is_member = match &places.members {
                Some(members) => members.contains(&other),
                None => robot.fleet().contains(&other),
            };
            let goes_without = || places.goes_without(robot, other, sighting);
            if asked.asked.contains(&other) {
                true
            } else if asked.left_out.contains(&other) {
                is_silent && !is_member && goes_without()
            } else {
                let first = own.since.min(sighting.since);
                let both_came = own.has_moved && robot.now().since(first) < soon;
                is_member && !is_silent || both_came || goes_without()
            }
        })
    }
}
