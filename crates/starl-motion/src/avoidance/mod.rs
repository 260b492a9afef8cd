//! Reciprocal avoidance: keeps robots from colliding with each other and with obstacles, and from
//! blocking each other for ever.
//!
//! At each position estimate, each robot confines the point where it can stop to its own buffered
//! Voronoi cell (Zhou, Wang, Bandyopadhyay and Schwager 2017, "Fast, on-line collision avoidance for
//! dynamic vehicles using buffered Voronoi cells"). It uses only its perception of its neighbours:
//! no messages, no agreement, no order among robots.
//!
//! Where ours differs: borders lie between the segments in which robots can stop, not between points,
//! so robots with inertia are covered, and obstacles are borders too (`surroundings.rs`); borders
//! split the gap between two bodies, not the distance of their centres; the nearest velocity replaces
//! the paper's receding-horizon programme (`cell.rs`); robots on wheels and cars are limited by where
//! they are heading (`drive.rs`); heights count (`height.rs`). Against deadlock, robots pass on the
//! right (`passing.rs`), make way at a contested waypoint (`courtesy.rs`), and yield at random when
//! they get no farther (`yielding.rs`), instead of the paper's fixed right-hand rule.
//!
//! `docs/explanation/avoidance.md` states the guarantees and their assumptions.

mod cell;
mod courtesy;
mod drive;
mod height;
mod options;
mod pace;
mod passing;
mod plane;
mod surroundings;

mod yielding;

pub use options::Options;
pub(crate) use surroundings::OBSTACLE_MARGIN;

use crate::Limits;
use crate::Neighbour;
use crate::tracking::Goal;
use courtesy::{Courtesy, Queue};
use drive::Drive;
pub(crate) use drive::Driven;
use pace::Pace;
use plane::{larger, smaller};
use smallvec::SmallVec;
use starl_core::motion::{Body, Estimate};
use starl_core::{Obstacle, Point, Random, Time};
use surroundings::Surroundings;
use yielding::{Scene, Yielding};

/// Part of the longest time between two estimates that is still reckoned with at the next one.
const FORGETTING: f64 = 0.98;

/// The avoidance of one robot.
#[derive(Clone, Debug)]
pub struct Avoidance {
    options: Options,
    /// When the last estimate was taken.
    last: Option<Time>,
    /// Seconds that may pass between two estimates; longer for a while after a longer gap.
    period: f64,
    courtesy: Courtesy,
    yielding: Yielding,
}

impl Avoidance {
    /// Avoidance for a robot that has not moved yet.
    pub fn new(options: Options) -> Avoidance {
        Avoidance {
            last: None,
            period: options.period,
            courtesy: Courtesy::default(),
            yielding: Yielding::default(),
            options,
        }
    }

    /// Distance between centres, metres, within which neighbours must be passed to avoidance when it guides the robot.
    pub fn range(&self, body: &Body, limits: &Limits) -> f64 {
        let room = Pace::new(limits, self.period).room_needed + self.options.margin;
        // A neighbour that comes as fast is known a period late.
        let late = limits.speed * self.period;
        let braking = 2.0 * room + late;
        let passing = limits.cruise_speed * passing::AHEAD + 2.0 * self.options.margin;
        body.radius + self.options.largest_radius + larger(braking, passing)
    }

    /// The goal to track until the next estimate: a point to head for and a limit of speed with which the robot stays
    /// in its own cell. If no neighbour matters this is `goal` itself.
    ///
    /// A flying robot that is still on the ground must stay there while the height of the returned goal is below its
    /// lowest height of travel: another robot is above it.
    pub(crate) fn guide(
        &mut self,
        driven: Driven,
        estimate: &Estimate,
        goal: &Goal,
        neighbours: &[Neighbour],
        obstacles: &[Obstacle],
        random: &mut Random,
    ) -> Goal {
        let model = driven.model;
        let elapsed = self.note_time(estimate.at);
        let (body, pace) = (&model.body(), &Pace::new(&model.limits(), self.period));
        let goal = &Goal {
            target: goal.target.at_height(self.height(
                body,
                pace,
                estimate,
                goal.target.z,
                neighbours,
            )),
            ..*goal
        };
        // From here on only robots at the same height count.
        let neighbours: SmallVec<[Neighbour; 12]> = neighbours
            .iter()
            .filter(|neighbour| !self.is_clear_in_height(body, pace, estimate, neighbour))
            .copied()
            .collect();
        let around = Surroundings {
            body,
            pace,
            estimate,
            neighbours: &neighbours,
            obstacles,
            target: goal.target,
            margin: self.options.margin,
            period: self.period,
            braking_way: model.braking_way(estimate),
        };
        self.guide_among(&driven, &around, goal, elapsed, random)
    }

    /// [`Avoidance::guide`] among neighbours at the same height.
    fn guide_among(
        &mut self,
        driven: &Driven,
        around: &Surroundings,
        goal: &Goal,
        elapsed: f64,
        random: &mut Random,
    ) -> Goal {
        let Surroundings {
            body,
            pace,
            estimate,
            neighbours,
            ..
        } = *around;
        let drive = Drive::of(driven.model);
        let cell = around.cell();
        if neighbours.is_empty() && cell.is_empty() && self.yielding.on_course(goal.target) {
            self.yielding.unhindered();
            return *goal;
        }
        let position = estimate.pose.position;
        let destination = self.destination(around, random);
        let on_course = destination == goal.target;
        let way = (destination - position).at_height(0.0);
        let wish = pace.wish(way, goal.speed_limit);
        let gap = 2.0 * self.options.margin;
        let passes = passing::in_the_way(body, gap, way, wish, position, neighbours);
        if on_course && passes.is_none() && cell.is_empty() {
            self.yielding.unhindered();
        }
        let mut velocity = cell.velocity(wish);
        if let Some(neighbour) = passes {
            velocity = passing::velocity(&cell, &neighbour, wish, velocity);
        }
        let straight = velocity == wish && on_course;
        let ahead = velocity.normalized().unwrap_or(Point::ZERO);
        let off_course = |speed: f64| Goal {
            target: (position + ahead * drive.step(pace, estimate, ahead, speed))
                .at_height(goal.target.z),
            next: None,
            speed_limit: smaller(goal.speed_limit, speed),
        };
        let tracked = match straight {
            true => *goal,
            false => off_course(velocity.planar_length()),
        };
        let limit = drive.speed_limit(driven, pace, estimate, &cell, velocity, &tracked);
        let scene = Scene {
            body,
            pace,
            drive,
            estimate,
            target: goal.target,
            cell: &cell,
            hindered: on_course
                && !neighbours.is_empty()
                && (velocity != wish || limit < 0.5 * wish.planar_length()),
        };
        self.yielding
            .observe(&self.options, &scene, elapsed, random);

        if straight {
            return Goal {
                speed_limit: smaller(goal.speed_limit, limit),
                ..*goal
            };
        }
        off_course(smaller(velocity.planar_length(), limit))
    }

    /// Where to go now: the target, a place to wait for it, or the place of a detour.
    fn destination(&mut self, around: &Surroundings, random: &mut Random) -> Point {
        let Surroundings {
            estimate, target, ..
        } = *around;
        let position = estimate.pose.position;
        let place = self.yielding.destination(position, target, estimate.at);
        if place != target {
            return place;
        }
        let queue = Queue {
            body: around.body,
            cruise_speed: around.pace.cruise_speed,
            gap: 2.0 * self.options.margin,
            position,
            target,
            neighbours: around.neighbours,
        };
        self.courtesy
            .wait(&queue, estimate.at, random)
            .unwrap_or(target)
    }

    /// For a while the robot was not guided: the time until the next estimate says nothing.
    pub(crate) fn interrupt(&mut self) {
        self.last = None;
    }

    /// Seconds since the last estimate.
    fn note_time(&mut self, now: Time) -> f64 {
        let elapsed = self.last.map_or(0.0, |last| now.since(last).seconds());
        self.last = Some(now);
        let longest = larger(elapsed, FORGETTING * self.period);
        self.period = larger(self.options.period, longest);
        elapsed
    }
}
