//! A simulated device: one of the simulator's robot models, stepped in real time in an empty world.
//!
//! It is for rehearsing a fleet on a desk. The crate `starl-emulate` emulates devices with their own wire protocols, in
//! one world with walls and with each other.

use crate::motors::PositionSource;
use crate::{Device, DeviceError, Reading};
use starl_core::math::wrap_angle;
use starl_core::{Command, Duration, Estimate, Point, Pose, Twist};
use starl_motion::{Disturbance, Model, State};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// The body is computed in steps of this.
const STEP: Duration = Duration::from_millis(5);

/// A body that moves as its model says.
#[derive(Clone, Debug)]
pub struct SimulatedBody(Arc<Mutex<Moving>>);

#[derive(Debug)]
struct Moving {
    model: Arc<dyn Model>,
    state: State,
    command: Command,
    /// Up to when it was computed.
    at: Instant,
}

impl SimulatedBody {
    /// A body that stands still.
    pub fn new(model: Arc<dyn Model>, start: Pose) -> SimulatedBody {
        let state = model.at_rest(start);
        SimulatedBody(Arc::new(Mutex::new(Moving {
            model,
            state,
            command: Command::Stop,
            at: Instant::now(),
        })))
    }

    /// The body's state now.
    pub fn state(&self) -> State {
        self.with(|moving| moving.state)
    }

    /// Its motors and odometry.
    pub fn device(&self) -> SimulatedDevice {
        SimulatedDevice {
            body: self.clone(),
            last: self.state().pose,
            measured: None,
        }
    }

    /// The source of its positions, with this period.
    pub fn positions(&self, period: Duration) -> SimulatedPositions {
        SimulatedPositions {
            body: self.clone(),
            period: period.into(),
            next: Instant::now(),
        }
    }

    fn with<T>(&self, take: impl FnOnce(&mut Moving) -> T) -> T {
        let mut moving = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        moving.advance();
        take(&mut moving)
    }
}

impl Moving {
    fn advance(&mut self) {
        let now = Instant::now();
        while now.saturating_duration_since(self.at) >= STEP.into() {
            let (command, calm) = (self.command, Disturbance::default());
            self.state = self.model.predict(&self.state, &command, &calm, STEP);
            self.at += std::time::Duration::from(STEP);
        }
    }
}

/// A body that stands is measured this often.
const STANDING: std::time::Duration = std::time::Duration::from_millis(50);

/// The motors and the odometry of a [`SimulatedBody`].
#[derive(Debug)]
pub struct SimulatedDevice {
    body: SimulatedBody,
    last: Pose,
    /// When it measured last.
    measured: Option<Instant>,
}

impl Device for SimulatedDevice {
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        self.body.with(|moving| moving.command = *command);
        Ok(())
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        self.body.with(|moving| {
            let lands = moving.model.accepts(&Command::Land);
            moving.command = if lands { Command::Land } else { Command::Stop };
        });
        Ok(())
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        let state = self.body.state();
        let now = Instant::now();
        let is_recent = |at| now.saturating_duration_since(at) < STANDING;
        if state.pose == self.last && self.measured.is_some_and(is_recent) {
            return Ok(None);
        }
        self.measured = Some(now);
        let before = std::mem::replace(&mut self.last, state.pose);
        Ok(Some(reading(&before, &state.pose, &state.twist)))
    }
}

/// The measurements of a body that has moved from one pose to another.
pub(crate) fn reading(before: &Pose, now: &Pose, twist: &Twist) -> Reading {
    let in_frame = |vector: Point, yaw: f64| {
        let (sin, cos) = yaw.sin_cos();
        Point::new(
            vector.x * cos + vector.y * sin,
            vector.y * cos - vector.x * sin,
            vector.z,
        )
    };
    Reading {
        moved: Some(in_frame(now.position - before.position, before.yaw)),
        turned: Some(wrap_angle(now.yaw - before.yaw)),
        velocity: Some(in_frame(twist.linear, now.yaw)),
        height: Some(now.position.z),
        ..Reading::default()
    }
}

/// Tells where a [`SimulatedBody`] is.
#[derive(Debug)]
pub struct SimulatedPositions {
    body: SimulatedBody,
    period: std::time::Duration,
    next: Instant,
}

impl PositionSource for SimulatedPositions {
    fn poll(&mut self) -> Result<Option<(Instant, Pose)>, DeviceError> {
        let now = Instant::now();
        if now < self.next {
            return Ok(None);
        }
        self.next = now + self.period;
        Ok(Some((now, self.body.state().pose)))
    }
}
