//! What a run consists of, as plain data: the world, the fleet, the network, the faults.
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
pub use fleet::{Clock, Detector, Fleet, Group, Parameter, Proximity, SensorSuite};
pub use network::{Link, LinkOverride, Network};
pub use starl_core::FaultKind;
pub use starl_core::intervention::DelayDistribution;
pub use world::{Bounds, Thing, World, WorldObstacle};

use starl_core::{Duration, Point};
use starl_motion::avoidance;

/// A complete run, apart from the code of its programs.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// What is run; default the file's name.
    pub title: String,
    /// Decides every random draw of the run; default 1.
    pub seed: u64,
    /// The run ends here at the latest; default 120 s.
    pub duration: Duration,
    /// When the run has reached its goal.
    pub goal: Goal,
    /// Obstacles, way-points and things.
    pub world: World,
    /// The robots.
    pub fleet: Fleet,
    /// How finely motion is computed.
    pub physics: Physics,
    /// How robots learn where they are.
    pub positioning: Positioning,
    /// How exactly robots move.
    pub motion: Motion,
    /// Moving air.
    pub wind: Wind,
    /// How messages travel.
    pub network: Network,
    /// What breaks, and when.
    pub faults: Faults,
    /// What happens besides, and when.
    pub events: Vec<ScenarioEvent>,
    /// What is checked while it runs.
    pub properties: Properties,
    /// What is recorded.
    pub trace: Trace,
}

/// When a run has reached its goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Goal {
    /// Every robot that is up has finished; the run ends then.
    #[default]
    AllFinished,
    /// The run lasts as long as it should; its programs have no end of their own.
    Duration,
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
    /// Standard deviation of the relative error of driven speeds; default 0.
    pub speed_noise: f64,
    /// Standard deviation of the relative error of rates of turn; default 0.
    pub turn_noise: f64,
    /// How long one draw of the errors lasts; default 500 ms.
    pub noise_period: Duration,
    /// Reciprocal avoidance; default on, none switches it off.
    pub avoidance: Option<avoidance::Options>,
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

/// What is checked while a run goes on.
#[derive(Clone, Debug, PartialEq)]
pub struct Properties {
    /// Bodies never touch; default true.
    pub no_collision: bool,
    /// ReachAvoid's safety, goal and progress; default true.
    pub reach_avoid: bool,
    /// ReachAvoid's active flag falls within this time; default 180 s.
    pub progress_bound: Duration,
    /// Broadcasts reach every robot that is up; default true.
    pub broadcast: bool,
    /// The thesis's d1: within this time; default 35 s.
    pub broadcast_bound: Duration,
    /// Geocast's exclusion and inclusion; default true.
    pub geocast: bool,
    /// The thesis's d2; default 35 s.
    pub geocast_bound: Duration,
    /// Shared memory's integrity, order and convergence; default true.
    pub shared_memory: bool,
    /// Shared memories converge within this time; default 35 s.
    pub shared_memory_bound: Duration,
    /// Leader election: uniqueness, order, exclusion, soundness, agreement and progress; default true.
    pub election: bool,
    /// Robots agree on a leader within this time; default 35 s.
    pub election_bound: Duration,
    /// Mutex's safety, non-interference, progress and growing numbers; default true.
    pub mutex: bool,
    /// What is free is granted within this time; default 35 s.
    pub mutex_bound: Duration,
    /// Linearizability of registers; default true.
    pub register: bool,
    /// Registration: agreement, exclusion, soundness, progress and convergence; default true.
    pub registration: bool,
    /// Robots agree on who takes part within this time, the thesis's d2; default 35 s.
    pub registration_bound: Duration,
    /// Barrier: safety and progress; default true.
    pub barrier: bool,
    /// Robots pass within this time of the arrival of the last; default 35 s.
    pub barrier_bound: Duration,
    /// What programs in the StarL language say of themselves; default true.
    pub program: bool,
}

/// What is recorded.
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

impl Properties {
    /// The same, with nothing ever too late: every bound of time is `forever`.
    pub fn without_bounds(mut self, forever: Duration) -> Properties {
        let Properties {
            no_collision: _,
            reach_avoid: _,
            progress_bound,
            broadcast: _,
            broadcast_bound,
            geocast: _,
            geocast_bound,
            shared_memory: _,
            shared_memory_bound,
            election: _,
            election_bound,
            mutex: _,
            mutex_bound,
            register: _,
            registration: _,
            registration_bound,
            barrier: _,
            barrier_bound,
            program: _,
        } = &mut self;
        for bound in [
            progress_bound,
            broadcast_bound,
            geocast_bound,
            shared_memory_bound,
            election_bound,
            mutex_bound,
            registration_bound,
            barrier_bound,
        ] {
            *bound = forever;
        }
        self
    }
}

impl Default for Properties {
    fn default() -> Properties {
        Properties {
            no_collision: true,
            reach_avoid: true,
            progress_bound: Duration::from_seconds(180),
            broadcast: true,
            broadcast_bound: Duration::from_seconds(35),
            geocast: true,
            geocast_bound: Duration::from_seconds(35),
            shared_memory: true,
            shared_memory_bound: Duration::from_seconds(35),
            election: true,
            election_bound: Duration::from_seconds(35),
            mutex: true,
            mutex_bound: Duration::from_seconds(35),
            register: true,
            registration: true,
            registration_bound: Duration::from_seconds(35),
            barrier: true,
            barrier_bound: Duration::from_seconds(35),
            program: true,
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
