//! The settings that the environments of a batch have in common.

use starl_core::{Duration, Obstacle};
use starl_motion::Model;
use std::sync::Arc;
use thiserror::Error;

/// The settings that the environments of a batch have in common.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The model of each robot. All models have the same number of controls.
    pub models: Vec<Arc<dyn Model>>,
    /// The time of one physics step.
    pub physics_step: Duration,
    /// How many physics steps an action lasts.
    pub steps_per_action: u32,
    /// Whether bodies stop where they touch others and obstacles.
    pub collisions: bool,
    /// Obstacles of all environments.
    pub obstacles: Vec<Obstacle>,
    /// The sensor of distances, if robots have one.
    pub lidar: Option<Lidar>,
    /// The meaning of actions.
    pub actions: Actions,
    /// The radio, if robots send messages.
    pub radio: Option<Radio>,
}

/// Rays evenly round the body, the first straight ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lidar {
    /// How many rays.
    pub rays: u32,
    /// How far they see beyond the body's edge, metres.
    pub range: f64,
}

/// The meaning of a robot's action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Actions {
    /// The controls of its model: [`Model::command_of`].
    Commands,
    /// A waypoint, which the model's tracker drives to: the way to it from the robot's position in the world frame,
    /// each coordinate a part of this distance, metres. Robots on the ground take x and y, drones also z.
    Waypoints {
        /// The distance of 1, metres.
        reach: f64,
    },
}

/// Messages between robots: with each action, a robot sends a vector of numbers to all others in range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radio {
    /// How many numbers a message has.
    pub numbers: usize,
    /// Robots farther apart than this when the message is sent do not hear it, metres; infinite if all hear each other.
    pub range: f64,
    /// The probability that a receiver does not get a message.
    pub loss: f64,
    /// The shortest and the longest delay, in actions; drawn for each receiver. A message without delay is heard at the
    /// end of the action with which it is sent.
    pub delay: (u32, u32),
}

/// Why settings cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{field}`: {message}")]
pub struct SettingsError {
    /// The setting.
    pub field: &'static str,
    /// The problem, and the values that can be used.
    pub message: String,
}

/// More robots than this in an environment are refused.
const MOST_ROBOTS: usize = 10_000;
/// The longest delay of messages, which are kept until then.
const LONGEST_DELAY: u32 = 10_000;
/// The most rays, and the most numbers of a message.
const MOST_NUMBERS: usize = 100_000;

impl Settings {
    /// The number of robots of an environment.
    pub fn robots(&self) -> usize {
        self.models.len()
    }

    /// How many numbers a robot's action has, its message left out.
    pub fn action_numbers(&self) -> usize {
        let Some(model) = self.models.first() else {
            return 0;
        };
        match self.actions {
            Actions::Commands => model.controls().len(),
            Actions::Waypoints { .. } => 2 + usize::from(model.body().flies()),
        }
    }

    /// How many numbers a message has; 0 without a radio.
    pub fn message_numbers(&self) -> usize {
        self.radio.map_or(0, |radio| radio.numbers)
    }

    /// How many rays the sensor of distances has; 0 without one.
    pub fn rays(&self) -> usize {
        self.lidar.map_or(0, |lidar| lidar.rays as usize)
    }

    /// Fails unless all settings are in their ranges and fit each other.
    pub fn check(&self) -> Result<(), SettingsError> {
        let error = |field, message: String| Err(SettingsError { field, message });
        let robots = self.robots();
        if !(1..=MOST_ROBOTS).contains(&robots) {
            return error("robots", format!("{robots} robots; use 1 to {MOST_ROBOTS}"));
        }
        let flies = self.models[0].body().flies();
        let controls = self.models[0].controls();
        let alike =
            |model: &Arc<dyn Model>| model.body().flies() == flies && model.controls() == controls;
        if let Some(other) = self.models.iter().find(|model| !alike(model)) {
            let (first, other) = (self.models[0].name(), other.name());
            let message = format!("`{first}` and `{other}` have different controls; use one kind");
            return error("model", message);
        }
        if self.physics_step.is_zero() {
            return error("physics_step", "it must be longer than 0 s".into());
        }
        if self.steps_per_action == 0 {
            return error("steps_per_action", "it must be at least 1".into());
        }
        if let Some(place) = self.obstacles.iter().position(|one| !one.is_valid()) {
            let message =
                format!("obstacle {place} has numbers that are not finite or not in order");
            return error("obstacles", message);
        }
        if let Some(Lidar { rays, range }) = self.lidar {
            if !(1..=MOST_NUMBERS).contains(&(rays as usize)) {
                return error("lidar", format!("{rays} rays; use 1 to {MOST_NUMBERS}"));
            }
            if !(range > 0.0 && range.is_finite()) {
                return error("lidar", format!("a range of {range} m; use more than 0 m"));
            }
        }
        if let Actions::Waypoints { reach } = self.actions
            && !(reach > 0.0 && reach.is_finite())
        {
            return error("reach", format!("{reach} m; use more than 0 m"));
        }
        if let Some(radio) = self.radio {
            radio.check()?;
        }
        Ok(())
    }
}

impl Radio {
    fn check(&self) -> Result<(), SettingsError> {
        let error = |message: String| {
            let field = "radio";
            Err(SettingsError { field, message })
        };
        let (shortest, longest) = self.delay;
        if !(1..=MOST_NUMBERS).contains(&self.numbers) {
            return error(format!(
                "messages of {} numbers; use 1 to {MOST_NUMBERS}",
                self.numbers
            ));
        }
        if self.range.is_nan() || self.range <= 0.0 {
            return error(format!("a range of {} m; use more than 0 m", self.range));
        }
        if !(0.0..=1.0).contains(&self.loss) {
            return error(format!(
                "a loss of {} is not a probability; use 0 to 1",
                self.loss
            ));
        }
        if shortest > longest || longest > LONGEST_DELAY {
            return error(format!(
                "a delay of {shortest} to {longest} actions; use 0 to {LONGEST_DELAY}, the shortest first"
            ));
        }
        Ok(())
    }
}
