//! Reads `fault` and `fault_rates`.

use super::names::Names;
use super::section::Section;
use crate::scenario::{Fault, FaultKind, FaultRates, Faults};
use starl_core::{Duration, Time};

/// What breaks during a run of this duration, and when.
pub(super) fn read(root: Section<'_>, names: &Names, duration: Duration) -> Faults {
    let schedule = root.tables("fault", |table| fault(table, names, duration));
    let rates = root.table("fault_rates", |table| rates(table, names.count(), duration));
    Faults {
        schedule: schedule.into_iter().flatten().collect(),
        rates,
    }
}

/// A run whose rates promise more faults than this is refused: they are drawn before it starts.
const MOST_FAULTS: f64 = 1e6;

fn rates(table: Section<'_>, robots: u64, duration: Duration) -> FaultRates {
    let rate = |field: &str, subjects: u64| {
        let rate = table.number(field);
        let expected = rate * subjects as f64 * duration.seconds();
        if expected > MOST_FAULTS {
            let message = format!("brings about some {expected:.0} faults in {duration}");
            table.problem(
                field,
                message,
                "give a rate that brings about at most a million",
            );
        }
        rate
    };
    FaultRates {
        crash: rate("crash", robots),
        restart_after: table
            .optional_duration("restart_after")
            .unwrap_or(Duration::ZERO),
        partition: rate("partition", 1),
        heal_after: table.duration("heal_after"),
        stuck_motor: rate("stuck_motor", robots),
        frozen_sensor: rate("frozen_sensor", robots),
        repair_after: table.duration("repair_after"),
        corrupt_state: rate("corrupt_state", robots),
    }
}

fn fault(table: Section<'_>, names: &Names, duration: Duration) -> Option<Fault> {
    let at = table.optional_duration("at");
    let kind = table.choice("kind");
    if let Some(at) = at
        && at >= duration
    {
        let message = format!("this is not before the run ends, at {duration}");
        table.problem(
            "at",
            message,
            "let it happen earlier, or make the `duration` longer",
        );
    }
    let kind = kind?;
    let (robots, groups) = match kind.as_str() {
        "partition" => (false, true),
        "heal" => (false, false),
        _ => (true, false),
    };
    for (field, wanted) in [("robots", robots), ("groups", groups)] {
        match (table.has(field), wanted) {
            (true, false) => {
                let message = format!("a fault of kind `{kind}` takes no `{field}`");
                table.problem(field, message, "leave it out");
            }
            (false, true) => {
                let message = format!("is missing: a fault of kind `{kind}` needs it");
                table.problem(field, message, "name robots, or groups of them");
            }
            _ => {}
        }
    }
    let some = || names.robots(table, "robots");
    let kind = match kind.as_str() {
        "crash" => FaultKind::Crash(some()),
        "restart" => FaultKind::Restart(some()),
        "partition" => FaultKind::Partition(names.parts(table, "groups")),
        "heal" => FaultKind::Heal,
        "stuck_motor" => FaultKind::StuckMotor(some()),
        "frozen_sensor" => FaultKind::FrozenSensor(some()),
        "repair" => FaultKind::Repair(some()),
        "corrupt_state" => FaultKind::CorruptState(some()),
        _ => return None,
    };
    Some(Fault {
        at: Time(at?.0),
        kind,
    })
}
