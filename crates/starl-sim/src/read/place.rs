//! Where every robot starts: as the scenario or a world file says, or else at random.
//!
//! Given starts are checked, and taken before any is drawn. Drawn ones are dealt out within their group
//! along a curve through the floor, so that robots with neighbouring numbers stand near each other.

use super::contents::Contents;
use super::fleet::Draft;
use super::names::Names;
use super::placing::Placing;
use super::report::Report;
use super::{Placed, curve};
use crate::scenario::Bounds;
use starl_core::{Point, Pose, RobotId};

/// The starts of every group, as many as it has robots; none if a start does not do.
pub(super) fn starts(
    drafts: &[Draft],
    names: &Names,
    contents: &Contents,
    seed: u64,
    report: &Report,
) -> Option<Vec<Vec<Pose>>> {
    let given = given(drafts, names, contents, report);
    let fallback = contents.start_area.as_ref().or(contents.bounds.as_ref());
    let fallback = fallback.map(|placed| placed.value);
    let fallback = fallback.unwrap_or_else(|| surroundings(contents, drafts));
    let mut placing = Placing::new(drafts, contents, fallback, report);
    let before = report.count();
    for (draft, starts) in drafts.iter().zip(&given) {
        for (index, start) in starts.iter().enumerate() {
            if let Some(start) = start {
                placing.check(draft, names, robot(drafts, draft, index), start);
            }
        }
    }
    if report.count() > before {
        return None;
    }
    let mut all = Vec::new();
    for (draft, given) in drafts.iter().zip(given) {
        let mut drawn = Vec::new();
        for (index, start) in given.iter().enumerate() {
            if start.is_none() {
                let robot = robot(drafts, draft, index);
                drawn.push(placing.draw(draft, names, robot, seed)?);
            }
        }
        let area = placing.area(draft);
        drawn.sort_by_key(|pose| curve::position(&area, pose.position));
        let mut drawn = drawn.into_iter();
        let pose =
            |start: Option<Placed<Pose>>| start.map(|start| start.value).or_else(|| drawn.next());
        all.push(given.into_iter().filter_map(pose).collect());
    }
    Some(all)
}

/// The number of the robot that is `index`-th in its group.
fn robot(drafts: &[Draft], draft: &Draft, index: usize) -> RobotId {
    let before = drafts
        .iter()
        .take_while(|other| !std::ptr::eq(*other, draft));
    RobotId((before.map(|draft| draft.count).sum::<usize>() + index) as u32)
}

/// The start of each robot that has one: the scenario's own before a world file's.
fn given(
    drafts: &[Draft],
    names: &Names,
    contents: &Contents,
    report: &Report,
) -> Vec<Vec<Option<Placed<Pose>>>> {
    let mut given: Vec<Vec<Option<Placed<Pose>>>> = drafts
        .iter()
        .map(|draft| {
            let mut starts: Vec<_> = draft.starts.iter().cloned().map(Some).collect();
            starts.resize(draft.count, None);
            starts
        })
        .collect();
    for Placed {
        value: (name, pose),
        origin,
        field,
    } in &contents.starts
    {
        // A start of a robot beyond the group's count is for larger fleets.
        let Some(robot) = names.find(name) else {
            continue;
        };
        let mut index = robot.index();
        let starts = given
            .iter_mut()
            .find_map(|starts| match index < starts.len() {
                true => Some(starts),
                false => {
                    index -= starts.len();
                    None
                }
            });
        let Some(slot) = starts.and_then(|starts| starts.get_mut(index)) else {
            continue;
        };
        match slot {
            Some(other) => {
                let message = format!("{name} starts at two places");
                let help = format!(
                    "leave one out; the other is at {}",
                    report.place(other.origin)
                );
                report.problem_with_help(*origin, field, message, help);
            }
            None => {
                *slot = Some(Placed {
                    value: *pose,
                    origin: *origin,
                    field: field.clone(),
                })
            }
        }
    }
    given
}

/// Where robots are placed if nothing else says so: around everything that has a place, or else around the origin.
fn surroundings(contents: &Contents, drafts: &[Draft]) -> Bounds {
    let given = drafts
        .iter()
        .flat_map(|draft| &draft.starts)
        .map(|start| Bounds::around(start.value.position, 1.0));
    contents
        .surroundings()
        .into_iter()
        .chain(given)
        .reduce(Bounds::joined)
        .unwrap_or_else(|| Bounds::around(Point::ZERO, room(drafts).max(1.0)))
}

/// Half the side of a square in which all robots have room: each has a square twice as wide as itself and its distance
/// to others, so that drawn places are mostly free.
fn room(drafts: &[Draft]) -> f64 {
    let area = |draft: &Draft| {
        let side = 2.0 * (2.0 * draft.model.body().radius + draft.spacing);
        draft.count as f64 * side * side
    };
    drafts.iter().map(area).sum::<f64>().sqrt() / 2.0
}
