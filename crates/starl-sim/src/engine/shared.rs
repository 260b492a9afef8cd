//! The data that all robots may read during a step; nothing here changes while robots act.

use super::inbox::Inboxes;
use super::things::Things;
use crate::scenario::{Network, Scenario, SensorSuite, WorldObstacle};
use starl_core::geometry::ObstacleIndex;
use starl_core::motion::Obstacles;
use starl_core::{Command, Point, Program, RobotId, Time, WayPoint, math};
use starl_host::Hardware;
use starl_motion::scene::{Grid, Scene};
use starl_motion::{Disturbance, Model, Neighbour};
use std::sync::Arc;

/// A span of time: a physics step, or a slot of it.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// Its start.
    pub from: Time,
    /// Its end, which belongs to the next one.
    pub to: Time,
}

/// The common properties of the robots of one group.
#[derive(Clone)]
pub struct Kind {
    /// A fresh program.
    pub program: Box<dyn Program>,
    pub model: Arc<dyn Model>,
    pub hardware: Hardware,
    /// The command of the body without a command of the program.
    pub at_a_loss: Command,
    pub sensors: SensorSuite,
}

/// The world between two steps.
#[derive(Clone)]
pub struct Shared {
    pub scenario: Arc<Scenario>,
    pub fleet: Arc<[RobotId]>,
    /// By group.
    pub kinds: Vec<Kind>,
    /// The obstacles that stand now, with the indices they have in the scenario.
    pub map: ObstacleIndex,
    pub standing: Vec<u32>,
    /// Those of them that all robots know.
    pub known: Obstacles,
    /// Those of them that robots have to discover, as indices into `map`.
    pub hidden: Vec<u32>,
    /// True positions and velocities at the step's start.
    pub bodies: Vec<Neighbour>,
    /// Estimated ones; empty where no robot avoids others.
    pub perceived: Vec<Neighbour>,
    pub grid: Grid,
    pub inboxes: Inboxes,
    /// Each robot's part of a partitioned network; empty while there is none.
    pub parts: Vec<u32>,
    /// Whether parts hear those before them.
    pub one_way: bool,
    pub wind: Point,
    /// As the scenario has it, or as it has been changed since.
    pub network: Network,
    pub obstacles: Vec<WorldObstacle>,
    pub way_points: Vec<WayPoint>,
    pub things: Things,
    /// The robots that have left; empty while none has.
    pub gone: Vec<bool>,
}

impl Shared {
    /// The bodies and obstacles among which sensors measure.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            bodies: &self.bodies,
            grid: &self.grid,
            map: &self.map,
        }
    }

    /// Whether a partition keeps a robot from being heard by another.
    pub fn parted(&self, from: RobotId, to: RobotId) -> bool {
        if self.parts.is_empty() {
            return false;
        }
        let (from, to) = (self.parts[from.index()], self.parts[to.index()]);
        match self.one_way {
            true => from > to,
            false => from != to,
        }
    }

    /// The disturbance of a robot's motion during a step.
    pub fn disturbance(&self, robot: RobotId, from: Time) -> Disturbance {
        let motion = &self.scenario.motion;
        let mut disturbance = Disturbance {
            wind: self.wind,
            speed_error: 0.0,
            turn_error: 0.0,
        };
        if motion.speed_noise > 0.0 || motion.turn_noise > 0.0 {
            let period = motion.noise_period.0.max(1);
            let draw = from.0 / period;
            let errors = |draw: u64| {
                let key = [u64::from(robot.0), draw];
                let mut random = super::stream(self.scenario.seed, super::Stream::Motion, &key);
                let speed = random.normal(0.0, motion.speed_noise);
                [speed, random.normal(0.0, motion.turn_noise)]
            };
            // From one draw to the next along a quarter of a circle: smooth, and of the same deviation at
            // all times.
            let part = (from.0 % period) as f64 / period as f64;
            let (sin, cos) = math::sincos(0.25 * math::TAU * part);
            let (this, next) = (errors(draw), errors(draw + 1));
            let mixed = [0, 1].map(|which| cos * this[which] + sin * next[which]);
            [disturbance.speed_error, disturbance.turn_error] = mixed;
        }
        disturbance
    }
}
