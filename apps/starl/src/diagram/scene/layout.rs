//! Where things lie: robots' lines, labels above them, and which colour belongs to what.

use super::super::axis::Axis;
use super::super::story::{Mark, MarkKind, Story};
use super::{LABEL, LANE};
use crate::plot::drawing::Color;
use crate::plot::{palette, text_width};
use starl_core::{Port, RobotId};
use std::collections::BTreeMap;

/// More lanes than this would hide the arrows.
const MOST_LANES: usize = 7;
/// Height of a row without labels.
const ROW: f64 = 58.0;

/// Labels with their lanes above their robots' lines; none if there is no room.
pub(super) type Lanes<'a> = Vec<(&'a Mark, Option<usize>)>;

/// Gives each label the lowest lane in which it is clear of others.
pub(super) fn lanes<'a>(story: &'a Story, axis: &Axis) -> Lanes<'a> {
    let mut ends: BTreeMap<(RobotId, usize), f64> = BTreeMap::new();
    let shown = story.marks.iter().filter(|mark| axis.shows(mark.at));
    let lane = |mark: &'a Mark| {
        let x = axis.place(mark.at);
        let free = |lane: &usize| ends.get(&(mark.robot, *lane)).is_none_or(|&end| end <= x);
        let lane = (0..MOST_LANES).find(free);
        if let Some(lane) = lane {
            let end = x + text_width(&mark.text, LABEL) * 0.95 + 6.0;
            ends.insert((mark.robot, lane), end);
        }
        (mark, lane)
    };
    shown.map(lane).collect()
}

/// Where the robots' lines lie, each with room for its labels above.
pub(super) fn rows(story: &Story, lanes: &Lanes<'_>) -> Vec<f64> {
    let mut y = 62.0;
    let row = |robot: usize| {
        let own = lanes.iter().filter(|(mark, _)| mark.robot.index() == robot);
        let used = own.filter_map(|(_, lane)| *lane).map(|lane| lane + 1).max();
        y += used.unwrap_or(0) as f64 * LANE + if robot == 0 { 8.0 } else { ROW };
        y
    };
    (0..story.robots.len()).map(row).collect()
}

/// A colour for each port that something shown belongs to.
pub(super) fn colors(story: &Story, axis: &Axis) -> BTreeMap<Port, Color> {
    let sent = story
        .messages
        .iter()
        .filter(|message| axis.shows(message.at));
    let mut ports: Vec<Port> = sent.map(|message| message.port).collect();
    ports.extend(
        story
            .marks
            .iter()
            .filter(|mark| axis.shows(mark.at))
            .filter_map(|mark| match mark.kind {
                MarkKind::Primitive(port) => Some(port),
                _ => None,
            }),
    );
    ports.sort_unstable();
    ports.dedup();
    let many = ports.len();
    let colored = ports.into_iter().enumerate();
    colored
        .map(|(index, port)| (port, palette::color(index, many)))
        .collect()
}
