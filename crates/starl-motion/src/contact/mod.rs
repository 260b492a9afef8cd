//! Finds the contacts of bodies within a step, and the positions where those bodies stop.
//!
//! Bodies move along straight lines to their predicted positions. A body that touches another, or an obstacle, stays
//! there for the rest of the step, and may stop others behind it. Contacts are settled in the order of their times, as
//! in a discrete-event simulation of hard spheres (Alder and Wainwright 1959), so that no body is stopped by one that
//! had stopped elsewhere before.

mod grid;
mod impact;

pub use grid::{Entry, Grid};

use crate::{Impact, Neighbour};
use alloc::collections::BinaryHeap;
use alloc::vec;
use core::cmp::Reverse;
use impact::Leg;
use starl_core::event::Hit;
use starl_core::geometry::{Bounds, ObstacleIndex};
use starl_core::{Point, RobotId};

/// The contact that stops a body in the step.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// The robot or obstacle that it touches.
    pub with: Hit,
    /// Fraction of the step after which the bodies touch.
    pub after: f64,
    /// Where the body stops.
    pub impact: Impact,
}

/// The motions of a step.
#[derive(Clone, Copy)]
pub struct Motions<'a> {
    /// The bodies at the start of the step.
    pub bodies: &'a [Neighbour],
    /// An index of these bodies.
    pub grid: &'a Grid,
    /// The obstacles.
    pub map: &'a ObstacleIndex,
    /// The numbers by which contacts name the obstacles of `map`, ascending.
    pub standing: &'a [u32],
    /// Where bodies would be at the end.
    pub next: &'a [Point],
    /// No body moves farther, metres.
    pub reach: f64,
}

impl Motions<'_> {
    fn leg(&self, robot: usize, until: f64) -> Leg {
        Leg::new(&self.bodies[robot], self.next[robot], until)
    }

    /// Visits the robots that may touch one in this step.
    fn for_each_near(&self, robot: usize, mut visit: impl FnMut(usize)) {
        let Motions { bodies, grid, .. } = self;
        let body = &bodies[robot];
        let reach = body.radius + grid.greatest_radius() + 2.0 * self.reach;
        grid.for_each_within(body.position, reach, |entry| {
            if entry.robot as usize != robot {
                visit(entry.robot as usize);
            }
        });
    }

    /// A robot's first contact, not before `since`, if each robot moves `until` this fraction of the step.
    #[inline]
    pub fn first_contact(
        &self,
        robot: RobotId,
        since: f64,
        until: impl Fn(usize) -> f64,
    ) -> Option<Contact> {
        let Motions { map, standing, .. } = self;
        let leg = self.leg(robot.index(), 1.0);
        let mut first = f64::INFINITY;
        let mut with = None;
        if leg.from != leg.to {
            let around = Bounds::of_body(leg.from, leg.to, leg.radius, leg.height);
            map.any_near(&around, |index| {
                let obstacle = &map.obstacles()[index as usize];
                if let Some(after) = impact::of_obstacle(&leg, obstacle).filter(|&t| t < first) {
                    first = after;
                    with = Some(Hit::Obstacle(standing[index as usize]));
                }
                false
            });
        }
        self.for_each_near(robot.index(), |other| {
            let path = self.leg(other, until(other));
            if let Some(after) = impact::of_bodies(&leg, &path).filter(|&t| t < first) {
                first = after;
                with = Some(Hit::Robot(RobotId(other as u32)));
            }
        });
        let after = first.max(since);
        let place = leg.at(after);
        let touched = match with? {
            Hit::Robot(other) => self.leg(other.index(), until(other.index())).at(after),
            Hit::Obstacle(world_index) => match standing.binary_search(&world_index) {
                Ok(index) => map.obstacles()[index].nearest_point(place),
                Err(_) => place,
            },
        };
        Some(Contact::new(with?, after, place, touched))
    }

    /// When a robot that moves on runs into one that has stopped at `now`.
    fn meeting(&self, robot: usize, stopped: usize, now: f64) -> Option<Contact> {
        let (leg, resting) = (self.leg(robot, 1.0), self.leg(stopped, now));
        let after = impact::of_bodies(&leg, &resting)?.max(now);
        let with = Hit::Robot(RobotId(stopped as u32));
        Some(Contact::new(with, after, leg.at(after), resting.at(after)))
    }
}

impl Contact {
    fn new(with: Hit, after: f64, place: Point, touched: Point) -> Contact {
        let direction = (touched - place).at_height(0.0).normalized();
        let direction = direction.unwrap_or(Point::planar(1.0, 0.0));
        let impact = Impact { place, direction };
        Contact {
            with,
            after,
            impact,
        }
    }
}

/// The contacts of a step, by robot; at first each robot's first contact if no other were stopped.
pub fn settle(motions: &Motions<'_>, contacts: &mut [Option<Contact>]) {
    // Fractions are not negative, so that their bits are in the order of their values.
    let key = |robot: usize, contact: &Contact| Reverse((contact.after.to_bits(), robot));
    let mut due: BinaryHeap<_> = (0..)
        .zip(contacts.iter())
        .filter_map(|(robot, contact)| Some(key(robot, contact.as_ref()?)))
        .collect();
    if due.is_empty() {
        return;
    }
    let mut until = vec![1.0; contacts.len()];
    let mut is_settled = vec![false; contacts.len()];
    while let Some(Reverse((after, robot))) = due.pop() {
        let now = f64::from_bits(after);
        if is_settled[robot] || contacts[robot].is_none_or(|contact| contact.after != now) {
            continue;
        }
        (is_settled[robot], until[robot]) = (true, now);
        motions.for_each_near(robot, |other| {
            if is_settled[other] {
                return;
            }
            let before = &mut contacts[other];
            let with = Hit::Robot(RobotId(robot as u32));
            let fresh = match before {
                // It is not where the other would have met it.
                Some(contact) if contact.with == with && contact.after > now => {
                    *before = None;
                    motions.first_contact(RobotId(other as u32), now, |other| until[other])
                }
                _ => motions.meeting(other, robot, now),
            };
            if let Some(fresh) = fresh
                && before.is_none_or(|before| fresh.after < before.after)
            {
                due.push(key(other, &fresh));
                *before = Some(fresh);
            }
        });
    }
}
