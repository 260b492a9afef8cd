//! Seeded random shapes for the geometry tests. A failing check names the seed that made the case.

use starl_core::geometry::{ConvexPolygon, HeightSpan, Obstacle, Point};
use starl_core::math;

/// A small generator (SplitMix64), so that a case is known by its seed.
pub struct Cases(u64);

impl Cases {
    pub fn new(seed: u64) -> Cases {
        Cases(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from `low` to `high`, both included.
    pub fn whole(&mut self, low: i64, high: i64) -> i64 {
        low + (self.bits() % (high - low + 1) as u64) as i64
    }

    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn point(&mut self, reach: f64) -> Point {
        let mut number = || self.number(-reach, reach);
        Point::new(number(), number(), number())
    }

    /// A polygon with three to eight corners on an ellipse, counter-clockwise, as a list.
    pub fn corners(&mut self) -> Vec<Point> {
        let count = self.whole(3, 8);
        let center = self.point(3.0);
        let (width, depth) = (self.number(0.3, 3.0), self.number(0.3, 3.0));
        let turned = self.number(0.0, 6.0);
        (0..count)
            .map(|at| {
                let angle =
                    (at as f64 + self.number(0.0, 0.7)) * std::f64::consts::TAU / count as f64;
                let (x, y) = (width * math::cos(angle), depth * math::sin(angle));
                let (sin, cos) = math::sincos(turned);
                Point::planar(center.x + x * cos - y * sin, center.y + x * sin + y * cos)
            })
            .collect()
    }

    pub fn obstacle(&mut self) -> Obstacle {
        let (a, b) = (self.point(3.0), self.point(3.0));
        let obstacle = match self.whole(0, 3) {
            0 => Obstacle::polygon(ConvexPolygon::new(&self.corners()).unwrap()),
            1 => Obstacle::polygon(ConvexPolygon::new(&[a, b]).unwrap()),
            2 => Obstacle::circle(a, self.number(0.0, 2.0)),
            _ => Obstacle::cuboid(a, b),
        };
        if self.whole(0, 1) == 0 {
            return obstacle;
        }
        let low = self.number(-3.0, 2.0);
        obstacle.with_height(HeightSpan::new(low, low + self.number(0.0, 3.0)))
    }

    /// Two ends; one in three is level and one in eight has the length 0.
    pub fn segment(&mut self, reach: f64) -> (Point, Point) {
        let (a, b) = (self.point(reach), self.point(reach));
        match self.whole(0, 23) {
            0..=7 => (a, b.at_height(a.z)),
            8..=10 => (a, a),
            _ => (a, b),
        }
    }
}
