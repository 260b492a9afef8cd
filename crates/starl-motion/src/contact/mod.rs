//! Finds the contacts of bodies within a step, and the positions where those bodies stop.
//!
//! Bodies move along straight lines to their predicted positions. Where paths bend, hosts take a step in
//! [parts](Parts), so that the lines are near the paths. A body that touches another, or an obstacle, stays
//! there for the rest of the step, and may stop others behind it. Contacts are settled in the order of their times, as
//! in a discrete-event simulation of hard spheres (Alder and Wainwright 1959), so that no body is stopped by one that
//! had stopped elsewhere before.

mod impact;
mod parts;

pub use parts::{Parts, bend};

use crate::Impact;
use crate::scene::{Entry, Scene};
use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;
use impact::Leg;
use starl_core::event::Hit;
use starl_core::geometry::Bounds;
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
#[derive(Clone, Copy, Debug)]
pub struct Motions<'a> {
    /// The bodies at the start of the step, and the obstacles.
    scene: Scene<'a>,
    /// The numbers by which contacts name the obstacles, ascending.
    standing: &'a [u32],
    /// Where bodies would be at the end.
    next: &'a [Point],
    /// No body moves farther, metres.
    reach: f64,
}

/// The contacts of a step by robot.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    of_robots: Vec<Option<Contact>>,
    /// The robots for which one was found, some more than once.
    found: Vec<RobotId>,
}

impl<'a> Motions<'a> {
    /// The motions of these bodies to their next positions.
    pub fn new(scene: Scene<'a>, standing: &'a [u32], next: &'a [Point]) -> Motions<'a> {
        let ways = scene.bodies.iter().zip(next);
        let reach = ways
            .map(|(body, next)| body.position.distance(*next))
            .fold(0.0, f64::max);
        Motions {
            scene,
            standing,
            next,
            reach,
        }
    }

    /// Adds the first contact of each of these robots, if no other were stopped.
    pub fn first_contacts(&self, robots: &[Entry], found: &mut Vec<(RobotId, Contact)>) {
        let contacts = robots.iter().filter_map(|entry| {
            let robot = entry.robot();
            Some((robot, self.first_contact(robot, 0.0, |_| 1.0)?))
        });
        found.extend(contacts);
    }

    #[inline]
    fn leg(&self, robot: usize, until: f64) -> Leg {
        Leg::new(&self.scene.bodies[robot], self.next[robot], until)
    }

    /// Visits the robots that may touch one in this step.
    #[inline]
    fn for_each_near(&self, robot: usize, mut visit: impl FnMut(usize)) {
        let Scene { bodies, grid, .. } = self.scene;
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
    fn first_contact(
        &self,
        robot: RobotId,
        since: f64,
        until: impl Fn(usize) -> f64,
    ) -> Option<Contact> {
        let (map, standing) = (self.scene.map, self.standing);
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

impl Contacts {
    /// The contact that stops a robot.
    pub fn of(&self, robot: RobotId) -> Option<&Contact> {
        self.of_robots.get(robot.index())?.as_ref()
    }

    /// Forgets all contacts, and makes room for those of this number of robots.
    fn clear(&mut self, robots: usize) {
        for robot in self.found.drain(..) {
            self.of_robots[robot.index()] = None;
        }
        self.of_robots.resize(robots, None);
    }

    fn insert(&mut self, robot: usize, contact: Contact) {
        self.of_robots[robot] = Some(contact);
        self.found.push(RobotId(robot as u32));
    }

    /// Settles the contacts of a step, given each robot's first contact if no other were stopped.
    pub fn settle(
        &mut self,
        motions: &Motions<'_>,
        first: impl IntoIterator<Item = (RobotId, Contact)>,
    ) {
        let robots = motions.next.len();
        self.clear(robots);
        // Fractions are not negative, so that their bits are in the order of their values.
        let key = |robot: usize, contact: &Contact| Reverse((contact.after.to_bits(), robot));
        let mut due = BinaryHeap::new();
        for (robot, contact) in first {
            due.push(key(robot.index(), &contact));
            self.insert(robot.index(), contact);
        }
        if due.is_empty() {
            return;
        }
        let mut until = vec![1.0; robots];
        let mut is_settled = vec![false; robots];
        while let Some(Reverse((after, robot))) = due.pop() {
            let now = f64::from_bits(after);
            if is_settled[robot] || self.of_robots[robot].is_none_or(|contact| contact.after != now)
            {
                continue;
            }
            (is_settled[robot], until[robot]) = (true, now);
            motions.for_each_near(robot, |other| {
                if is_settled[other] {
                    return;
                }
                let before = &mut self.of_robots[other];
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
                    self.insert(other, fresh);
                }
            });
        }
    }
}
