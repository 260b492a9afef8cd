//! Reads an element of `world.obstacle`.

use super::section::Section;
use crate::scenario::WorldObstacle;
use starl_core::geometry::{HeightSpan, PolygonError};
use starl_core::{ConvexPolygon, Obstacle, Point, Time};

/// The names of the fields that give a shape.
const SHAPES: [&str; 4] = ["polygon", "circle", "rectangle", "box"];

/// One obstacle.
pub(super) fn read(table: Section<'_>) -> Option<WorldObstacle> {
    let obstacle = shape(table);
    let hidden = table.flag("hidden");
    let expires = table
        .optional_duration("expires")
        .map_or(Time::NEVER, |span| Time(span.0));
    Some(WorldObstacle {
        obstacle: obstacle?,
        hidden,
        expires,
    })
}

/// The shape and place of an obstacle.
pub(super) fn shape(table: Section<'_>) -> Option<Obstacle> {
    let given: Vec<&str> = SHAPES.into_iter().filter(|name| table.has(name)).collect();
    match given.as_slice() {
        [_] => {}
        [] => {
            let help = format!("give one of {}", SHAPES.join(", "));
            table.report.problem_with_help(
                table.origin,
                &table.path_of(""),
                "the obstacle has no shape",
                help,
            );
        }
        [_, second, ..] => {
            table.problem(
                second,
                "the obstacle has two shapes",
                "make two obstacles of it",
            );
        }
    }
    let obstacle = match given.as_slice() {
        ["polygon"] => polygon(table),
        ["circle"] => table.table("circle", |table| {
            let (center, radius) = (table.point("center"), table.optional_number("radius"));
            Some(Obstacle::circle(center?.0, radius?))
        }),
        ["rectangle"] => table.table("rectangle", |table| {
            let (low, high) = corners(table)?;
            ConvexPolygon::rectangle(low, high)
                .ok()
                .map(Obstacle::polygon)
        }),
        ["box"] => table.table("box", |table| {
            let (low, high) = corners(table)?;
            Some(Obstacle::cuboid(low, high))
        }),
        _ => None,
    };
    let height = height(table);
    if height.is_some() && given == ["box"] {
        table.problem("height", "a box has heights of its own", "leave it out");
    }
    match height {
        Some(height) => Some(obstacle?.with_height(height)),
        None => obstacle,
    }
}

/// The field `height`; none where the obstacle is unbounded.
pub(super) fn height(table: Section<'_>) -> Option<HeightSpan> {
    table
        .heights("height")
        .map(|(low, high)| HeightSpan::new(low, high))
}

/// The fields `low` and `high`, in order in every coordinate they have.
fn corners(table: Section<'_>) -> Option<(Point, Point)> {
    let (low, high) = (table.point("low"), table.point("high"));
    let ((low, of_low), (high, of_high)) = (low?, high?);
    let spatial = table.path_of("").ends_with(".box");
    if spatial && (of_low < 3 || of_high < 3) {
        let field = if of_low < 3 { "low" } else { "high" };
        let help = "write [x, y, z]; a rectangle needs no height";
        table.problem(field, "the corner of a box needs its height", help);
        return None;
    }
    if low.x >= high.x || low.y >= high.y || (spatial && low.z >= high.z) {
        let message = "the lowest corner is not below the highest in all coordinates";
        table.problem("low", message, "swap the corners");
        return None;
    }
    Some((low, high))
}

fn polygon(table: Section<'_>) -> Option<Obstacle> {
    let before = table.report.count();
    let points = table.outline("polygon");
    if table.report.count() > before {
        return None;
    }
    match ConvexPolygon::new(&points) {
        Ok(polygon) => Some(Obstacle::polygon(polygon)),
        Err(error) => {
            let (message, help) = explain(error);
            table.problem("polygon", message, help);
            None
        }
    }
}

/// The error of an outline, and a suggested fix; points are counted from 1.
pub(super) fn explain(error: PolygonError) -> (String, &'static str) {
    match error {
        PolygonError::TooFew => (
            "this is not an outline".to_string(),
            "give at least three corners, or the two ends of a wall",
        ),
        PolygonError::NotFinite { index } => (
            format!("point {} is not finite", index + 1),
            "give finite coordinates",
        ),
        PolygonError::Repeated { first, second } => (
            format!("points {} and {} are the same", first + 1, second + 1),
            "leave one out; the last need not repeat the first",
        ),
        PolygonError::Degenerate => (
            "all points lie on one line".to_string(),
            "for a wall give only its two ends",
        ),
        PolygonError::NotConvex { index } => (
            format!("the outline is not convex at point {}", index + 1),
            "list the corners in order, and split a hollow shape into convex parts",
        ),
        PolygonError::SelfCrossing => (
            "the outline crosses itself".to_string(),
            "list the corners in order, once round",
        ),
    }
}
