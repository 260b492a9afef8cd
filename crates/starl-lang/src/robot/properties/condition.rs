//! A condition over robots, evaluated at one moment: for breakpoints and other observers that wait for it.

use super::evaluation::limits;
use super::fleet::Fleet;
use super::host::PropertyHost;
use crate::machine::{Claim, Fault, Machine};
use crate::robot::code::Code;
use crate::robot::workbench::Workbench;
use alloc::vec::Vec;
use starl_core::{RobotId, Time};

/// The condition of a program's last property, evaluated at any moment by itself.
#[derive(Clone)]
pub struct Condition {
    code: Code,
    /// The function of kind property.
    function: u32,
    /// Whether it is about each robot by itself, not about the fleet.
    is_of_each: bool,
    bench: Workbench,
}

impl Condition {
    /// The condition of the program's last property; none if that is not an `eventually`, or is about several robots at
    /// once.
    pub fn new(code: &Code) -> Option<Condition> {
        let property = code.program().bytecode().properties.last()?;
        let Claim::Eventually { holds, .. } = property.claim else {
            return None;
        };
        (property.robots <= 1).then(|| Condition {
            code: code.clone(),
            function: holds,
            is_of_each: property.robots == 1,
            bench: Workbench::default(),
        })
    }

    /// Whether it is true of each robot that has started, in ascending order; without a robot if it is about the fleet.
    /// An error says why evaluating it fails.
    pub fn ask(
        &mut self,
        now: Time,
        fleet: &dyn Fleet,
    ) -> Vec<(Option<RobotId>, Result<bool, Fault>)> {
        let robots = fleet.robots().iter().copied();
        let roster: Vec<RobotId> = robots
            .filter(|&robot| fleet.state_of(robot).is_some())
            .collect();
        let rows: Vec<Option<RobotId>> = match self.is_of_each {
            true => roster.iter().copied().map(Some).collect(),
            false => Vec::from([None]),
        };
        let memo = &mut self.bench.memo;
        let mut host = PropertyHost::new(&self.code, fleet, now, &roster, memo);
        let mut asked = Vec::with_capacity(rows.len());
        for row in rows {
            host.first = row;
            let truth = Machine::holds(
                self.code.program(),
                self.function,
                row.as_slice(),
                &mut self.bench.workspace,
                &mut host,
                limits(roster.len()),
            );
            asked.push((row, truth.map_err(|error| error.fault)));
        }
        asked
    }
}
