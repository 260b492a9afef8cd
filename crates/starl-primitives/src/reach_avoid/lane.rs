//! How ReachAvoid drives in a lane: along a line up to a limit, and at a distance from the robots on it.
//!
//! Whenever the robot is activated it looks ahead. It stops before it comes too near to a robot that its detector shows,
//! and continues when there is room. The rest of the way is then a command as for [`ReachAvoid::follow`]. The robot never
//! leaves the line to pass another robot.

use super::ReachAvoid;
use crate::sight::{Sight, Sighting};
use alloc::boxed::Box;
use alloc::vec::Vec;
use starl_core::event::ReachAvoidEvent;
use starl_core::{Duration, Point, Random, Robot, Time};

/// A robot that moves stops if the way is not free for this length, metres.
const STOP: f64 = 0.6;
/// A robot that stands continues if the way is free for this length, metres.
const GO: f64 = 0.8;
/// A robot that is so near to the limit has reached it, metres.
const REACHED: f64 = 0.15;

/// A lane that the robot drives in.
#[derive(Clone, Debug)]
pub(super) struct Lane {
    /// Its line.
    line: Vec<Point>,
    /// How far along the line the robot may drive, metres.
    until: f64,
    /// How far along the line it is, metres.
    along: f64,
    /// The limit of the command under way, metres.
    sent: f64,
    sight: Sight,
    /// The robot itself.
    own: Sighting,
}

impl Lane {
    fn new(line: &[Point], until: f64, robot: &Robot<'_>) -> Lane {
        let mut sight = Sight::default();
        sight.look(robot);
        Lane {
            line: line.to_vec(),
            until,
            along: along(line, robot.position()),
            sent: 0.0,
            sight,
            own: Sighting::new(robot.position(), robot.now()),
        }
    }

    /// The first place from `start` to `end` along the line where the robot would be nearer than `gap` to one that has
    /// stood for this time, metres along the line. Robots behind `start` do not count.
    fn conflict(
        &self,
        (start, end): (f64, f64),
        gap: f64,
        standing: Duration,
        now: Time,
    ) -> Option<f64> {
        let here = point_at(&self.line, start)?;
        let reach = end - start + gap;
        let others = self.sight.iter().map(|(_, sighting)| sighting);
        let ahead = others.filter(|other| {
            other.stands(standing, now)
                && here.planar_distance(other.at) < reach
                && along(&self.line, other.at) > start
        });
        ahead
            .filter_map(|other| enters(&self.line, (start, end), other.at, gap))
            .min_by(f64::total_cmp)
    }
}

impl ReachAvoid {
    /// Drives along a line until it is `until` metres from the line's start, and stays in the lane: it stops before a
    /// robot that its detector shows less than [`super::Options::gap`] from the line ahead, and continues when there is
    /// room. The robot starts at the point of the line that is nearest to it. It keeps out of the obstacles that it
    /// knows, as [`ReachAvoid::follow`] does.
    ///
    /// Given again with the same line it moves the limit, without a stop if the limit is farther away. A robot that is
    /// beyond the limit stops. Without points, or where a number is not finite, it is a [`ReachAvoid::stop`].
    ///
    /// The host's own avoidance of robots, which drives round others, is best switched off.
    pub fn drive_lane(&mut self, robot: &mut Robot<'_>, line: &[Point], until: f64) {
        if line.is_empty() || !until.is_finite() || !line.iter().all(|point| point.is_finite()) {
            return self.stop(robot);
        }
        let until = until.min(length(line));
        match &mut self.lane {
            Some(lane) if lane.line == line => lane.until = until,
            Some(lane) => {
                let (sight, own) = (lane.sight.clone(), lane.own);
                **lane = Lane {
                    sight,
                    own,
                    ..Lane::new(line, until, robot)
                };
            }
            None => self.lane = Some(Box::new(Lane::new(line, until, robot))),
        }
        self.proceed(robot);
    }

    /// How far along its lane the robot is, metres; 0 without a lane.
    pub fn along(&self) -> f64 {
        self.lane.as_ref().map_or(0.0, |lane| lane.along)
    }

    /// How far along its lane the robot can drive before it is nearer than [`super::Options::gap`] to a robot in sight
    /// that has stood for this time, metres: the length of the line if no robot is in the way. A robot that was never
    /// seen to move counts as standing. 0 without a lane.
    pub fn free(&self, now: Time, standing: Duration) -> f64 {
        self.lane.as_ref().map_or(0.0, |lane| {
            let end = length(&lane.line);
            let conflict = lane.conflict((lane.along, end), self.options.gap, standing, now);
            conflict.unwrap_or(end)
        })
    }

    /// For how long the robot has stood since it drives in lanes, for whatever reason; zero without a lane.
    pub fn stood(&self, now: Time) -> Duration {
        let lane = self.lane.as_ref();
        lane.map_or(Duration::ZERO, |lane| now.since(lane.own.since))
    }

    /// Whether it drives in a lane: then it looks ahead whenever the robot is activated.
    pub fn is_in_lane(&self) -> bool {
        self.lane.is_some()
    }

    /// Whether it has come to the limit of its lane.
    pub(super) fn is_at_limit(&self) -> Option<bool> {
        let lane = self.lane.as_ref()?;
        Some(lane.along > lane.until - REACHED)
    }

    /// The robot is activated, and looks around.
    pub(super) fn look_ahead(&mut self, robot: &mut Robot<'_>) {
        if let Some(lane) = &mut self.lane {
            lane.sight.look(robot);
            lane.own = lane.own.again(robot.position(), robot.now());
            lane.along = along(&lane.line, robot.position());
            self.proceed(robot);
        }
    }

    /// Stops or continues, depending on the lane and the robots in it.
    fn proceed(&mut self, robot: &mut Robot<'_>) {
        let Some(lane) = &mut self.lane else {
            return;
        };
        let is_moving = self.command.is_some();
        let ahead = if is_moving { STOP } else { GO };
        let (start, end) = (lane.along, lane.until.min(lane.along + ahead));
        let way = (start, end.max(start));
        let is_over = lane.until <= start + REACHED;
        let is_blocked = || {
            let conflict = lane.conflict(way, self.options.gap, Duration::ZERO, robot.now());
            conflict.is_some()
        };
        // Within the last centimetres the command under way brings it to the limit.
        if is_moving && (is_over && lane.until < lane.sent || is_blocked()) {
            self.clear();
            robot.cancel_timer(self.timer());
            robot.report(self.port, ReachAvoidEvent::Stop);
            robot.halt();
        } else if !is_over && (!is_moving && !is_blocked() || is_moving && lane.sent != lane.until)
        {
            lane.sent = lane.until;
            let points = part(&lane.line, start, lane.until);
            let obstacles = robot.obstacles();
            self.set_out_along(robot, &points, obstacles);
        }
    }

    /// Overwrites the state of the lane at random.
    pub(super) fn corrupt_lane(&mut self, random: &mut Random) {
        if random.chance(0.5) {
            self.lane = None;
        }
        if let Some(lane) = &mut self.lane {
            lane.until = random.between(-100.0, 100.0);
            lane.along = random.between(-100.0, 100.0);
            lane.sent = random.between(-100.0, 100.0);
            lane.own.since = Time(u64::from(random.bits()) << 4);
            lane.sight.clear();
        }
    }
}

/// The straight parts of a line, each with its distance along the line.
fn parts(line: &[Point]) -> impl Iterator<Item = (f64, Point, Point)> + '_ {
    let mut passed = 0.0;
    line.windows(2).map(move |ends| {
        let start = passed;
        passed += ends[0].planar_distance(ends[1]);
        (start, ends[0], ends[1])
    })
}

/// How long a line is, metres.
fn length(line: &[Point]) -> f64 {
    parts(line).map(|(_, a, b)| a.planar_distance(b)).sum()
}

/// How far along a line its point that is nearest to `p` is, metres. Of equally near ones the last counts.
fn along(line: &[Point], p: Point) -> f64 {
    let (mut least, mut far) = (f64::INFINITY, 0.0);
    for (start, a, b) in parts(line) {
        let (way, offset) = ((b - a).at_height(0.0), (p - a).at_height(0.0));
        let squared = way.length_squared();
        let share = match squared > 0.0 {
            true => (offset.dot(way) / squared).clamp(0.0, 1.0),
            false => 0.0,
        };
        let apart = offset.distance(way * share);
        if apart <= least {
            (least, far) = (apart, start + share * a.planar_distance(b));
        }
    }
    far
}

/// The point this far along a line: its first point for 0 and less, its last for its length and more.
fn point_at(line: &[Point], far: f64) -> Option<Point> {
    for (start, a, b) in parts(line) {
        let length = a.planar_distance(b);
        if far < start + length {
            return Some(a.lerp(b, ((far - start) / length).max(0.0)));
        }
    }
    line.last().copied()
}

/// The points of a line after `start`, up to `end`, metres along it.
fn part(line: &[Point], start: f64, end: f64) -> Vec<Point> {
    let ends = parts(line).map(|(far, a, b)| (far + a.planar_distance(b), b));
    let between = ends.filter(|&(far, _)| start < far && far < end);
    let mut points: Vec<Point> = between.map(|(_, point)| point).collect();
    points.extend(point_at(line, end));
    points
}

/// Where a robot that goes along a line from `start` to `end` comes nearer than `gap` to `other` first, metres along
/// the line.
fn enters(line: &[Point], (start, end): (f64, f64), other: Point, gap: f64) -> Option<f64> {
    parts(line).find_map(|(far, a, b)| {
        let length = a.planar_distance(b);
        let (first, last) = ((start - far).max(0.0), (end - far).min(length));
        if length <= 0.0 || last < first {
            return None;
        }
        let way = (b - a).at_height(0.0) / length;
        let offset = (other - a).at_height(0.0);
        let foot = offset.dot(way);
        let aside = offset.distance(way * foot);
        if aside >= gap {
            return None;
        }
        let half = starl_core::math::sqrt(gap * gap - aside * aside);
        (foot - half < last && first < foot + half).then(|| far + first.max(foot - half))
    })
}
