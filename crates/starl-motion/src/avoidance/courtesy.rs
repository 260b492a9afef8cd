//! Making way at a waypoint that several robots head for.
//!
//! If a neighbour that is nearer occupies a robot's target, the robot waits in front of it, farther
//! out if more neighbours are nearer. So the nearest one has room to get there, and the next one has
//! room to back out. Robots need not communicate their targets: if the neighbour only passes by, the
//! wait is short. Because the neighbour may stay there permanently, a robot waits only for a random
//! time before it drives on for another.

use super::plane::larger;
use crate::Neighbour;
use starl_core::motion::Body;
use starl_core::{Duration, Point, Random, Time};

/// Room beyond what the two bodies need, metres.
const SPARE: f64 = 0.1;
/// How much farther out the next robot waits, as a part of the room that two bodies need.
const STAGGER: f64 = 0.5;
/// No more than so many robots ahead of it make a robot wait farther out.
const MOST_AHEAD: u32 = 4;
/// Bounds of the time a robot waits, seconds.
const WAIT: (f64, f64) = (6.0, 12.0);
/// Bounds of the time it then presses on, seconds, beyond the time it takes to get there.
const PRESS: (f64, f64) = (3.0, 6.0);

/// How long a robot has waited.
#[derive(Clone, Debug, Default)]
pub(super) struct Courtesy {
    /// When waiting ends; none if it does not wait.
    until: Option<Time>,
    /// When pressing on ends.
    pressing: Option<Time>,
}

/// A robot and the target that it may have to wait for.
pub(super) struct Queue<'a> {
    pub body: &'a Body,
    /// Metres per second.
    pub cruise_speed: f64,
    /// Gap to keep between bodies, metres.
    pub gap: f64,
    pub position: Point,
    pub target: Point,
    pub neighbours: &'a [Neighbour],
}

impl Queue<'_> {
    /// How far from the target to wait, metres; none if it is free, or this robot is the nearest.
    fn ring(&self, distance: f64) -> Option<f64> {
        let (mut taken, mut nearer, mut room) = (false, 0, 0.0);
        for neighbour in self.neighbours {
            let its_distance = neighbour.position.planar_distance(self.target);
            if its_distance < distance {
                let radii = self.body.radius + neighbour.radius;
                nearer += 1;
                taken |= its_distance < radii;
                room = larger(room, radii + self.gap);
            }
        }
        let others = f64::from(u32::min(nearer, MOST_AHEAD)) - 1.0;
        taken.then_some(room * (1.0 + STAGGER * others) + SPARE)
    }
}

impl Courtesy {
    /// Where to wait for the target to become free; none if the robot need not wait.
    pub fn wait(&mut self, queue: &Queue, now: Time, random: &mut Random) -> Option<Point> {
        if self.pressing.is_some_and(|until| now < until) {
            return None;
        }
        self.pressing = None;
        let out = (queue.position - queue.target).at_height(0.0);
        let distance = out.planar_length();
        let Some(ring) = queue.ring(distance) else {
            self.until = None;
            return None;
        };
        let mut after =
            |(low, high): (f64, f64)| now + Duration::from_seconds_f64(random.between(low, high));
        let until = *self.until.get_or_insert_with(|| after(WAIT));
        if now >= until {
            let way = Duration::from_seconds_f64(distance / larger(queue.cruise_speed, 0.01));
            self.pressing = Some(after(PRESS) + way);
            self.until = None;
            return None;
        }
        Some(queue.target + out * (ring / distance))
    }
}
