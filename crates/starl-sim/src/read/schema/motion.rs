//! The fields of `motion`.

use super::*;

/// The accuracy of motion, and the avoidance of other robots.
pub(super) const MOTION: &[Field] = &[
    field(
        "speed_noise",
        RATIO,
        Default::Value("0"),
        "Standard deviation of the relative error of commanded speeds. The limits of the model still apply.",
    ),
    field(
        "turn_noise",
        RATIO,
        Default::Value("0"),
        "Standard deviation of the relative error of rates of turn.",
    ),
    field(
        "noise_period",
        PERIOD,
        Default::Value("500ms"),
        "The time from one draw of these errors to the next; they change smoothly between.",
    ),
    field(
        "avoidance",
        Kind::Switch(AVOIDANCE),
        Default::Value("true"),
        "Reciprocal avoidance of other robots; `false` switches it off.",
    ),
];

const AVOIDANCE: &[Field] = &[
    field(
        "margin",
        LENGTH,
        Default::Value("30mm"),
        "Room that each robot keeps on its side of the border between two bodies.",
    ),
    field(
        "vertical_clearance",
        LENGTH,
        Default::Value("100mm"),
        "Free height at which robots above one another need not avoid each other in the plane.",
    ),
    field(
        "patience",
        SPAN,
        Default::Value("800ms"),
        "Time without progress, while a neighbour is in the way, after which a robot may yield.",
    ),
    field(
        "longest_yield",
        SPAN,
        Default::Value("6s"),
        "Longest time a robot yields before it tries again.",
    ),
];
