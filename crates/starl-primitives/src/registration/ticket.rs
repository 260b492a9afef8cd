//! Tickets name the registrations of a robot in their order, so that late messages about an earlier one are recognised.
//!
//! Invariant: a registration that is known to be over stays over, whatever arrives later, for the last lives of each
//! robot.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::RobotId;

/// One registration of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Ticket {
    /// Drawn at random for each life of the robot.
    pub life: u32,
    /// Counts the registrations of that life.
    pub number: u32,
}

/// As many lives of each robot are remembered. A message that is late by more restarts than this is believed, until its
/// sender denies it.
const MOST_LIVES: usize = 4;

/// The registrations that are over: for each robot and life the first number that may not be.
#[derive(Clone, Debug, Default)]
pub(super) struct Past {
    lives: BTreeMap<RobotId, Vec<Ticket>>,
}

impl Past {
    pub fn is_over(&self, robot: RobotId, ticket: Ticket) -> bool {
        let lives = self.lives.get(&robot).into_iter().flatten();
        let mut same = lives.filter(|first| first.life == ticket.life);
        same.any(|first| ticket.number < first.number)
    }

    /// A robot has had this registration: its earlier ones are over.
    pub fn begins(&mut self, robot: RobotId, ticket: Ticket) {
        let lives = self.lives.entry(robot).or_default();
        let same = lives.iter().position(|first| first.life == ticket.life);
        let known = same.map_or(0, |place| lives.remove(place).number);
        let number = ticket.number.max(known);
        lives.insert(0, Ticket { number, ..ticket });
        lives.truncate(MOST_LIVES);
    }

    /// This registration is over.
    pub fn ends(&mut self, robot: RobotId, ticket: Ticket) {
        let number = ticket.number.saturating_add(1);
        self.begins(robot, Ticket { number, ..ticket });
    }
}
