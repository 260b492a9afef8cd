//! The robots that a detector shows, and for how long each of them has stood.
//!
//! A robot that has left the view is forgotten. Where it comes back it counts as one that was never seen to move.

use alloc::collections::BTreeMap;
use starl_core::sensor::Detected;
use starl_core::{Duration, Point, Robot, RobotId, Time};

/// A robot that moves by less than this stands, metres. It is more than the noise of positions.
const STILL: f64 = 0.1;

/// The robots in sight.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sight {
    robots: BTreeMap<RobotId, Sighting>,
}

/// A robot in sight.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sighting {
    /// Where it is, metres.
    pub at: Point,
    /// Where it was when it came to stand, metres.
    stood: Point,
    /// Since when it has stood there.
    pub since: Time,
    /// Whether it was ever seen to move.
    pub has_moved: bool,
}

impl Sighting {
    /// A robot that was not seen before.
    pub fn new(at: Point, now: Time) -> Sighting {
        Sighting {
            at,
            stood: at,
            since: now,
            has_moved: false,
        }
    }

    /// The same robot, seen again.
    pub fn again(self, at: Point, now: Time) -> Sighting {
        // A fault may have put `since` into the future.
        match self.stood.distance(at) < STILL && self.since <= now {
            true => Sighting { at, ..self },
            false => Sighting {
                has_moved: true,
                ..Sighting::new(at, now)
            },
        }
    }

    /// Whether it has stood for this time. One that was never seen to move has.
    pub fn stands(&self, time: Duration, now: Time) -> bool {
        !self.has_moved || now.since(self.since) >= time
    }
}

impl Sight {
    /// Takes the readings of the detector, which a robot has when it is activated.
    pub fn look(&mut self, robot: &Robot<'_>) {
        let now = robot.now();
        let before = core::mem::take(&mut self.robots);
        for detection in robot.sensors().detections {
            if let Detected::Robot(id) = detection.what {
                let at = detection.position;
                let seen = match before.get(&id) {
                    Some(sighting) => sighting.again(at, now),
                    None => Sighting::new(at, now),
                };
                self.robots.insert(id, seen);
            }
        }
    }

    /// The robots in sight, by number.
    pub fn iter(&self) -> impl Iterator<Item = (RobotId, &Sighting)> {
        self.robots.iter().map(|(&id, sighting)| (id, sighting))
    }

    /// All robots are forgotten.
    pub fn clear(&mut self) {
        self.robots.clear();
    }
}
