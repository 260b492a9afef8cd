//! Reads `fault` and `fault_rates`.

use super::names::Names;
use super::schema::Kind;
use super::section::Section;
use crate::fields::FieldTable;
use crate::scenario::{Fault, FaultKind, FaultRates, Faults};
use starl_core::{Duration, Time};

/// The faults of a run of this duration, with their times.
pub(super) fn read(root: Section<'_>, names: &Names, duration: Duration) -> Faults {
    let schedule = root.tables("fault", |table| fault(table, names, duration));
    let rates = root.table("fault_rates", |table| rates(table, names.count(), duration));
    Faults {
        schedule: schedule.into_iter().flatten().collect(),
        rates,
    }
}

/// A run whose rates promise more faults or events than this is refused: they are drawn before it starts.
const MOST: f64 = 1e6;

/// Refuses a rate that brings about too much of something.
pub(super) fn check_rate(
    table: Section<'_>,
    field: &str,
    per_second: f64,
    duration: Duration,
    what: &str,
) {
    let expected = per_second * duration.seconds();
    if expected > MOST {
        let message = format!("brings about some {expected:.0} {what} in {duration}");
        let help = "give a rate that brings about at most a million";
        table.problem(field, message, help);
    }
}

fn rates(table: Section<'_>, robots: u64, duration: Duration) -> FaultRates {
    let rates = FaultRates::read(table);
    for (field, rate, subjects) in [
        ("crash", rates.crash, robots),
        ("partition", rates.partition, 1),
        ("stuck_motor", rates.stuck_motor, robots),
        ("frozen_sensor", rates.frozen_sensor, robots),
        ("corrupt_state", rates.corrupt_state, robots),
    ] {
        check_rate(table, field, rate * subjects as f64, duration, "faults");
    }
    rates
}

fn fault(table: Section<'_>, names: &Names, duration: Duration) -> Option<Fault> {
    let at = table.optional_duration("at");
    let word = table.choice("kind");
    check_time(table, at, duration);
    let word = word?;
    let (needed, optional) = fields(&word)?;
    check_fields(table, "a fault", &word, &["at", "kind"], needed, optional);
    let kind = kind(table, names, &word)?;
    Some(Fault {
        at: Time(at?.0),
        kind,
    })
}

/// Refuses what would happen only after a run of this duration.
pub(super) fn check_time(table: Section<'_>, at: Option<Duration>, duration: Duration) {
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
}

/// The required and the optional fields of a kind of fault; none if it is not a fault.
pub(super) fn fields(kind: &str) -> Option<(&'static [&'static str], &'static [&'static str])> {
    match kind {
        "partition" | "one_way" => Some((&["groups"], &[])),
        "heal" => Some((&[], &[])),
        "crash" | "restart" | "stuck_motor" | "frozen_sensor" | "repair" | "corrupt_state" => {
            Some((&["robots"], &[]))
        }
        _ => None,
    }
}

/// Refuses fields that `what` of a kind does not take, and asks for those that it needs.
pub(super) fn check_fields(
    table: Section<'_>,
    what: &str,
    kind: &str,
    common: &[&str],
    needed: &[&str],
    optional: &[&str],
) {
    for field in table.names().filter(|field| !common.contains(field)) {
        let is_needed = needed.contains(&field);
        if table.is_written(field) && !is_needed && !optional.contains(&field) {
            let message = format!("{what} of the kind `{kind}` has no `{field}`");
            table.problem(field, message, "remove it");
        } else if is_needed && !table.has(field) {
            let message = format!("is missing in {what} of the kind `{kind}`");
            let help = match table.field(field).kind {
                Kind::Robots | Kind::RobotGroups => "name robots, or groups of them".to_string(),
                kind => format!("give a value: {}", kind.describe()),
            };
            table.problem(field, message, help);
        }
    }
}

/// The fault of a kind.
pub(super) fn kind(table: Section<'_>, names: &Names, kind: &str) -> Option<FaultKind> {
    let some = || names.robots(table, "robots");
    Some(match kind {
        "crash" => FaultKind::Crash(some()),
        "restart" => FaultKind::Restart(some()),
        "partition" => FaultKind::Partition(names.parts(table, "groups")),
        "one_way" => FaultKind::OneWay(names.parts(table, "groups")),
        "heal" => FaultKind::Heal,
        "stuck_motor" => FaultKind::StuckMotor(some()),
        "frozen_sensor" => FaultKind::FrozenSensor(some()),
        "repair" => FaultKind::Repair(some()),
        "corrupt_state" => FaultKind::CorruptState(some()),
        _ => return None,
    })
}
