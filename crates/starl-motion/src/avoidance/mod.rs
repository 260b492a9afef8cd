//! Reciprocal avoidance: keeps robots from colliding with each other, and from blocking each other
//! for ever.
//!
//! Each robot, at each position estimate, confines the point where it can stop to its own buffered
//! Voronoi cell (Zhou, Wang, Bandyopadhyay and Schwager 2017, "Fast, on-line collision avoidance for
//! dynamic vehicles using buffered Voronoi cells"), from nothing but what it perceives of its
//! neighbours: no messages, no agreement, no order among robots.
//!
//! Where ours differs: a border splits the gap between two bodies instead of the distance of their
//! centres; it is the stopping point that stays inside, so robots with inertia are covered; a limit
//! of speed per direction replaces the paper's receding-horizon programme; heights count; and a robot
//! without progress yields at random (`yielding.rs`) instead of by a fixed right-hand rule.
//!
//! What is guaranteed, and under which assumptions, is in `docs/explanation/avoidance.md`.

mod cell;
mod courtesy;
mod height;
mod options;
mod passing;
mod yielding;

pub use options::Options;

use crate::Limits;
use crate::pilot::Neighbour;
use crate::tracking::Goal;
use cell::{Border, Cell, between_segments, larger, smaller};
use courtesy::Courtesy;
use passing::Passing;
use smallvec::SmallVec;
use starl_core::motion::{Body, Estimate};
use starl_core::{Obstacle, Point, Random, Time, math};
use yielding::Yielding;

/// Estimates that a robot waits for until it may have used up its room: the stopping point closes in
/// on a border by this fraction of the room a period, or less. Anything above Euler's number keeps
/// two robots that see each other one period late from overshooting.
const PERIODS_AHEAD: f64 = 3.0;

/// Where a robot does not go straight to its goal it is given a point so many seconds ahead: far
/// enough that it need not slow down for it, near enough that a robot on wheels steers towards it.
const LOOK_AHEAD: f64 = 1.5;

/// That point is at least this far away, metres, so that trackers do not take it for reached.
const LEAST_STEP: f64 = 0.2;

/// A robot on wheels is given a point this near behind it, metres, so that it backs up instead of
/// turning round.
const STEP_BACK: f64 = 0.12;

/// A robot that may be on wheels and heads for a border crawls at this part of its cruise speed, to
/// find out whether it is.
const CRAWL: f64 = 0.02;

/// Below this part of its cruise speed a car may still choose its direction.
const CREEP: f64 = 0.05;

/// A robot that has turned through this angle without moving sideways is on wheels, radians.
const TURNED: f64 = 0.3;

/// Slower motion says nothing of how a robot moves, metres per second.
const SIDLING_SPEED: f64 = 0.02;

/// Room kept to obstacles while a robot is off its planned path, metres.
const OBSTACLE_MARGIN: f64 = 0.02;

/// The avoidance of one robot.
#[derive(Clone, Debug)]
pub struct Avoidance {
    options: Options,
    last: Option<Time>,
    period: f64,
    /// Whether it has been seen to move sideways: then its heading says nothing of where it goes.
    sidles: bool,
    /// Angle it has been seen to turn through in all, radians.
    turned: f64,
    courtesy: Courtesy,
    yielding: Yielding,
}

impl Avoidance {
    /// Avoidance for a robot that has not moved yet.
    pub fn new(options: Options) -> Avoidance {
        let period = options.period;
        Avoidance {
            options,
            last: None,
            period,
            sidles: false,
            turned: 0.0,
            courtesy: Courtesy::default(),
            yielding: Yielding::default(),
        }
    }

    /// Distance between centres, metres, within which neighbours must be handed to
    /// [`Avoidance::guide`].
    pub fn range(&self, body: &Body, limits: &Limits) -> f64 {
        let room = Pace::new(limits, self.period).room_needed + self.options.margin;
        // A neighbour that comes as fast is known a period late.
        let late = limits.speed * self.period;
        let braking = 2.0 * room + late;
        let passing = limits.cruise_speed * passing::AHEAD + 2.0 * self.options.margin;
        body.radius + self.options.largest_radius + larger(braking, passing)
    }

    /// The goal to track until the next estimate: a point of the robot's own cell and a limit of
    /// speed at which it cannot leave the cell. Without a neighbour near enough to matter this is
    /// `goal` itself.
    ///
    /// A robot that flies and is still on the ground is to stay there while the height of the goal
    /// returned is below its lowest height of travel: someone is above it.
    #[allow(clippy::too_many_arguments)]
    pub fn guide(
        &mut self,
        body: &Body,
        limits: &Limits,
        estimate: &Estimate,
        goal: &Goal,
        neighbours: &[Neighbour],
        obstacles: &[Obstacle],
        random: &mut Random,
    ) -> Goal {
        let elapsed = self.note_time(estimate.at);
        self.note_motion(estimate, elapsed);
        let pace = Pace::new(limits, self.period);
        let height = self.height(body, &pace, estimate, goal.target.z, neighbours);
        // From here on only robots at the same height count.
        let neighbours: SmallVec<[Neighbour; 12]> = neighbours
            .iter()
            .filter(|neighbour| !self.is_clear_in_height(body, &pace, estimate, neighbour))
            .copied()
            .collect();
        let neighbours = &neighbours[..];
        let mut cell = self.cell(body, &pace, estimate, neighbours);
        let position = estimate.pose.position;
        let gap = 2.0 * self.options.margin;
        let mut destination = self
            .yielding
            .destination(position, goal.target, estimate.at);
        if destination == goal.target
            && let Some(place) = self.courtesy.wait(
                body,
                pace.cruise_speed,
                gap,
                position,
                goal.target,
                neighbours,
                estimate.at,
                random,
            )
        {
            destination = place;
        }
        let on_course = destination == goal.target;
        let way = (destination - position).at_height(0.0);
        let distance = way.planar_length();
        let wish = pace.wish(way, distance, goal.speed_limit);
        let passing = Passing {
            body,
            position,
            destination,
            neighbours,
            gap,
        };
        let in_the_way = passing.in_the_way(wish);
        if cell.is_empty() && on_course && in_the_way.is_none() {
            self.yielding.unhindered();
            return Goal {
                target: goal.target.at_height(height),
                ..*goal
            };
        }
        let mut velocity = cell.velocity(wish);
        if velocity != wish || !on_course || in_the_way.is_some() {
            add_obstacles(&mut cell, &pace, body, estimate, obstacles);
            velocity = cell.velocity(wish);
        }
        if let Some(in_the_way) = in_the_way {
            velocity = passing::velocity(&cell, &in_the_way, wish, velocity);
        }
        let ahead = velocity.normalized().unwrap_or(Point::ZERO);
        let limit = self.speed_limit(body, &pace, estimate, &cell, ahead);
        let hindered = on_course && (velocity != wish || limit < 0.5 * wish.planar_length());
        let scene = yielding::Scene {
            body,
            position,
            moves: moves(&pace, estimate),
            cruise_speed: pace.cruise_speed,
            target: goal.target,
            neighbours,
            cell: &cell,
        };
        self.yielding.observe(
            &self.options,
            &scene,
            hindered,
            elapsed,
            estimate.at,
            random,
        );

        if velocity == wish && on_course {
            return Goal {
                target: goal.target.at_height(height),
                next: goal.next,
                speed_limit: smaller(goal.speed_limit, limit),
            };
        }
        let speed = smaller(velocity.planar_length(), limit);
        Goal {
            target: (position + ahead * self.step(body, estimate, ahead, speed)).at_height(height),
            next: None,
            speed_limit: smaller(goal.speed_limit, speed),
        }
    }

    /// Seconds since the last estimate; remembers the longest of late.
    fn note_time(&mut self, now: Time) -> f64 {
        let elapsed = self.last.map_or(0.0, |last| now.since(last).seconds());
        self.last = Some(now);
        self.period = larger(self.options.period, elapsed);
        elapsed
    }

    /// The robot's cell, without borders so far away that they do not matter before the next
    /// estimate.
    fn cell(
        &self,
        body: &Body,
        pace: &Pace,
        estimate: &Estimate,
        neighbours: &[Neighbour],
    ) -> Cell {
        let mut cell = Cell::default();
        let position = estimate.pose.position;
        let own_way = estimate.twist.linear.at_height(0.0) * pace.braking_time;
        for (index, neighbour) in neighbours.iter().enumerate() {
            let offset = (neighbour.position - position).at_height(0.0);
            let distance = offset.planar_length();
            let radii = body.radius + neighbour.radius;
            let near = 2.0 * (pace.room_needed + self.options.margin) + self.late(neighbour);
            if distance - radii > near {
                continue;
            }
            // What is known of the neighbour may be a period old.
            let its_way = neighbour.velocity.at_height(0.0) * (pace.braking_time + self.period);
            let apart = between_segments(own_way, offset, its_way);
            let gap = apart.planar_length();
            let normal = match (apart.normalized(), offset.normalized()) {
                (Some(normal), _) | (None, Some(normal)) => normal,
                // At the very same place: any direction will do.
                (None, None) => Point::planar(1.0, 0.0),
            };
            let room = 0.5 * (gap - radii) - self.options.margin;
            let speed = room / pace.horizon;
            if speed < pace.cruise_speed {
                cell.push(Border {
                    normal,
                    speed,
                    neighbour: index as u32,
                });
            }
        }
        cell
    }

    /// The greatest speed in a direction, metres per second, at which the stopping point is still in
    /// the cell when the next estimates have come.
    fn speed_limit(
        &self,
        body: &Body,
        pace: &Pace,
        estimate: &Estimate,
        cell: &Cell,
        ahead: Point,
    ) -> f64 {
        let speed = cell.speed(ahead);
        if body.flies() || self.sidles {
            return speed;
        }
        // On wheels: until it has turned, the robot goes where it is heading now.
        let (sine, cosine) = math::sincos(estimate.pose.yaw);
        let heading = Point::planar(cosine, sine);
        if pace.turn_radius > 0.0 {
            return car_speed_limit(pace, estimate, cell, heading);
        }
        let backwards = heading.dot(ahead) < 0.0;
        let course = if backwards { -heading } else { heading };
        let between = (course + ahead).normalized().unwrap_or(course);
        let speed = smaller(speed, smaller(cell.speed(course), cell.speed(between)));
        let known_to_roll = self.turned > TURNED;
        if known_to_roll {
            speed
        } else {
            larger(speed, CRAWL * pace.cruise_speed)
        }
    }

    /// How far ahead to put the point to track, metres.
    fn step(&self, body: &Body, estimate: &Estimate, ahead: Point, speed: f64) -> f64 {
        let (sine, cosine) = math::sincos(estimate.pose.yaw);
        let behind = cosine * ahead.x + sine * ahead.y < -0.5;
        if behind && !body.flies() && !self.sidles {
            return STEP_BACK;
        }
        larger(speed * LOOK_AHEAD, LEAST_STEP)
    }

    /// Takes note of a ground robot that moves otherwise than along its heading.
    fn note_motion(&mut self, estimate: &Estimate, elapsed: f64) {
        let velocity = estimate.twist.linear.at_height(0.0);
        self.turned += estimate.twist.yaw.abs() * elapsed;
        let (sine, cosine) = math::sincos(estimate.pose.yaw);
        let across = velocity.cross_planar(Point::planar(cosine, sine)).abs();
        let speed = velocity.planar_length();
        self.sidles |= speed > SIDLING_SPEED && across > 0.7 * speed;
    }

    /// Metres a neighbour may have come nearer since it was seen.
    fn late(&self, neighbour: &Neighbour) -> f64 {
        neighbour.velocity.planar_length() * self.period
    }
}

/// How a robot stops and how far ahead it has to think.
#[derive(Clone, Copy, Debug)]
struct Pace {
    /// Metres; 0 for a robot that turns on the spot.
    turn_radius: f64,
    cruise_speed: f64,
    /// Seconds for which its speed carries on when it brakes: stopping distance over cruise speed.
    /// As the distance grows faster than the speed, or just as fast, this does for lower speeds too.
    /// Nothing for a robot that changes its speed at once.
    braking_time: f64,
    /// Seconds in which it may use up the room left beyond its stopping point, or more.
    horizon: f64,
    /// Metres that it needs to stop from its cruise speed, until it has noticed included.
    room_needed: f64,
}

impl Pace {
    fn new(limits: &Limits, period: f64) -> Pace {
        let cruise_speed = limits.cruise_speed;
        let at_once = limits.acceleration == f64::INFINITY || cruise_speed <= 0.0;
        let braking_time = if at_once {
            0.0
        } else {
            limits.stopping_distance / cruise_speed
        };
        let horizon = PERIODS_AHEAD * period + 0.45 * braking_time;
        let room_needed = cruise_speed * (braking_time + horizon);
        Pace {
            turn_radius: limits.turn_radius,
            cruise_speed,
            braking_time,
            horizon,
            room_needed,
        }
    }

    /// The velocity that the robot would like to have `way` before its destination.
    fn wish(&self, way: Point, distance: f64, speed_limit: f64) -> Point {
        if distance <= 0.0 {
            return Point::ZERO;
        }
        let slowing = distance / (self.braking_time + self.horizon);
        way * (smaller(smaller(self.cruise_speed, speed_limit), slowing) / distance)
    }

    /// How fast it may go along a normal when the border is `room` metres ahead: so that its stopping
    /// point stays behind the border; backwards where it is beyond the border itself.
    fn speed_towards(&self, normal: Point, room: f64, estimate: &Estimate) -> f64 {
        let coast = larger(estimate.twist.linear.dot(normal), 0.0) * self.braking_time;
        smaller(larger(room - coast, 0.0), room) / self.horizon
    }
}

/// The same for a robot with a turning radius: whatever it is told, it goes on along its course, and
/// from a stand forwards or backwards as its tracker sees fit.
fn car_speed_limit(pace: &Pace, estimate: &Estimate, cell: &Cell, heading: Point) -> f64 {
    let velocity = estimate.twist.linear.at_height(0.0);
    match velocity.normalized() {
        Some(course) if velocity.planar_length() > CREEP * pace.cruise_speed => cell.speed(course),
        _ => smaller(cell.speed(heading), cell.speed(-heading)),
    }
}

/// Whether the robot drives or turns, rather than standing still.
fn moves(pace: &Pace, estimate: &Estimate) -> bool {
    let twist = &estimate.twist;
    twist.linear.planar_length() > 0.2 * pace.cruise_speed || twist.yaw.abs() > 0.2
}

/// Adds the borders of nearby obstacles, which no robot shares: they keep a robot that is off its
/// planned path from sliding into a wall.
fn add_obstacles(
    cell: &mut Cell,
    pace: &Pace,
    body: &Body,
    estimate: &Estimate,
    obstacles: &[Obstacle],
) {
    let position = estimate.pose.position;
    for obstacle in obstacles {
        let beside = obstacle
            .height()
            .is_none_or(|span| span.low < position.z + body.height && position.z < span.high);
        let room = obstacle.body_gap(position, body.radius, body.height) - OBSTACLE_MARGIN;
        // A body that reaches into an obstacle is not the business of avoidance: it may go anywhere.
        if !beside || room >= pace.room_needed || obstacle.contains(position) {
            continue;
        }
        let room = larger(room, 0.0);
        let towards = (obstacle.nearest_point(position) - position).at_height(0.0);
        if let Some(normal) = towards.normalized() {
            let speed = pace.speed_towards(normal, room, estimate);
            cell.push(Border {
                normal,
                speed,
                neighbour: u32::MAX,
            });
        }
    }
}
