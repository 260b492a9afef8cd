//! Reads where robots start: given poses, and areas for the rest.

use super::Placed;
use super::section::Section;
use crate::scenario::Bounds;
use starl_core::Pose;

/// An element of `start`.
pub(super) fn read(table: Section<'_>) -> Option<Placed<Pose>> {
    let heading = table.number("heading");
    let (position, _) = table.point("position")?;
    Some(Placed::at(
        table,
        "position",
        Pose::level(position, heading),
    ))
}

/// A rectangle of the floor plane, such as `world.bounds`.
pub(super) fn area(table: Section<'_>) -> Option<Placed<Bounds>> {
    let (low, high) = (table.point("low"), table.point("high"));
    let ((low, _), (high, _)) = (low?, high?);
    if low.x >= high.x || low.y >= high.y {
        let message = "the lowest corner is not below the highest in both coordinates";
        table.problem("low", message, "swap the corners");
        return None;
    }
    let field = table.path_of("");
    Some(Placed {
        value: Bounds { low, high },
        origin: table.origin,
        field,
    })
}
