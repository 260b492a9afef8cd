//! When moving bodies first touch: times of impact of upright cylinders that move along straight lines.
//!
//! Times are fractions of a physics step. Within a part of the step in which neither body stops, the
//! gap between two discs is that of a point and a disc of both radii, so the time of impact is the
//! root of a quadratic (Ericson 2005, "Real-Time Collision Detection", 5.5.5). The planar gap to a
//! convex obstacle is a convex function of time: whether it falls below zero is found by ternary
//! search, and where by bisection.

use crate::Neighbour;
use starl_core::geometry::HeightSpan;
use starl_core::{Obstacle, Point, math};

/// Bodies are stopped this far before the place where they would touch, metres, so that rounding does not
/// make them overlap.
const SKIN: f64 = 1e-6;

/// Halvings until the time of impact with an obstacle is exact to less than [`SKIN`].
const BISECTIONS: usize = 40;

/// The straight motion of a body in one step.
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    pub from: Point,
    pub to: Point,
    /// The fraction of the motion at which the body stops; 1 if it completes the motion.
    pub until: f64,
    pub radius: f64,
    pub height: f64,
}

impl Leg {
    /// A body's motion from its present place to `to`.
    pub fn new(body: &Neighbour, to: Point, until: f64) -> Leg {
        Leg {
            from: body.position,
            to,
            until,
            radius: body.radius,
            height: body.height,
        }
    }

    /// Where the body is after this fraction of the step.
    pub fn at(&self, time: f64) -> Point {
        match time.min(self.until) {
            0.0 => self.from,
            1.0 => self.to,
            time => self.from.lerp(self.to, time),
        }
    }
}

/// The time of the first contact of two bodies. Bodies that already overlap may separate: they touch only if they
/// approach each other.
#[inline]
pub fn of_bodies(a: &Leg, b: &Leg) -> Option<f64> {
    let (first, second) = (a.until.min(b.until), a.until.max(b.until));
    if first == 1.0 {
        return while_both_move(a, b, 0.0, 1.0);
    }
    while_both_move(a, b, 0.0, first).or_else(|| while_both_move(a, b, first, second))
}

/// When two bodies touch first from one time to another, if both move evenly between.
#[inline]
fn while_both_move(a: &Leg, b: &Leg, start: f64, end: f64) -> Option<f64> {
    let apart = a.at(start) - b.at(start);
    let motion = (a.at(end) - b.at(end)) - apart;
    let reach = a.radius + b.radius;
    let speed_squared = motion.x * motion.x + motion.y * motion.y;
    let closing = -(apart.x * motion.x + apart.y * motion.y);
    let outside = apart.x * apart.x + apart.y * apart.y - reach * reach;
    if outside >= 0.0 && (closing <= 0.0 || closing * closing <= speed_squared * outside) {
        return None;
    }
    let (mut enter, mut leave) = (0.0, 1.0);
    if speed_squared > 0.0 {
        let half_chord = math::sqrt((closing * closing - speed_squared * outside).max(0.0));
        enter = ((closing - half_chord) / speed_squared).max(0.0);
        leave = ((closing + half_chord) / speed_squared).min(1.0);
    }
    let (below, above) = heights(apart.z + a.height, apart.z - b.height, motion.z);
    let (enter, leave) = (below.max(enter), above.min(leave));
    if enter >= leave {
        return None;
    }
    if enter == 0.0 && outside < 0.0 && below < 0.0 {
        let then = apart + motion;
        let nears = then.length_squared() < apart.length_squared();
        return nears.then_some(start);
    }
    Some(start + before(enter, motion) * (end - start))
}

/// The time of a body's first contact with an obstacle. A body that is already inside may leave: it touches only if it
/// moves deeper.
#[inline]
pub fn of_obstacle(leg: &Leg, obstacle: &Obstacle) -> Option<f64> {
    let gap = obstacle.body_gap(leg.from, leg.radius, leg.height);
    if gap < 0.0 {
        let deeper = obstacle.body_gap(leg.to, leg.radius, leg.height) < gap;
        return deeper.then_some(0.0);
    }
    let motion = leg.to - leg.from;
    if gap >= motion.length() {
        return None;
    }
    let (mut enter, mut leave) = (0.0, 1.0);
    if let Some(HeightSpan { low, high }) = obstacle.height() {
        let (below, above) = heights(leg.from.z + leg.height - low, leg.from.z - high, motion.z);
        (enter, leave) = (below.max(0.0), above.min(1.0));
        if enter >= leave {
            return None;
        }
    }
    let planar = |time: f64| obstacle.planar_distance(leg.at(time)) - leg.radius;
    if planar(enter) < 0.0 {
        return Some(before(enter, motion));
    }
    let inside = first_below_zero(planar, enter, leave, motion.at_height(0.0).length())?;
    let (mut outside, mut inside) = (enter, inside);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (outside + inside);
        match planar(middle) < 0.0 {
            true => inside = middle,
            false => outside = middle,
        }
    }
    Some(before(outside, motion))
}

/// A time at which a convex function of slope at most `slope` is negative, if there is any.
fn first_below_zero(
    gap: impl Fn(f64) -> f64,
    mut from: f64,
    mut to: f64,
    slope: f64,
) -> Option<f64> {
    let (mut first, mut last) = (gap(from), gap(to));
    if last < 0.0 {
        return Some(to);
    }
    // Ternary search; it ends as soon as the slope no longer lets the function reach zero between.
    while first + last < slope * (to - from) {
        let third = (to - from) / 3.0;
        if third * slope < 1e-3 * SKIN {
            return None;
        }
        let (left, right) = (from + third, to - third);
        let (at_left, at_right) = (gap(left), gap(right));
        if at_left < 0.0 {
            return Some(left);
        }
        if at_right < 0.0 {
            return Some(right);
        }
        if at_left < at_right {
            (to, last) = (right, at_right);
        } else {
            (from, first) = (left, at_left);
        }
    }
    None
}

/// Between which times two spans of height overlap: one begins with its top `over` above the other's
/// bottom and its bottom `under` above the other's top, and rises by `rise` in the step.
fn heights(over: f64, under: f64, rise: f64) -> (f64, f64) {
    if rise == 0.0 {
        return match over > 0.0 && under < 0.0 {
            true => (f64::NEG_INFINITY, f64::INFINITY),
            false => (f64::INFINITY, f64::NEG_INFINITY),
        };
    }
    let (a, b) = (-over / rise, -under / rise);
    (a.min(b), a.max(b))
}

/// The time shortly before `time` at which bodies that move like this against each other are still
/// [`SKIN`] apart along their motion.
fn before(time: f64, motion: Point) -> f64 {
    (time - SKIN / motion.length().max(SKIN)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::Random;

    fn disc(from: Point, to: Point, random: &mut Random) -> Leg {
        Leg {
            from,
            to,
            until: 1.0,
            radius: random.between(0.05, 0.5),
            height: random.between(0.1, 0.5),
        }
    }

    fn place(random: &mut Random, half: f64) -> Point {
        let mut draw = || random.between(-half, half);
        Point::new(draw(), draw(), 0.3 * draw())
    }

    fn overlap(a: &Leg, b: &Leg, time: f64) -> bool {
        let (p, q) = (a.at(time), b.at(time));
        let heights = p.z < q.z + b.height && q.z < p.z + a.height;
        heights && p.planar_distance(q) < a.radius + b.radius
    }

    #[test]
    fn bodies_touch_when_fine_sampling_says_so() {
        let mut random = Random::keyed(5, &[]);
        let mut touched = 0;
        for _ in 0..3000 {
            let (a, b) = (
                (place(&mut random, 2.0), place(&mut random, 2.0)),
                (place(&mut random, 2.0), place(&mut random, 2.0)),
            );
            let mut a = disc(a.0, a.1, &mut random);
            let b = disc(b.0, b.1, &mut random);
            if random.chance(0.5) {
                a.until = random.uniform();
            }
            if overlap(&a, &b, 0.0) {
                continue;
            }
            let samples = 2000;
            let sampled = (0..=samples)
                .map(|sample| f64::from(sample) / f64::from(samples))
                .find(|&time| overlap(&a, &b, time));
            let impact = of_bodies(&a, &b);
            if let Some(sampled) = sampled {
                touched += 1;
                let impact = impact.expect("an overlap is preceded by an impact");
                assert!(
                    impact <= sampled && sampled - impact < 0.1,
                    "{impact} {sampled}"
                );
            }
            if let Some(impact) = impact {
                assert!(!overlap(&a, &b, impact), "{a:?} {b:?}");
            }
        }
        assert!(touched > 300);
    }

    #[test]
    fn a_body_touches_an_obstacle_when_fine_sampling_says_so() {
        let mut random = Random::keyed(6, &[]);
        let mut touched = 0;
        for _ in 0..3000 {
            let leg = (place(&mut random, 2.0), place(&mut random, 2.0));
            let leg = disc(leg.0, leg.1, &mut random);
            let obstacle = match random.chance(0.5) {
                true => Obstacle::cuboid(place(&mut random, 1.0), place(&mut random, 1.0)),
                false => Obstacle::circle(place(&mut random, 1.0), 0.2),
            };
            let gap = |time: f64| obstacle.body_gap(leg.at(time), leg.radius, leg.height);
            if gap(0.0) < 0.0 {
                continue;
            }
            let samples = 2000;
            let sampled = (0..=samples)
                .map(|sample| f64::from(sample) / f64::from(samples))
                .find(|&time| gap(time) < 0.0);
            let impact = of_obstacle(&leg, &obstacle);
            if let Some(sampled) = sampled {
                touched += 1;
                let impact = impact.expect("an overlap is preceded by an impact");
                assert!(impact <= sampled, "{impact} {sampled}");
            }
            if let Some(impact) = impact {
                assert!(gap(impact) >= 0.0, "{leg:?} {obstacle:?}");
                let just_after = (impact + 1e-3).min(1.0);
                let shallow = sampled.is_none();
                assert!(
                    shallow || gap(just_after) < 1e-2,
                    "stops long before: {leg:?} {obstacle:?}"
                );
            }
        }
        assert!(touched > 300);
    }

    #[test]
    fn a_body_slides_along_a_wall() {
        let wall = Obstacle::cuboid(Point::new(0.0, 0.0, 0.0), Point::new(9.0, 1.0, 1.0));
        let leg = Leg {
            from: Point::new(1.0, -0.5, 0.0),
            to: Point::new(8.0, -0.5, 0.0),
            until: 1.0,
            radius: 0.5,
            height: 0.3,
        };
        assert_eq!(of_obstacle(&leg, &wall), None);
        let steered = Leg {
            to: Point::new(8.0, -0.4, 0.0),
            ..leg
        };
        assert_eq!(of_obstacle(&steered, &wall), Some(0.0));
    }
}
