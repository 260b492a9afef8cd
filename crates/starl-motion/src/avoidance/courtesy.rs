//! Making way at a way-point that several robots want.
//!
//! A robot whose target is taken by a neighbour that is nearer to it waits in front of it, farther out
//! the more neighbours are nearer, and so leaves the nearest one the room to get there and the next
//! one the room to back out. Robots need not tell each other what they want: if the neighbour only
//! passes by, the wait is short. As the neighbour may stand there for good, a robot waits no longer
//! than a random time before it presses on for another.

use crate::pilot::Neighbour;
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

impl Courtesy {
    /// Where to wait for the target to become free; none if it need not.
    pub fn wait(
        &mut self,
        body: &Body,
        cruise_speed: f64,
        gap: f64,
        position: Point,
        target: Point,
        neighbours: &[Neighbour],
        now: Time,
        random: &mut Random,
    ) -> Option<Point> {
        if self.pressing.is_some_and(|until| now < until) {
            return None;
        }
        self.pressing = None;
        let from_target = (position - target).at_height(0.0);
        let distance = from_target.planar_length();
        let (mut taken, mut nearer, mut room) = (false, 0u32, 0.0);
        for neighbour in neighbours {
            let its_distance = neighbour.position.planar_distance(target);
            if its_distance < distance {
                nearer += 1;
                let both = body.radius + neighbour.radius + gap;
                taken |= its_distance < both - gap;
                room = if both > room { both } else { room };
            }
        }
        if !taken || distance <= 0.0 {
            self.until = None;
            return None;
        }
        let seconds = |(low, high): (f64, f64), random: &mut Random| {
            now + Duration::from_seconds_f64(random.between(low, high))
        };
        let until = *self.until.get_or_insert_with(|| seconds(WAIT, random));
        if now >= until {
            self.until = None;
            let way = Duration::from_seconds_f64(distance / cruise_speed.max(0.01));
            self.pressing = Some(seconds(PRESS, random) + way);
            return None;
        }
        let ring = room * (1.0 + STAGGER * f64::from(nearer.min(MOST_AHEAD) - 1)) + SPARE;
        Some(target + from_target * (ring / distance))
    }
}
