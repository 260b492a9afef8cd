//! Bodies that pass through each other, or through an obstacle, between two recorded poses.
//!
//! From one pose to the next a body is taken to move evenly along a straight line. How far its true path can
//! be from that is estimated from how its motion changes: where the second difference of its poses is some
//! length, the path bulges by at most a quarter of it. So a way is judged once the pose after its end is known;
//! the last way of a record is not judged.

use super::bodies::gap;
use starl_core::geometry::Bounds;
use starl_core::motion::Body;
use starl_core::{Obstacle, Point, RobotId, Time};

/// The way of a body between two poses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub robot: RobotId,
    pub to: Point,
    from: Point,
    body: Body,
    /// The true path may be this far from the straight way, metres.
    slack: f64,
    /// Whether the body moved far enough for its poses to miss a contact: by more than half its radius.
    is_far: bool,
}

/// The poses of all robots at the last three moments, the oldest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Passing {
    moments: [Moment; 3],
}

#[derive(Clone, Debug, Default)]
struct Moment {
    at: Time,
    poses: Vec<Option<Point>>,
}

impl Moment {
    fn pose(&self, robot: usize) -> Option<Point> {
        let pose = self.poses.get(robot).copied().flatten();
        pose.filter(|pose| pose.is_finite())
    }
}

impl Way {
    fn at(&self, part: f64) -> Point {
        self.from.lerp(self.to, part)
    }

    /// The space that the body sweeps.
    pub fn bounds(&self) -> Bounds {
        Bounds::of_body(self.from, self.to, self.body.radius, self.body.height)
    }

    /// How deep the body reaches into an obstacle somewhere on the way, for certain: a negative number, metres.
    pub fn into(&self, obstacle: &Obstacle) -> f64 {
        if !self.is_far {
            return 0.0;
        }
        let Body { radius, height, .. } = self.body;
        let samples = (self.from.distance(self.to) / (0.25 * radius)).min(1000.0) as u32 + 1;
        let depth = |sample: u32| {
            let place = self.at(f64::from(sample) / f64::from(samples));
            obstacle.body_gap(place, radius, height) + self.slack
        };
        (0..=samples).map(depth).fold(0.0, f64::min)
    }

    /// How deep two bodies reach into each other at their closest, for certain: a negative number, metres.
    fn through(&self, other: &Way) -> f64 {
        let apart = self.from - other.from;
        let motion = (self.to - other.to) - apart;
        let gap_at = |part: f64| gap((&self.body, self.at(part)), (&other.body, other.at(part)));
        let nearest = |closing: f64, speed_squared: f64| match speed_squared > 0.0 {
            true => (closing / speed_squared).clamp(0.0, 1.0),
            false => 0.0,
        };
        let planar = nearest(
            -(apart.x * motion.x + apart.y * motion.y),
            motion.x * motion.x + motion.y * motion.y,
        );
        let mut least = gap_at(planar);
        if motion.z != 0.0 {
            // The gap is the greater of those in the plane and of the heights, so it is least between the places where
            // these are.
            let middles = apart.z + 0.5 * (self.body.height - other.body.height);
            let upright = nearest(-middles * motion.z, motion.z * motion.z);
            let places =
                (1..=16).map(|sample| planar + (upright - planar) * f64::from(sample) / 16.0);
            least = places.map(gap_at).fold(least, f64::min);
        }
        least + self.slack + other.slack
    }
}

impl Passing {
    /// A robot was put elsewhere: no way leads there.
    pub fn forget(&mut self, robot: RobotId) {
        for moment in &mut self.moments {
            if let Some(pose) = moment.poses.get_mut(robot.index()) {
                *pose = None;
            }
        }
    }

    /// Adds the poses of a moment. Returns the end of the previous interval, and all robots' paths in it; no paths if
    /// none of them is long enough to hide a contact.
    pub fn close(
        &mut self,
        at: Time,
        poses: &[Option<Point>],
        bodies: &[Body],
    ) -> (Time, Vec<Way>) {
        let [first, start, end] = &self.moments;
        let way = |(index, body): (usize, &Body)| {
            let (from, to) = (start.pose(index)?, end.pose(index)?);
            let bend = |a: Point, b: Point, c: Point| ((c - b) - (b - a)).length();
            let before = first
                .pose(index)
                .map_or(0.0, |before| bend(before, from, to));
            let after = poses[index].map_or(0.0, |after| bend(from, to, after));
            Some(Way {
                robot: RobotId(index as u32),
                from,
                to,
                body: *body,
                slack: 0.25 * (before + after),
                is_far: from.distance(to) > 0.5 * body.radius,
            })
        };
        let mut ways: Vec<Way> = bodies.iter().enumerate().filter_map(way).collect();
        if !ways.iter().any(|way| way.is_far) {
            ways.clear();
        }
        let ended = end.at;
        self.moments.rotate_left(1);
        let [.., last] = &mut self.moments;
        last.at = at;
        last.poses.clear();
        last.poses.extend_from_slice(poses);
        (ended, ways)
    }
}

/// Calls `visit` for each pair of robots that pass through each other by more than `tolerance` metres: sweep
/// and prune along x, as between poses of one moment.
pub(super) fn pairs(ways: &[Way], tolerance: f64, mut visit: impl FnMut(&Way, &Way, f64)) {
    let low = |way: &Way| way.from.x.min(way.to.x) - way.body.radius;
    let high = |way: &Way| way.from.x.max(way.to.x) + way.body.radius;
    let mut order: Vec<&Way> = ways.iter().collect();
    order.sort_by(|a, b| low(a).total_cmp(&low(b)).then(a.robot.cmp(&b.robot)));
    for (index, a) in order.iter().enumerate() {
        let near = order[index + 1..].iter().take_while(|b| low(b) < high(a));
        for b in near.filter(|b| a.is_far || b.is_far) {
            let depth = a.through(b);
            if depth < -tolerance {
                let (a, b) = if a.robot < b.robot { (a, b) } else { (b, a) };
                visit(a, b, depth);
            }
        }
    }
}
