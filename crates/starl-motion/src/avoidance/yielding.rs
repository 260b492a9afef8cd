//! Getting out of each other's way: what a robot does when its neighbours leave it no progress.
//!
//! Cells alone keep robots apart but let them block each other: two that meet head-on, or a crowd
//! around one waypoint, stop at the borders between them. A robot that has made no progress for its
//! patience while a neighbour was in the way leaves its course for a while: to the right, or backwards;
//! a car, which gets nowhere else without shunting, straight on or straight back. Direction and time
//! are drawn at random, so robots in the same situation do different things, and the times grow with
//! every vain attempt, as in Ethernet's back-off (Metcalfe and Boggs 1976), until some robot has the
//! room it needs. The robot that is nearest to its own target mostly stands its ground: of robots that
//! want the same point, the others make way.

use super::Options;
use super::cell::Cell;
use super::drive::{Drive, heading};
use super::pace::Pace;
use super::plane::{larger, smaller, turned};
use starl_core::motion::{Body, Estimate};
use starl_core::{Duration, Point, Random, Time, math};

/// Coming nearer to the target by this counts as progress, metres.
const PROGRESS: f64 = 0.03;
/// Coming nearer to the target by this ends the growth of the back-off, metres.
const GOOD_PROGRESS: f64 = 0.2;
/// A robot this near to the place of its detour is there, metres.
const THERE: f64 = 0.1;
/// The way to that place may take so many times what it takes at cruise speed...
const SLOWLY: f64 = 1.5;
/// ... and the time it takes to turn round, seconds.
const TURNING: f64 = 3.0;
/// Time without progress counts for this part while the robot moves: turning round, or passing.
const MOVING: f64 = 0.25;
/// Probability that the robot that is nearest to its target yields.
const FIRST_YIELDS: f64 = 0.25;
/// Probability that another one yields.
const OTHERS_YIELD: f64 = 0.75;
/// After each vain attempt the way of a car grows by this part of the first one.
const LONGER: f64 = 0.25;
/// After each vain attempt the way of a car may bend by this more, in curvatures of its smallest circle...
const MORE_BENT: f64 = 0.25;
/// ... up to this: its centre follows no narrower circle than its axle.
const MOST_BENT: f64 = 0.8;
/// A car turns by at most this on such a way, radians, so that the place of its detour stays before it or behind it.
const MOST_TURN: f64 = 2.0;
/// After this many vain attempts times grow no further.
const MOST_LEVELS: u32 = 4;

/// The surroundings by which a robot judges its progress.
pub(super) struct Scene<'a> {
    pub body: &'a Body,
    pub pace: &'a Pace,
    pub drive: Drive,
    pub estimate: &'a Estimate,
    pub target: Point,
    pub cell: &'a Cell,
    /// Whether avoidance changes its velocity towards the target.
    pub hindered: bool,
}

/// A place off the course, and how long to stay there.
#[derive(Clone, Copy, Debug)]
struct Detour {
    place: Point,
    /// When it must have got there; it stays wherever it is then.
    deadline: Time,
    stay: Duration,
    /// When it goes back on its course, once it is there.
    until: Option<Time>,
}

/// Progress towards the target, and the detour that the robot is on.
#[derive(Clone, Debug)]
pub(super) struct Yielding {
    target: Option<Point>,
    /// Least distance to the target on this attempt, metres.
    nearest: f64,
    /// Least distance when the back-off was last reset, metres.
    record: f64,
    /// Seconds without progress.
    stuck: f64,
    /// Vain attempts since the last good progress.
    level: u32,
    detour: Option<Detour>,
}

impl Default for Yielding {
    fn default() -> Yielding {
        Yielding {
            target: None,
            nearest: f64::INFINITY,
            record: f64::INFINITY,
            stuck: 0.0,
            level: 0,
            detour: None,
        }
    }
}

impl Yielding {
    /// Where to go now: the target, or the place of a detour.
    pub fn destination(&mut self, position: Point, target: Point, now: Time) -> Point {
        if self.target != Some(target) {
            *self = Yielding {
                target: Some(target),
                ..Yielding::default()
            };
        }
        let Some(detour) = &mut self.detour else {
            return target;
        };
        let there = position.planar_distance(detour.place) < THERE || now >= detour.deadline;
        if there && detour.until.is_none() {
            detour.until = Some(now + detour.stay);
        }
        if detour.until.is_none_or(|until| now < until) {
            return detour.place.at_height(position.z);
        }
        self.detour = None;
        self.nearest = f64::INFINITY;
        self.stuck = 0.0;
        target
    }

    /// Whether the robot is on no detour from its way to the target.
    pub fn on_course(&self, target: Point) -> bool {
        self.detour.is_none() || self.target != Some(target)
    }

    /// No robot is near.
    pub fn unhindered(&mut self) {
        self.stuck = 0.0;
    }

    /// Records the progress made and starts a detour when patience has run out.
    pub fn observe(&mut self, options: &Options, scene: &Scene, elapsed: f64, random: &mut Random) {
        if self.detour.is_some() {
            return;
        }
        let position = scene.estimate.pose.position;
        let distance = scene.target.planar_distance(position);
        let moves = scene.pace.moves(scene.estimate);
        self.note_progress(distance, scene.hindered, moves, elapsed);
        if self.stuck <= options.patience {
            return;
        }
        self.stuck = 0.0;
        let first = scene
            .cell
            .borders()
            .iter()
            .all(|border| border.from_target >= distance);
        if random.chance(if first { FIRST_YIELDS } else { OTHERS_YIELD }) {
            self.detour = Some(self.draw(options, scene, random));
            self.level = (self.level + 1).min(MOST_LEVELS);
        }
    }

    fn note_progress(&mut self, distance: f64, hindered: bool, moves: bool, elapsed: f64) {
        if distance < self.nearest - PROGRESS {
            self.nearest = distance;
            self.stuck = 0.0;
        } else if hindered {
            self.stuck += if moves { elapsed * MOVING } else { elapsed };
        }
        if distance < self.record - GOOD_PROGRESS {
            self.record = distance;
            self.level = 0;
        }
    }

    /// A place off the course, and how long to stay there.
    fn draw(&self, options: &Options, scene: &Scene, random: &mut Random) -> Detour {
        let now = scene.estimate.at;
        let way = match scene.drive {
            Drive::Car => self.way_along_arc(scene, random),
            Drive::AnyWay | Drive::OnTheSpot => self.way_aside(scene, random),
        };
        let growth = f64::from(1u32 << self.level);
        let time =
            smaller(options.patience * growth, options.longest_yield) * random.between(0.5, 1.5);
        let takes = way.planar_length() / larger(scene.pace.cruise_speed, 0.01);
        Detour {
            place: scene.estimate.pose.position + way,
            deadline: now + Duration::from_seconds_f64(SLOWLY * takes + TURNING),
            stay: Duration::from_seconds_f64(time),
            until: None,
        }
    }

    /// To the right of the way to the target, or anywhere backwards.
    fn way_aside(&self, scene: &Scene, random: &mut Random) -> Point {
        let towards = (scene.target - scene.estimate.pose.position).at_height(0.0);
        let towards = towards.normalized().unwrap_or(Point::planar(1.0, 0.0));
        let angle = if random.chance(0.5) {
            -random.between(0.3 * math::PI, 0.6 * math::PI)
        } else {
            random.between(0.6 * math::PI, 1.4 * math::PI)
        };
        let distance = random.between(1.0, 2.0)
            * (scene.body.radius + 0.1)
            * (1.0 + 0.5 * f64::from(self.level));
        turned(towards, angle) * distance
    }

    /// Along an arc forwards or backwards, where there is more room: a car gets nowhere else without shunting. The first
    /// arc is straight. Robots that stand at their goals do not make room, and a car that backs and comes straight again
    /// meets them again, so after vain attempts arcs are longer and more bent.
    fn way_along_arc(&self, scene: &Scene, random: &mut Random) -> Point {
        let ahead = heading(scene.estimate);
        let room = |direction| smaller(scene.cell.speed(direction, 0.0), scene.pace.cruise_speed);
        let (forwards, backwards) = (room(ahead), room(-ahead));
        let goes_ahead = forwards > backwards || forwards == backwards && random.chance(0.5);
        let level = f64::from(self.level);
        let length = random.between(1.2, 2.4 * (1.0 + LONGER * level));
        let most_bent = smaller(smaller(MORE_BENT * level, MOST_BENT), MOST_TURN / length);
        let bend = random.between(-1.0, 1.0) * most_bent;
        let axis = if goes_ahead { ahead } else { -ahead };
        turned(axis, 0.5 * length * bend) * (chord(length, bend) * scene.pace.turn_radius)
    }
}

/// The distance between the ends of an arc of a length and a curvature.
fn chord(length: f64, curvature: f64) -> f64 {
    let half = 0.5 * length * curvature;
    if half.abs() < 1e-6 {
        return length;
    }
    let (sine, _) = math::sincos(half);
    length * sine / half
}
