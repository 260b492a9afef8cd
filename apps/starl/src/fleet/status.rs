//! `starl fleet status`: the robots that are alive, with their positions, states and link
//! qualities.

use super::connect::connect;
use super::file::Fleet;
use crate::args::FleetStatusArguments;
use crate::failure::Failure;
use crate::{console, json};
use serde::Serialize;
use starl_catalog::programs::Registry;
use starl_node::link::frame::Status;
use starl_node::robot::longest_silence;
use std::time::Duration;

/// A robot that does not answer within this time is missing.
pub const PATIENCE: Duration = Duration::from_millis(1500);

/// One robot's line. Lengths are in metres, times in seconds.
#[derive(Debug, Serialize)]
struct Line {
    name: String,
    address: String,
    /// `running`, `finished`, `failed` or `missing`.
    condition: &'static str,
    state: Option<String>,
    /// x, y, z and heading in radians.
    position: Option<[f64; 4]>,
    position_age: Option<f64>,
    /// Why the motors are stopped.
    motors_stopped: Option<String>,
    failure: Option<String>,
    battery: Option<f64>,
    up: Option<f64>,
    refused_packets: Option<u64>,
    links: Vec<LinkLine>,
}

/// How well a robot hears another.
#[derive(Debug, Serialize)]
struct LinkLine {
    from: String,
    /// How long ago the other was heard.
    heard_ago: Option<f64>,
    loss: f64,
    round_trip: Option<f64>,
    /// How far the other's clock is ahead.
    clock_offset: Option<f64>,
}

/// Shows how a fleet is; whether all robots answer.
pub fn show(arguments: &FleetStatusArguments, registry: &Registry) -> Result<bool, Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, true, registry)?;
    let mut operator = connect(&fleet)?;
    let statuses = operator.statuses(PATIENCE);
    let lines: Vec<Line> = fleet
        .robots
        .iter()
        .map(|robot| {
            let status = statuses.get(&robot.id.0);
            Line::of(&fleet, &robot.name, robot.address.to_string(), status)
        })
        .collect();
    match arguments.json {
        true => json::print(&lines)?,
        false => console::print(&table(&lines))?,
    }
    Ok(statuses.len() == fleet.robots.len())
}

impl Line {
    fn of(fleet: &Fleet, name: &str, address: String, status: Option<&Status>) -> Line {
        let condition = match status {
            None => "missing",
            Some(status) if status.failed.is_some() => "failed",
            Some(status) if status.finished => "finished",
            Some(_) => "running",
        };
        let pose = status.and_then(|status| status.pose);
        let links = status.map_or(&[][..], |status| &status.links);
        Line {
            name: name.to_string(),
            address,
            condition,
            state: status.and_then(|status| status.state.clone()),
            position: pose.map(|pose| {
                let at = pose.position;
                [at.x, at.y, at.z, pose.yaw]
            }),
            position_age: pose.and(status).map(|status| status.position_age.seconds()),
            motors_stopped: status.and_then(|status| status.stopped.clone()),
            failure: status.and_then(|status| status.failed.clone()),
            battery: status.and_then(|status| status.battery),
            up: status.map(|status| status.up.seconds()),
            refused_packets: status.map(|status| status.refused.total()),
            links: links
                .iter()
                .map(|(from, quality)| LinkLine {
                    from: fleet.robots[*from as usize].name.clone(),
                    heard_ago: quality
                        .heard
                        .zip(status)
                        .map(|(heard, status)| status.now.since(heard).seconds()),
                    loss: quality.loss,
                    round_trip: quality.round_trip,
                    clock_offset: quality.offset,
                })
                .collect(),
        }
    }

    fn cells(&self) -> [String; 7] {
        let position = self.position.map_or("unknown".to_string(), |[x, y, z, _]| {
            match z.abs() < 0.005 {
                true => format!("{x:.2}, {y:.2}"),
                false => format!("{x:.2}, {y:.2}, {z:.2}"),
            }
        });
        let stale = self.position_age.filter(|age| *age > 0.5);
        let position = match stale {
            Some(age) if age < 1e6 => format!("{position} ({age:.1} s old)"),
            _ => position,
        };
        let silence = longest_silence(self.links.len() + 1).seconds();
        let heard = self
            .links
            .iter()
            .filter(|link| link.heard_ago.is_some_and(|ago| ago < silence));
        let worst = |value: fn(&LinkLine) -> Option<f64>| {
            let values = self.links.iter().filter_map(value);
            values.fold(None, |worst: Option<f64>, value| {
                Some(worst.map_or(value, |w| w.max(value)))
            })
        };
        let loss = worst(|link| Some(link.loss)).unwrap_or(0.0);
        let in_ms = |seconds: Option<f64>| {
            seconds.map_or("-".to_string(), |s| format!("{:.1} ms", s * 1e3))
        };
        let is_missing = self.condition == "missing";
        let unless_missing = |text: String| if is_missing { String::new() } else { text };
        [
            self.name.clone(),
            self.condition.to_string(),
            unless_missing(self.state.clone().unwrap_or_default()),
            unless_missing(position),
            unless_missing(format!("{} of {}", heard.count(), self.links.len())),
            unless_missing(format!("{:.0} %", loss * 100.0)),
            unless_missing(format!(
                "{}, {}",
                in_ms(worst(|link| link.round_trip)),
                in_ms(worst(|link| link.clock_offset.map(f64::abs)))
            )),
        ]
    }
}

fn table(lines: &[Line]) -> String {
    let head = [
        "robot",
        "condition",
        "state",
        "position",
        "hears",
        "loss",
        "round trip, clock",
    ];
    let mut rows = vec![head.map(str::to_string)];
    rows.extend(lines.iter().map(Line::cells));
    let widths: [usize; 7] = std::array::from_fn(|column| {
        rows.iter()
            .map(|row| row[column].chars().count())
            .max()
            .unwrap_or(0)
    });
    let mut text = String::new();
    for row in rows {
        let cells: Vec<String> = row
            .iter()
            .zip(widths)
            .map(|(cell, width)| format!("{cell:width$}"))
            .collect();
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
    }
    for line in lines {
        if let Some(why) = &line.motors_stopped {
            text.push_str(&format!("{}: motors stopped: {why}\n", line.name));
        }
        if let Some(refused @ 1..) = line.refused_packets {
            text.push_str(&format!(
                "{}: refused {}\n",
                line.name,
                console::counted(refused as usize, "packet")
            ));
        }
    }
    text
}
