//! The lives that may add messages at some place of the log, and the last message of each.
//!
//! Invariant: a roll follows from the log up to its place alone, and so is the same on all robots. A message enters the
//! log only on behalf of a life that votes there, and with a greater number than the last of that life. A life that is
//! replaced never votes again, so its row is dropped with it: proposals of it that arrive later have no row and are
//! rejected, however late they arrive and whichever robot leads. Other rows are never dropped.

use super::life::Life;
use super::packet::What;
use alloc::vec::Vec;
use starl_core::RobotId;

/// One row for each voter, in the order of robots.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Roll(Vec<(Life, u32)>);

impl Roll {
    /// These voters, and the number of the last message of each.
    pub fn new(rows: Vec<(Life, u32)>) -> Roll {
        Roll(rows)
    }

    pub fn rows(&self) -> &[(Life, u32)] {
        &self.0
    }

    /// Whether these are its voters.
    pub fn is_of(&self, voters: &[Life]) -> bool {
        self.0.iter().map(|row| &row.0).eq(voters)
    }

    /// The life of a robot that votes, and the number of its last message.
    pub fn of(&self, robot: RobotId) -> Option<(Life, u32)> {
        let row = self.place(robot)?;
        self.0.get(row).copied()
    }

    /// The number of the last message of a life; none where it does not vote.
    pub fn last(&self, life: Life) -> Option<u32> {
        let row = self.of(life.robot).filter(|row| row.0 == life);
        row.map(|(_, last)| last)
    }

    /// The place after one more entry.
    pub fn advance(&mut self, what: &What) {
        match what {
            What::Start => {}
            What::Voters(voters) => {
                let row = |life: &Life| (*life, self.last(*life).unwrap_or(0));
                self.0 = voters.iter().map(row).collect();
            }
            What::Message { from, number, .. } => {
                if let Some(row) = self.place(*from).and_then(|row| self.0.get_mut(row)) {
                    row.1 = *number;
                }
            }
        }
    }

    fn place(&self, robot: RobotId) -> Option<usize> {
        self.0.binary_search_by_key(&robot, |row| row.0.robot).ok()
    }
}
