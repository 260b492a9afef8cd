//! The information of checkers before the first record: plain data that any host can fill in and write into
//! its trace.

use serde::{Deserialize, Serialize};
use starl_core::event::Name;
use starl_core::motion::Body;
use starl_core::{Duration, Obstacle, RobotId, Time};

/// The information of a checker before the first record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Setting {
    /// The robots' bodies, by number.
    pub bodies: Vec<Body>,
    /// The obstacles of the world, by index, with the time at which each vanishes.
    pub obstacles: Vec<(Obstacle, Time)>,
    /// How many of them, the last, are the walls around the world.
    pub walls: usize,
    /// The checked properties, and their bounds.
    pub properties: Properties,
    /// Properties that were watched on the running programs themselves, by a [`Monitor`](crate::Monitor): records do
    /// not show them.
    pub monitored: Vec<Name>,
    /// The longest time by which a fault may be recorded after its effects; default 25 ms.
    pub step: Duration,
    /// Time between two records of a robot's true pose, at most; default 100 ms.
    pub pose_period: Duration,
    /// Time between two estimates of a robot's pose, at most; default 50 ms.
    pub estimate_period: Duration,
    /// Standard deviation of the estimates' position, metres; default 0.
    pub position_noise: f64,
    /// How much faster or slower than true time a robot's clock may run, as a share; default 0.
    pub clock_drift: f64,
    /// Whether robots have storage that survives a crash, unless it is lost by a fault; default false.
    pub keeps_storage: bool,
    /// The only robot with records; none if all robots have records.
    pub only: Option<RobotId>,
    /// Robots whose records are missing from a moment on, although they continued; in the order of time.
    pub unrecorded: Vec<(RobotId, Time)>,
    /// Whether a simulator wrote the records, so that poses are true and all times are those of one clock; default false.
    pub simulated: bool,
}

impl Default for Setting {
    /// No robots in an empty world, with a simulator's periods.
    fn default() -> Setting {
        Setting {
            bodies: Vec::new(),
            obstacles: Vec::new(),
            walls: 0,
            properties: Properties::default(),
            monitored: Vec::new(),
            step: Duration::from_millis(25),
            pose_period: Duration::from_millis(100),
            estimate_period: Duration::from_millis(50),
            position_noise: 0.0,
            clock_drift: 0.0,
            keeps_storage: false,
            only: None,
            unrecorded: Vec::new(),
            simulated: false,
        }
    }
}

/// The properties that are checked during a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
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
    /// Whether messages to one robot reach it in time, and once.
    pub unicast: bool,
    /// The time within which it reaches it.
    pub unicast_bound: Duration,
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
    /// One of several robots that ask for a free resource is granted it within this time; default 35 s.
    pub mutex_bound: Duration,
    /// A robot that alone asks for a free resource is granted it within this time, the thesis's d3; default 20 s.
    pub mutex_alone_bound: Duration,
    /// Linearizability of registers; default true.
    pub register: bool,
    /// Registration: agreement, exclusion, soundness, progress and convergence; default true.
    pub registration: bool,
    /// Robots agree on the participants within this time, the thesis's d2; default 35 s.
    pub registration_bound: Duration,
    /// Barrier: safety and progress; default true.
    pub barrier: bool,
    /// Robots pass within this time of the arrival of the last; default 35 s.
    pub barrier_bound: Duration,
    /// Failure detectors: completeness and accuracy; default true.
    pub failure_detector: bool,
    /// Crashes are suspected and false suspicions end within this time; default 35 s.
    pub failure_detector_bound: Duration,
    /// The properties that programs in the StarL language declare; default true.
    pub program: bool,
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
            unicast: _,
            unicast_bound,
            shared_memory: _,
            shared_memory_bound,
            election: _,
            election_bound,
            mutex: _,
            mutex_bound,
            mutex_alone_bound,
            register: _,
            registration: _,
            registration_bound,
            barrier: _,
            barrier_bound,
            failure_detector: _,
            failure_detector_bound,
            program: _,
        } = &mut self;
        for bound in [
            progress_bound,
            broadcast_bound,
            geocast_bound,
            unicast_bound,
            shared_memory_bound,
            election_bound,
            mutex_bound,
            mutex_alone_bound,
            registration_bound,
            barrier_bound,
            failure_detector_bound,
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
            unicast: true,
            unicast_bound: Duration::from_seconds(35),
            shared_memory: true,
            shared_memory_bound: Duration::from_seconds(35),
            election: true,
            election_bound: Duration::from_seconds(35),
            mutex: true,
            mutex_bound: Duration::from_seconds(35),
            mutex_alone_bound: Duration::from_seconds(20),
            register: true,
            registration: true,
            registration_bound: Duration::from_seconds(35),
            barrier: true,
            barrier_bound: Duration::from_seconds(35),
            failure_detector: true,
            failure_detector_bound: Duration::from_seconds(35),
            program: true,
        }
    }
}
