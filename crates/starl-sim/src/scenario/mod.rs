//! A scenario as plain data: the world, the fleet, the network, the faults.
//!
//! Every field is documented here with its unit and default; a scenario file sets it by the same name (see `read`).

mod event;
mod fault;
mod fleet;
mod idle;
mod network;
mod properties;
mod sensors;
mod settings;
mod world;

pub(crate) use event::{Joins, Moment};
pub use event::{Occasion, ScenarioEvent};
pub use fault::{Fault, FaultRates, Faults};
pub use fleet::{Clock, Fleet, Group, Parameter};
pub use network::{Link, LinkOverride, Network};
pub use settings::{Motion, Physics, Positioning, Storage, Trace, Wind};
pub use starl_core::FaultKind;
pub use starl_core::intervention::DelayDistribution;
pub use starl_motion::sensing::{Detector, Proximity, SensorSuite};
pub use starl_properties::Properties;
pub use world::{Bounds, Thing, World, WorldObstacle};

use starl_core::Duration;

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
            wind: Wind::default(),
            network: Network::default(),
            faults: Faults::default(),
            events: Vec::new(),
            properties: Properties::default(),
            trace: Trace::default(),
        }
    }
}

impl Scenario {
    /// Tells the avoidance of other robots what follows from the rest of the scenario: how often robots know where they
    /// are, and how large the largest of them is.
    pub(crate) fn fit_avoidance(&mut self) {
        if let Some(avoidance) = &mut self.motion.avoidance {
            avoidance.period = self.positioning.period.seconds();
            avoidance.largest_radius = self.fleet.largest_radius();
        }
    }
}
