//! Writes `fault` and `fault_rates`.

use super::fleet::names;
use super::table::{Table, list, quantity, text, time};
use crate::scenario::{Fault, FaultKind, FaultRates, Faults, Fleet};
use starl_core::{Duration, RobotId, Time};

/// What breaks in a run of this duration.
pub(super) fn write(faults: &Faults, fleet: &Fleet, duration: Duration) -> String {
    let Faults { schedule, rates } = faults;
    let happens = |fault: &&Fault| fault.at < Time::ZERO + duration;
    let schedule = schedule.iter().filter(happens);
    let mut out: String = schedule.map(|entry| fault(entry, fleet)).collect();
    out += &self::rates(rates);
    out
}

fn fault(fault: &Fault, fleet: &Fleet) -> String {
    let Fault { at, kind } = fault;
    let mut table = Table::element("fault");
    table.set("at", time(Duration(at.0)));
    let (word, robots) = match kind {
        FaultKind::Crash(robots) => ("crash", robots),
        FaultKind::Restart(robots) => ("restart", robots),
        FaultKind::StuckMotor(robots) => ("stuck_motor", robots),
        FaultKind::FrozenSensor(robots) => ("frozen_sensor", robots),
        FaultKind::Repair(robots) => ("repair", robots),
        FaultKind::CorruptState(robots) => ("corrupt_state", robots),
        FaultKind::Partition(groups) => {
            let manned = groups.iter().filter(|group| !group.is_empty());
            let groups: Vec<String> = manned.map(|group| names(fleet, group)).collect();
            table.set("kind", text("partition"));
            table.set("groups", list(groups));
            return table.finish_element();
        }
        FaultKind::Heal => {
            table.set("kind", text("heal"));
            return table.finish_element();
        }
    };
    set_robots(table, word, fleet, robots)
}

/// A fault of nobody is none.
fn set_robots(mut table: Table, word: &str, fleet: &Fleet, robots: &[RobotId]) -> String {
    if robots.is_empty() {
        return String::new();
    }
    table.set("kind", text(word));
    table.set("robots", names(fleet, robots));
    table.finish_element()
}

fn rates(rates: &FaultRates) -> String {
    let FaultRates {
        crash,
        restart_after,
        partition,
        heal_after,
        stuck_motor,
        frozen_sensor,
        repair_after,
        corrupt_state,
    } = *rates;
    let default = FaultRates::default();
    let rate = |rate: f64| quantity(rate, "/s");
    let mut table = Table::named("fault_rates");
    table.differing("crash", crash, 0.0, rate);
    table.differing("restart_after", restart_after, Duration::ZERO, time);
    table.differing("partition", partition, 0.0, rate);
    table.differing("heal_after", heal_after, default.heal_after, time);
    table.differing("stuck_motor", stuck_motor, 0.0, rate);
    table.differing("frozen_sensor", frozen_sensor, 0.0, rate);
    table.differing("repair_after", repair_after, default.repair_after, time);
    table.differing("corrupt_state", corrupt_state, 0.0, rate);
    table.finish()
}
