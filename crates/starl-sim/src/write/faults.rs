//! Writes `fault` and `fault_rates`.

use super::fleet::names;
use super::table::{Table, list, text, time};
use crate::fields::FieldTable;
use crate::scenario::{Fault, FaultKind, Faults, Fleet};
use starl_core::{Duration, RobotId, Time};

/// The faults in a run of this duration.
pub(super) fn write(faults: &Faults, fleet: &Fleet, duration: Duration) -> String {
    let Faults { schedule, rates } = faults;
    let happens = |fault: &&Fault| fault.at < Time::ZERO + duration;
    let schedule = schedule.iter().filter(happens);
    let mut out: String = schedule.map(|entry| fault(entry, fleet)).collect();
    out += &rates.write("fault_rates");
    out
}

fn fault(fault: &Fault, fleet: &Fleet) -> String {
    let Fault { at, kind } = fault;
    let mut table = Table::element("fault");
    table.set("at", time(Duration(at.0)));
    if kind.robots().is_some_and(<[RobotId]>::is_empty) {
        // A fault without robots has no effect.
        return String::new();
    }
    set_kind(&mut table, kind, |robots| names(fleet, robots));
    table.finish_element()
}

/// The word for a kind of fault.
fn word(kind: &FaultKind) -> &'static str {
    match kind {
        FaultKind::Crash(_) => "crash",
        FaultKind::Restart(_) => "restart",
        FaultKind::StuckMotor(_) => "stuck_motor",
        FaultKind::FrozenSensor(_) => "frozen_sensor",
        FaultKind::Repair(_) => "repair",
        FaultKind::CorruptState(_) => "corrupt_state",
        FaultKind::Partition(_) => "partition",
        FaultKind::OneWay(_) => "one_way",
        FaultKind::Heal => "heal",
    }
}

/// The fields of a fault.
pub(super) fn set_kind(table: &mut Table, kind: &FaultKind, names: impl Fn(&[RobotId]) -> String) {
    table.set("kind", text(word(kind)));
    if let Some(robots) = kind.robots() {
        table.set("robots", names(robots));
    }
    if let FaultKind::Partition(groups) | FaultKind::OneWay(groups) = kind {
        let manned = groups.iter().filter(|group| !group.is_empty());
        table.set("groups", list(manned.map(|group| names(group))));
    }
}
