//! Settings of ReachAvoid.

use starl_core::Duration;
use starl_core::motion::Planner;

/// Settings of [`super::ReachAvoid`]. Lengths must be positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The target is reached at this distance from it, metres: in space for robots that fly, planar
    /// for others. At least twice the accuracy of the positioning system. Default 0.075.
    pub vicinity: f64,
    /// A waypoint before the last counts as passed at this distance if the way from there to the
    /// next one is free, otherwise at a quarter of the vicinity, metres. Default 0.15.
    pub pass_radius: f64,
    /// A robot this far from its path plans again, metres. Default 0.5.
    pub off_path: f64,
    /// A robot that came less than `least_progress` nearer within this time plans again, around other
    /// robots where they stand. It is longer than robots that meet need to make room. Default 4 s.
    pub stuck_after: Duration,
    /// See `stuck_after`; metres along the path. Default 0.1.
    pub least_progress: f64,
    /// A command plans again at most this often, for whatever reason; then it gives up. Default 30.
    pub most_replans: u32,
    /// When a planner finds no path this many times in a row the command gives up. Default 3.
    pub most_plan_failures: u32,
    /// Between two such times, so that whatever is in the way can move; also the shortest time that
    /// a path is followed before another is asked for because the way on is not free. Default 500 ms.
    pub plan_pause: Duration,
    /// A robot that moves faster than this brakes before it asks for a path, metres per second. Default
    /// 0.15.
    pub rest_speed: f64,
    /// In a lane the robot keeps the centres of others at this distance from its own, metres. Default 0.75.
    pub gap: f64,
    /// Which planner.
    pub planner: Planner,
    /// A planner gives up when its tree has this many nodes. Default 20,000.
    pub most_nodes: u32,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            vicinity: 0.075,
            pass_radius: 0.15,
            off_path: 0.5,
            stuck_after: Duration::from_seconds(4),
            least_progress: 0.1,
            most_replans: 30,
            most_plan_failures: 3,
            plan_pause: Duration::from_millis(500),
            rest_speed: 0.15,
            gap: 0.75,
            planner: Planner::Auto,
            most_nodes: 20_000,
        }
    }
}
