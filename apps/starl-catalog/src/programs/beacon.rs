//! A robot that stands still and geocasts to its surroundings again and again.

use starl_core::{Area, Duration, Primitives, Program, Robot, Time};
use starl_primitives::Geocast;
use starl_primitives::reliable::Options;

/// The program of one robot.
#[derive(Clone, Debug, Primitives)]
pub struct Beacon {
    geocast: Geocast,
    /// The time from one message to the next.
    pause: Duration,
    /// The radius of the area, metres.
    radius: f64,
    /// When the next message is due. The first one has a random time, so that robots do not send together.
    next: Time,
    sent: u32,
}

impl Beacon {
    /// A robot that has not started.
    pub fn new(pause: Duration, radius: f64) -> Beacon {
        Beacon {
            geocast: Geocast::new("beacon", Options::default()),
            pause,
            radius,
            next: Time::ZERO,
            sent: 0,
        }
    }
}

impl Program for Beacon {
    fn start(&mut self, robot: &mut Robot<'_>) {
        let wait = self.pause.seconds() * robot.random().uniform();
        self.next = robot.now() + Duration::from_seconds_f64(wait);
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.now() >= self.next {
            self.next = robot.now() + self.pause;
            self.sent += 1;
            let center = robot.position();
            let radius = self.radius;
            let area = Area::Circle { center, radius };
            self.geocast.geocast(robot, &self.sent, &area);
        }
    }
}
