//! A scenario as plain data: the world, the fleet, the network, the faults.
//!
//! Every knob is documented here with its unit and default; a scenario file sets them by the same
//! names (see `read`).

mod event;
mod fault;
mod fleet;
mod network;
mod world;

pub(crate) use event::{Joins, Moment};
pub use event::{Occasion, ScenarioEvent};
pub use fault::{Fault, FaultRates, Faults};
pub use fleet::{Clock, Fleet, Group, Parameter};
pub use network::{Link, LinkOverride, Network};
pub use starl_core::FaultKind;
pub use starl_core::intervention::DelayDistribution;
pub use starl_motion::sensing::{Detector, Proximity, SensorSuite};
pub use starl_properties::Properties;
pub use world::{Bounds, Thing, World, WorldObstacle};

use starl_core::{Duration, Point};
use starl_motion::avoidance;

/// A complete run, apart from the code of its programs.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// The title; default the file's name.
    pub title: String,
    /// Decides every random draw of the run; default 1.
    pub seed: u64,
    /// The run ends here at the latest; default 120 s.
    pub duration: Duration,
    /// When the run has reached its goal.
    pub goal: Goal,
    /// Obstacles, waypoints and things.
    pub world: World,
    /// The robots.
    pub fleet: Fleet,
    /// How finely motion is computed.
    pub physics: Physics,
    /// How robots learn where they are.
    pub positioning: Positioning,
    /// How exactly robots move.
    pub motion: Motion,
    /// The storage of robots.
    pub storage: Storage,
    /// Moving air.
    pub wind: Wind,
    /// How messages travel.
    pub network: Network,
    /// The faults, with their times.
    pub faults: Faults,
    /// Other events, with their times.
    pub events: Vec<ScenarioEvent>,
    /// The checked properties.
    pub properties: Properties,
    /// The options of the trace.
    pub trace: Trace,
}

/// When a run has reached its goal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Goal {
    /// Every robot that is up has finished; the run ends then.
    #[default]
    AllFinished,
    /// The run lasts as long as it should; its programs have no end of their own.
    Duration,
    /// A condition over the robots, in the language of their programs, is true; the run ends then. A host that knows
    /// the language watches it: [`crate::Run::set_goal`].
    Condition(String),
}

/// How finely motion is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Physics {
    /// The physics step; messages take at least until the next one; default 25 ms.
    pub step: Duration,
    /// Whether bodies stop each other and are stopped by obstacles; default true.
    pub collisions: bool,
}

/// The simulated positioning system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Positioning {
    /// Time between two estimates; default 50 ms.
    pub period: Duration,
    /// Standard deviation of each coordinate, metres; default 0.
    pub position_noise: f64,
    /// Standard deviation of each angle, radians; default 0.
    pub heading_noise: f64,
    /// Standard deviation of each component of the velocity, metres per second; default 0.
    pub velocity_noise: f64,
}

/// How exactly robots move.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Standard deviation of the relative error of commanded speeds; default 0.
    pub speed_noise: f64,
    /// Standard deviation of the relative error of rates of turn; default 0.
    pub turn_noise: f64,
    /// How long one draw of the errors lasts; default 500 ms.
    pub noise_period: Duration,
    /// Reciprocal avoidance; default on, none switches it off.
    pub avoidance: Option<avoidance::Options>,
}

/// The storage of robots, which survives a crash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Storage {
    /// Whether robots have storage that survives a crash; default false.
    pub kept: bool,
    /// How long a write takes; one that a crash cuts short has not begun; default 5 ms.
    pub write_time: Duration,
    /// The probability that a crash erases a robot's storage; default 0.
    pub loss: f64,
}

impl Default for Storage {
    fn default() -> Storage {
        Storage {
            kept: false,
            write_time: Duration::from_millis(5),
            loss: 0.0,
        }
    }
}

/// Moving air, the same everywhere: a steady part and a gust that swings as a sine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wind {
    /// Steady velocity, world frame, metres per second; default 0.
    pub steady: Point,
    /// Amplitude of the gust, metres per second; default 0.
    pub gust: Point,
    /// Period of the gust; default 10 s.
    pub gust_period: Duration,
}

/// The options of the trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trace {
    /// Time between two records of each robot's true pose; default 100 ms.
    pub pose_period: Duration,
}

impl Default for Physics {
    fn default() -> Physics {
        Physics {
            step: Duration::from_millis(25),
            collisions: true,
        }
    }
}

impl Default for Positioning {
    fn default() -> Positioning {
        Positioning {
            period: Duration::from_millis(50),
            position_noise: 0.0,
            heading_noise: 0.0,
            velocity_noise: 0.0,
        }
    }
}

impl Default for Motion {
    fn default() -> Motion {
        Motion {
            speed_noise: 0.0,
            turn_noise: 0.0,
            noise_period: Duration::from_millis(500),
            avoidance: Some(avoidance::Options::default()),
        }
    }
}

impl Default for Trace {
    fn default() -> Trace {
        Trace {
            pose_period: Duration::from_millis(100),
        }
    }
}

impl Default for Scenario {
    /// An empty world without robots, every knob at its default.
    fn default() -> Scenario {
        Scenario {
            title: String::new(),
            seed: 1,
            duration: Duration::from_seconds(120),
            goal: Goal::default(),
            world: World::default(),
            fleet: Fleet::default(),
            physics: Physics::default(),
            positioning: Positioning::default(),
            motion: Motion::default(),
            storage: Storage::default(),
            wind: Wind {
                gust_period: Duration::from_seconds(10),
                ..Wind::default()
            },
            network: Network::default(),
            faults: Faults::default(),
            events: Vec::new(),
            properties: Properties::default(),
            trace: Trace::default(),
        }
    }
}
