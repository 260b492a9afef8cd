//! The interface between programs and the motion layer (the thesis's RobotMotion).
//!
//! A program or primitive sends requests; the host's motion layer plans paths, tracks waypoints and commands the
//! robot's model.

use crate::geometry::{HeightSpan, Obstacle, Point, Pose, Twist};
use crate::time::Time;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// Obstacles shared without copying.
pub type Obstacles = Arc<[Obstacle]>;

/// Waypoints to visit in order, metres.
pub type Path = Vec<Point>;

/// A command of a robot model. Commands are exclusive: a new one aborts the one before it. Each
/// model documents which it takes (thesis, table 4.1); others it refuses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Stand still (a quadcopter in the air hovers).
    Stop,
    /// Drive straight ahead at `speed` m/s, backwards if negative.
    Straight {
        /// Metres per second.
        speed: f64,
    },
    /// Turn on the spot at `rate` rad/s, left if positive.
    Turn {
        /// Radians per second.
        rate: f64,
    },
    /// Drive along a circle of `radius` metres at `speed` m/s; the centre is to the left if the
    /// radius is positive.
    Curve {
        /// Metres per second.
        speed: f64,
        /// Metres, signed.
        radius: f64,
    },
    /// Turn the wheels of a differential drive at these rim speeds.
    Wheels {
        /// Left wheel, metres per second.
        left: f64,
        /// Right wheel, metres per second.
        right: f64,
    },
    /// Steer a car.
    Steer {
        /// Metres per second, backwards if negative.
        speed: f64,
        /// Angle of the front wheels, radians, left positive.
        angle: f64,
    },
    /// Move a holonomic robot with this velocity.
    Velocity {
        /// World frame, metres per second.
        velocity: Point,
        /// Rate of yaw, radians per second.
        yaw_rate: f64,
    },
    /// Rise from the ground to the safe height.
    TakeOff,
    /// Sink to the ground and stop the rotors.
    Land,
    /// Hold position in the air.
    Hover,
    /// Fly at this attitude (the thesis's setYawSpeedPitchRollGaz).
    Attitude {
        /// Rate of yaw, radians per second.
        yaw_rate: f64,
        /// Nose-down angle, radians.
        pitch: f64,
        /// Right-side-down angle, radians.
        roll: f64,
        /// Vertical speed, metres per second.
        gaz: f64,
    },
}

/// Where a robot can be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Workspace {
    /// On the floor.
    Ground,
    /// In the air, when it travels at least this high, metres.
    Air {
        /// Lowest height of travel, metres.
        lowest: f64,
    },
}

/// The space that a robot takes: an upright cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Metres.
    pub radius: f64,
    /// Metres.
    pub height: f64,
    /// Where it can be.
    pub workspace: Workspace,
}

impl Body {
    /// The point nearest to `target` that the robot can reach: a ground robot leaves the height
    /// out, a quadcopter does not go below its lowest height of travel.
    pub fn reachable(&self, target: Point) -> Point {
        match self.workspace {
            Workspace::Ground => target.at_height(0.0),
            Workspace::Air { lowest } => target.at_height(target.z.max(lowest)),
        }
    }

    /// Whether the robot flies.
    pub fn flies(&self) -> bool {
        matches!(self.workspace, Workspace::Air { .. })
    }

    /// The heights that the body takes when its base is at `z`.
    pub fn span(&self, z: f64) -> HeightSpan {
        HeightSpan {
            low: z,
            high: z + self.height,
        }
    }
}

/// An estimate of the positioning system for a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Estimated pose.
    pub pose: Pose,
    /// Estimated velocity.
    pub twist: Twist,
    /// When it was taken, by the robot's clock.
    pub at: Time,
}

/// Path planners to choose from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Planner {
    /// The model's own default: [`Planner::RrtConnect`] for robots that can turn on the spot,
    /// [`Planner::Rrt`] for others.
    #[default]
    Auto,
    /// The thesis's: a tree grown by simulating the robot's own motion.
    Rrt,
    /// Two trees grown towards each other along straight lines (Kuffner and LaValle 2000).
    RrtConnect,
    /// Asymptotically shortest paths (Karaman and Frazzoli 2011).
    RrtStar,
}

/// A request to a planner.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanRequest {
    /// Returned with the answer, [`crate::Input::Planned`].
    pub ticket: u32,
    /// Where to go, already [`Body::reachable`].
    pub target: Point,
    /// Where the target itself is not free, a point this near to it will do, metres.
    pub vicinity: f64,
    /// The obstacles that the body must avoid.
    pub unsafe_set: Obstacles,
    /// Whether robots in sight count as obstacles where they stand now.
    pub around_robots: bool,
    /// Which planner.
    pub planner: Planner,
    /// The planner gives up when its tree has this many nodes.
    pub most_nodes: u32,
    /// Seeds the planner's samples.
    pub seed: u64,
}

/// A request to the host's motion layer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MotionRequest {
    /// Send this command to the model until the next request.
    Drive(Command),
    /// Find a path from the estimated pose; the answer is [`crate::Input::Planned`].
    Plan(PlanRequest),
    /// Track this waypoint in closed loop until told otherwise.
    Track {
        /// Where to go, metres.
        target: Point,
        /// The point after this one, metres; none where the robot is to stop at `target`.
        next: Option<Point>,
    },
    /// Stop.
    Halt,
}

/// A named place given to programs as input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WayPoint {
    /// Its name.
    pub name: String,
    /// Where it is, metres.
    pub position: Point,
    /// A number that groups waypoints, e.g. by robot; 0 where none is given.
    pub group: u32,
}
