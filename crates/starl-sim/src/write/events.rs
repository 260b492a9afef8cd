//! Writes `event`.

use super::faults::set_kind;
use super::table::{Table, flag, list, number, planar, quantity, spatial, text, time};
use super::world::set_shape;
use crate::read::is_quantity;
use crate::scenario::{Bounds, Fleet, Joins, Moment, Network, Occasion, ScenarioEvent};
use starl_core::event::Value;
use starl_core::{Duration, Intervention, Order, RobotId, Time, WayPoint};

/// The events of a run of this duration that can take place.
pub(super) fn write(events: &[ScenarioEvent], fleet: &Fleet, duration: Duration) -> String {
    let happens = |event: &&ScenarioEvent| match event.occasion {
        Occasion::At(at) => at < Time::ZERO + duration && event.what.is_valid(),
        Occasion::Rate { per_second, .. } => per_second > 0.0 && event.what.is_valid(),
    };
    let events: Vec<&ScenarioEvent> = events.iter().filter(happens).collect();
    let join = |(index, event): (usize, &&ScenarioEvent)| match (&event.what, event.occasion) {
        (Intervention::Join { name, .. }, Occasion::At(at)) => Some(((at, index), name.clone())),
        _ => None,
    };
    let joins = events.iter().enumerate().filter_map(join).collect();
    let mut names = Names {
        fleet,
        joins: Joins::new(fleet.len(), joins),
        moment: Moment::default(),
    };
    let mut out = String::new();
    for (index, event) in events.into_iter().enumerate() {
        names.moment = match event.occasion {
            Occasion::At(at) => (at, index),
            Occasion::Rate { .. } => Moment::default(),
        };
        out += &self::event(event, &names);
    }
    out
}

/// The names of robots at a moment.
struct Names<'a> {
    fleet: &'a Fleet,
    joins: Joins,
    moment: Moment,
}

impl Names<'_> {
    fn one(&self, robot: RobotId) -> String {
        let name = match self.joins.name(robot) {
            Some(name) => name.to_string(),
            None => self.fleet.name(robot),
        };
        let is_latest = match self.joins.find(&name, self.moment) {
            Some(found) => found == robot,
            None => robot.index() < self.fleet.len(),
        };
        match is_latest {
            true => text(&name),
            false => text(&format!("#{robot}")),
        }
    }

    fn several(&self, robots: &[RobotId]) -> String {
        list(robots.iter().map(|&robot| self.one(robot)))
    }
}

fn event(event: &ScenarioEvent, names: &Names<'_>) -> String {
    let ScenarioEvent { occasion, what } = event;
    let mut table = Table::element("event");
    let mut is_drawn = false;
    match *occasion {
        Occasion::At(at) => table.set("at", time(Duration(at.0))),
        Occasion::Rate { per_second, within } => {
            table.set("rate", quantity(per_second, "/s"));
            let appears = matches!(
                what,
                Intervention::SetThing { .. } | Intervention::SetWayPoint(_)
            );
            if let Some(Bounds { low, high }) = within.filter(|_| appears) {
                let (low, high) = (planar(low), planar(high));
                table.set("within", format!("{{ low = {low}, high = {high} }}"));
                is_drawn = true;
            }
        }
    }
    let what = what.clone().tidy();
    let mut kind = |word: &str| table.set("kind", text(word));
    match &what {
        Intervention::Fault(fault) => set_kind(&mut table, fault, |robots| names.several(robots)),
        Intervention::Push { robot, by } => {
            kind("push");
            table.set("robot", names.one(*robot));
            table.set("by", spatial(*by));
        }
        Intervention::Network(knobs) => {
            kind("network");
            knobs
                .iter()
                .for_each(|&knob| Network::write_knob(&mut table, knob));
        }
        Intervention::AddObstacle { obstacle, hidden } => {
            kind("add_obstacle");
            set_shape(&mut table, obstacle);
            table.differing("hidden", *hidden, false, flag);
        }
        Intervention::MoveObstacle { index, obstacle } => {
            kind("move_obstacle");
            table.set("index", index.to_string());
            set_shape(&mut table, obstacle);
        }
        Intervention::RemoveObstacle { index } => {
            kind("remove_obstacle");
            table.set("index", index.to_string());
        }
        Intervention::SetWayPoint(way_point) => {
            let WayPoint {
                name,
                position,
                group,
            } = way_point;
            kind("set_way_point");
            table.set("name", text(name));
            if !is_drawn {
                table.set("position", spatial(*position));
            }
            table.differing("group", *group, 0, |group| group.to_string());
        }
        Intervention::SetThing { name, position } => {
            kind("set_thing");
            table.set("name", text(name));
            if !is_drawn {
                table.set("position", spatial(*position));
            }
        }
        Intervention::RemoveWayPoint { name } => {
            kind("remove_way_point");
            table.set("name", text(name));
        }
        Intervention::RemoveThing { name } => {
            kind("remove_thing");
            table.set("name", text(name));
        }
        Intervention::Tell { robots, order } => {
            let Order { name, fields } = order;
            kind("tell");
            if !robots.is_empty() {
                table.set("robots", names.several(robots));
            }
            table.set("order", text(name));
            let mut details = Table::root();
            for (name, value) in fields {
                details.set(name, self::value(value, names));
            }
            if let Some(details) = details.inline() {
                table.set("fields", details);
            }
        }
        Intervention::Join { like, name, pose } => {
            kind("join");
            table.set("like", names.one(*like));
            table.set("name", text(name));
            table.set("position", spatial(pose.position));
            if pose.yaw.to_bits() != 0 {
                table.set("heading", quantity(pose.yaw, "rad"));
            }
        }
        Intervention::Leave(robots) => {
            kind("leave");
            table.set("robots", names.several(robots));
        }
    }
    table.finish_element()
}

/// A value of an order.
fn value(value: &Value, names: &Names<'_>) -> String {
    match value {
        Value::Bool(value) => flag(*value),
        Value::Int(value) => value.to_string(),
        Value::Float(value) => number(*value),
        Value::Text(value) if is_quantity(value) => format!("{{ text = {} }}", text(value)),
        Value::Text(value) => text(value),
        Value::Time(value) => time(Duration(value.0)),
        Value::Point(value) => spatial(*value),
        Value::Robot(robot) => format!("{{ robot = {} }}", names.one(*robot)),
        Value::Robots(robots) => format!("{{ robots = {} }}", names.several(robots)),
        Value::Path(_) | Value::Obstacles(_) | Value::Area(_) => {
            unreachable!("a valid order carries none, and only valid ones are written")
        }
    }
}
