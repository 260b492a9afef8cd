//! Other robots, as a robot perceives them.

use starl_core::Point;

/// Another robot as this one perceives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Base centre, metres.
    pub position: Point,
    /// Metres per second.
    pub velocity: Point,
    /// Metres.
    pub radius: f64,
    /// Metres.
    pub height: f64,
}
