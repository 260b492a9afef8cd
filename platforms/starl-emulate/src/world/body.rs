//! One body of a [`World`], and the handle by which its device drives it.

use super::{STEP, World};
use starl_core::math::{sincos, wrap_angle};
use starl_core::sensor::Contact;
use starl_core::{Command, Duration, Point, Pose};
use starl_motion::proximity::Rays;
use starl_motion::{Disturbance, Impact, Model, Neighbour, State};
use std::sync::Arc;

/// How far the wheels of a body have driven it since it was added, as its encoders count: slipping and being held up
/// by an obstacle do not show.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Odometer {
    /// Metres ahead less metres backwards.
    pub distance: f64,
    /// Radians to the left less radians to the right; whole turns count.
    pub turn: f64,
}

#[derive(Debug)]
pub(super) struct Body {
    pub name: String,
    pub model: Arc<dyn Model>,
    pub state: State,
    pub command: Command,
    odometer: Odometer,
    /// Unit vector towards what the body touches, world frame.
    touched: Option<Point>,
    /// The world's time of the last step in which something stopped it.
    pub touched_at: Option<Duration>,
}

impl Body {
    pub fn new(name: &str, model: Arc<dyn Model>, pose: Pose) -> Body {
        Body {
            name: name.to_string(),
            state: model.at_rest(pose),
            model,
            command: Command::Stop,
            odometer: Odometer::default(),
            touched: None,
            touched_at: None,
        }
    }

    pub fn neighbour(&self) -> Neighbour {
        let shape = self.model.body();
        Neighbour {
            position: self.state.pose.position,
            velocity: self.state.twist.linear,
            radius: shape.radius,
            height: shape.height,
        }
    }

    pub fn predict(&self, disturbance: &Disturbance) -> State {
        self.model
            .predict(&self.state, &self.command, disturbance, STEP)
    }

    pub fn advance(&mut self, predicted: &State, impact: Option<Impact>) {
        let wheels = self.predict(&Disturbance::default());
        let (sin, cos) = sincos(wheels.pose.yaw);
        let ahead = wheels.twist.linear.dot(Point::planar(cos, sin));
        self.odometer.distance += ahead * STEP.seconds();
        self.odometer.turn += wheels.twist.yaw * STEP.seconds();

        let before = self.state.pose.position;
        self.state = *predicted;
        // A pressed bumper stays pressed until the body moves away.
        if let Some(impact) = impact {
            self.model.stop_at(&mut self.state, impact.place);
            self.touched = Some(impact.direction);
        } else if self.state.pose.position != before {
            self.touched = None;
        }
    }
}

/// A body as its device sees it. Clones are the same body.
#[derive(Clone, Debug)]
pub struct BodyHandle {
    world: World,
    index: usize,
}

impl BodyHandle {
    pub(super) fn new(world: World, index: usize) -> BodyHandle {
        BodyHandle { world, index }
    }

    /// Drives the body with this command until the next one.
    pub fn command(&self, command: Command) {
        self.world.with(self.index, |body| body.command = command);
    }

    /// The true state at the last step.
    pub fn state(&self) -> State {
        self.world.with(self.index, |body| body.state)
    }

    /// The contact of the body, relative to its heading. A touch lasts until the body moves away.
    pub fn bumper(&self) -> Option<Contact> {
        self.world.with(self.index, |body| {
            body.touched.map(|direction| Contact {
                bearing: wrap_angle(direction.heading() - body.state.pose.yaw),
            })
        })
    }

    /// Distances along rays from the body's centre, metres; infinite where a ray meets nothing in its range.
    pub fn scan(&self, rays: &Rays) -> Vec<f64> {
        self.world.scan(self.index, rays)
    }

    /// The counts of the wheels' encoders.
    pub fn odometer(&self) -> Odometer {
        self.world.with(self.index, |body| body.odometer)
    }

    /// The world's time.
    pub fn elapsed(&self) -> Duration {
        self.world.elapsed()
    }

    /// The body's name.
    pub fn name(&self) -> String {
        self.world.with(self.index, |body| body.name.clone())
    }

    /// The kind of robot.
    pub fn model(&self) -> Arc<dyn Model> {
        self.world.with(self.index, |body| body.model.clone())
    }
}
