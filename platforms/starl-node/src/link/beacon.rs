//! The periodic message of a robot.

use serde::{Deserialize, Serialize};
use starl_core::{Point, Pose, Time};

/// The periodic message of a robot to all others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Beacon {
    /// Counts beacons, so that lost ones can be counted.
    pub number: u32,
    /// When it was sent, by the sender's clock.
    pub sent: Time,
    /// Where the robot believes to be; none if it does not know.
    pub pose: Option<Pose>,
    /// Its velocity, world frame, metres per second.
    pub velocity: Point,
    /// The receiver's latest beacon, when it was sent and when it arrived, by the clocks of either end: both ends
    /// measure delays and the difference of their clocks by it.
    pub echo: Option<(Time, Time)>,
}
