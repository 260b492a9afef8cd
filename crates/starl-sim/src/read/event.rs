//! Reads `event`: interventions and their times.

use super::fleet::robot_name;
use super::names::Names;
use super::report::{Origin, Report};
use super::schema::KNOB_NAMES;
use super::section::Section;
use super::{fault, obstacle, order, start};
use crate::scenario::{Joins, Moment, Network, Occasion, ScenarioEvent};
use starl_core::intervention::NetworkKnob;
use starl_core::{Duration, Intervention, Order, Point, Pose, Time, WayPoint};

/// The events of a run of this duration, with the robots that join among the names from now on.
pub(super) fn read(
    root: Section<'_>,
    names: &mut Names,
    duration: Duration,
    network: &Network,
) -> Vec<ScenarioEvent> {
    names.joins = joins(root, names.count());
    let mut index = 0;
    let mut changes = Vec::new();
    let events = root.tables("event", |table| {
        let at = table.optional_duration("at").map(|span| Time(span.0));
        // An event at a rate knows only the robots of the start.
        names.moment = at.map_or(Moment::default(), |at| (at, index));
        index += 1;
        let event = event(table, names, duration)?;
        if let Intervention::Network(knobs) = &event.what {
            changes.push(Change {
                at: at.unwrap_or_default(),
                knobs: knobs.clone(),
                is_once: at.is_some(),
                origin: table.origin,
                field: table.path_of(""),
            });
        }
        Some(event)
    });
    names.moment = Moment::default();
    check_changes(changes, network, root.report);
    events.into_iter().flatten().collect()
}

/// The robots that join.
fn joins(root: Section<'_>, fleet: u64) -> Joins {
    let mut index = 0;
    let joins = root.tables("event", |table| {
        index += 1;
        let at = Time(table.optional_duration("at")?.0);
        let is_join = table.choice("kind").as_deref() == Some("join");
        let name = is_join.then(|| table.text("name"))??;
        Some(((at, index - 1), name))
    });
    Joins::new(fleet as usize, joins.into_iter().flatten().collect())
}

/// A change of the network.
struct Change {
    at: Time,
    knobs: Vec<NetworkKnob>,
    is_once: bool,
    origin: Origin,
    field: String,
}

/// Refuses changes after which delays do not go together, each in the network that those before it leave.
fn check_changes(mut changes: Vec<Change>, network: &Network, report: &Report) {
    changes.sort_by_key(|change| change.at);
    let mut network = network.clone();
    for change in changes {
        let mut changed = network.clone();
        change.knobs.iter().for_each(|&knob| changed.turn(knob));
        let sets_jitter = |knob: &NetworkKnob| matches!(knob, NetworkKnob::Jitter(_));
        if let Some(found) = changed
            .link
            .contradiction(change.knobs.iter().any(sets_jitter))
        {
            report.problem_with_help(change.origin, &change.field, found.message, found.help);
        }
        if change.is_once {
            network = changed;
        }
    }
}

/// Names of fields.
type Fields = &'static [&'static str];

/// The fields that a kind of event needs, and those that it may have.
fn fields(kind: &str) -> (Fields, Fields) {
    if let Some(fields) = fault::fields(kind) {
        return fields;
    }
    match kind {
        "push" => (&["robot", "by"], &[]),
        "network" => (&[], KNOB_NAMES),
        "add_obstacle" => (
            &[],
            &["polygon", "circle", "rectangle", "box", "height", "hidden"],
        ),
        "move_obstacle" => (
            &["index"],
            &["polygon", "circle", "rectangle", "box", "height"],
        ),
        "remove_obstacle" => (&["index"], &[]),
        "set_way_point" => (&["name"], &["position", "within", "group"]),
        "set_thing" => (&["name"], &["position", "within"]),
        "remove_way_point" | "remove_thing" => (&["name"], &[]),
        "tell" => (&["order"], &["robots", "fields"]),
        "join" => (&["like", "name", "position"], &["heading"]),
        _ => (&["robots"], &[]),
    }
}

fn event(table: Section<'_>, names: &Names, duration: Duration) -> Option<ScenarioEvent> {
    let kind = table.choice("kind");
    let occasion = occasion(table, duration);
    let kind = kind?;
    let (needed, optional) = fields(&kind);
    fault::check_fields(
        table,
        "an event",
        &kind,
        &["at", "rate", "kind"],
        needed,
        optional,
    );
    if kind == "join" && table.has("rate") {
        let help = "give `at`, and an event for each robot";
        table.problem("rate", "a robot joins only once", help);
    }
    let what = what(table, names, &kind);
    Some(ScenarioEvent {
        occasion: occasion?,
        what: what?.tidy(),
    })
}

fn occasion(table: Section<'_>, duration: Duration) -> Option<Occasion> {
    let (at, rate) = (table.optional_duration("at"), table.optional_number("rate"));
    fault::check_time(table, at, duration);
    if let Some(rate) = rate {
        fault::check_rate(table, "rate", rate, duration, "events");
    }
    match (table.has("at"), table.has("rate")) {
        (true, true) => {
            let help = "leave one of them out";
            table.problem("rate", "the event has a time and a rate", help);
        }
        (false, false) => {
            let help = "give `at = \"5s\"`, or `rate = \"0.1/s\"`";
            let report = table.report;
            report.problem_with_help(table.origin, &table.path_of("at"), "is missing", help);
        }
        (true, false) if table.has("within") => {
            let help = "give `position`, or a `rate` instead of `at`";
            let message = "only events at a rate have random places";
            table.problem("within", message, help);
        }
        _ => {}
    }
    match (at, rate) {
        (Some(at), _) => Some(Occasion::At(Time(at.0))),
        (None, rate) => {
            let within = table.optional_table("within", start::area);
            let within = within.map(|placed| placed.value);
            let per_second = rate?;
            Some(Occasion::Rate { per_second, within })
        }
    }
}

/// Where a thing or waypoint appears; anywhere will do where it is drawn.
fn place(table: Section<'_>, kind: &str) -> Option<Point> {
    match (table.has("position"), table.has("within")) {
        (true, true) => {
            let message = "the places are random within `within`";
            table.problem("position", message, "leave one of them out");
        }
        (false, true) => return Some(Point::ZERO),
        (false, false) => {
            let message = format!("is missing in an event of the kind `{kind}`");
            let help = "give [x, y] or, with a `rate`, `within`";
            table.problem("position", message, help);
        }
        (true, false) => {}
    }
    table.point("position").map(|(position, _)| position)
}

fn what(table: Section<'_>, names: &Names, kind: &str) -> Option<Intervention> {
    if fault::fields(kind).is_some() {
        return fault::kind(table, names, kind).map(Intervention::Fault);
    }
    let index = || table.count("index").map(|index| index as u32);
    let name = || table.text("name");
    Some(match kind {
        "push" => {
            let (robot, by) = (names.robot(table, "robot"), table.point("by"));
            let by = by?.0;
            Intervention::Push { robot: robot?, by }
        }
        "network" => Intervention::Network(knobs(table)?),
        "add_obstacle" => {
            let (obstacle, hidden) = (obstacle::shape(table), table.flag("hidden"));
            let obstacle = obstacle?;
            Intervention::AddObstacle { obstacle, hidden }
        }
        "move_obstacle" => {
            let (index, obstacle) = (index(), obstacle::shape(table));
            let obstacle = obstacle?;
            let index = index?;
            Intervention::MoveObstacle { index, obstacle }
        }
        "remove_obstacle" => Intervention::RemoveObstacle { index: index()? },
        "set_way_point" => {
            let (name, position) = (name(), place(table, kind));
            let group = table.count("group").unwrap_or_default() as u32;
            Intervention::SetWayPoint(WayPoint {
                name: name?,
                position: position?,
                group,
            })
        }
        "remove_way_point" => Intervention::RemoveWayPoint { name: name()? },
        "set_thing" => {
            let (name, position) = (name(), place(table, kind));
            let (name, position) = (name?, position?);
            Intervention::SetThing { name, position }
        }
        "remove_thing" => Intervention::RemoveThing { name: name()? },
        "tell" => {
            let robots = names.optional_robots(table, "robots").unwrap_or_default();
            let (name, fields) = (table.text("order"), order::fields(table, names));
            let name = name?.into();
            let order = Order { name, fields };
            Intervention::Tell { robots, order }
        }
        "join" => {
            let (like, name) = (names.robot(table, "like"), robot_name(table));
            let (position, heading) = (table.point("position"), table.number("heading"));
            Intervention::Join {
                like: like?,
                name: name?,
                pose: Pose::level(position?.0, heading),
            }
        }
        "leave" => Intervention::Leave(names.robots(table, "robots")),
        _ => return None,
    })
}

/// The changes of the network that are written.
fn knobs(table: Section<'_>) -> Option<Vec<NetworkKnob>> {
    let knobs = Network::read_knobs(table);
    if !KNOB_NAMES.iter().any(|name| table.is_written(name)) {
        let (message, help) = (
            "the event changes nothing of the network",
            "give `loss`, `delay` or any other field of [network] but `link`",
        );
        let report = table.report;
        report.problem_with_help(table.origin, &table.path_of(""), message, help);
    }
    (!knobs.is_empty()).then_some(knobs)
}
