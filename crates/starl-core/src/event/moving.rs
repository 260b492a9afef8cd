//! The events of ReachAvoid.

use crate::geometry::Point;
use crate::motion::{Obstacles, Path};

words! {
    /// The reason why a path is unusable, or was not found.
    Trouble {
        /// An obstacle was found on the path.
        Obstacle = "obstacle on the path",
        /// The robot is too far from the path.
        OffPath = "off the path",
        /// The planner found no path.
        NoPath = "no path",
        /// The robot makes no headway.
        Stuck = "stuck",
        /// The path that was given has no points.
        NoPoints = "no points",
        /// The wind is stronger than the robot can hold against.
        Wind = "wind",
        /// The target is not finite.
        NotFinite = "target is not finite",
        /// The robot is in the unsafe set.
        Unsafe = "in the unsafe set",
    }
}

events! {
    /// Commands to a ReachAvoid, and their results.
    ReachAvoidEvent {
        /// A command was given. One that was under way is dropped.
        Start = "start" {
            /// Where to go.
            target: Point,
            /// Metres; from there on it counts as reached.
            vicinity: f64,
            /// The set to keep out of.
            unsafe_set: Obstacles,
        },
        /// The robot sets out on a path.
        Path = "path" {
            /// Its points.
            path: Path,
        },
        /// The path is given up, and another one is asked for.
        Replan = "replan" {
            /// Why.
            reason: Trouble,
        },
        /// The target is reached.
        Done = "done" {
            /// Where the robot believes to be.
            position: Point,
        },
        /// The robot is in the unsafe set.
        Failed = "failed" {
            /// Where the robot believes to be.
            position: Point,
        },
        /// There is no path to the target.
        GiveUp = "give_up" {
            /// Why.
            reason: Trouble,
        },
        /// The command was taken back.
        Stop = "stop",
    }
}
