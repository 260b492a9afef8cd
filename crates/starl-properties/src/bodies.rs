//! Gaps between bodies, and all pairs of robots that overlap.

use starl_core::motion::Body;
use starl_core::{Point, RobotId, math};

/// The gap between two upright cylinders, metres: negative by how far one reaches into the other,
/// sideways or upwards, whichever is less.
pub(super) fn gap(a: (&Body, Point), b: (&Body, Point)) -> f64 {
    let planar = a.1.planar_distance(b.1) - a.0.radius - b.0.radius;
    let (span_a, span_b) = (a.0.span(a.1.z), b.0.span(b.1.z));
    let vertical = (span_a.low - span_b.high).max(span_b.low - span_a.high);
    match (planar > 0.0, vertical > 0.0) {
        (true, true) => math::sqrt(planar * planar + vertical * vertical),
        _ => planar.max(vertical),
    }
}

/// Finds the pairs of robots whose bodies overlap: a sweep along x over the robots in the order of
/// their positions (sweep and prune; Cohen, Lin, Manocha and Ponamgi 1995). The order is kept from
/// one time to the next, so that sorting costs little.
#[derive(Clone, Debug, Default)]
pub(super) struct Sweep {
    order: Vec<RobotId>,
}

impl Sweep {
    /// Calls `visit` for each pair that overlaps by more than `tolerance` metres, with the gap. Robots
    /// without a finite position are left out.
    pub fn overlaps(
        &mut self,
        bodies: &[Body],
        positions: &[Option<Point>],
        tolerance: f64,
        mut visit: impl FnMut(RobotId, RobotId, f64),
    ) {
        if self.order.len() != bodies.len() {
            self.order = (0..bodies.len() as u32).map(RobotId).collect();
        }
        let at = |robot: RobotId| positions[robot.index()].filter(|p| p.is_finite());
        let key = |robot: RobotId| at(robot).map_or(f64::INFINITY, |p| p.x);
        self.order
            .sort_by(|&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        let widest = bodies.iter().map(|body| body.radius).fold(0.0, f64::max);
        for (index, &a) in self.order.iter().enumerate() {
            let Some(place) = at(a) else { break };
            let body = &bodies[a.index()];
            let reach = place.x + body.radius + widest;
            for &b in &self.order[index + 1..] {
                let Some(other) = at(b).filter(|other| other.x < reach) else {
                    break;
                };
                let gap = gap((body, place), (&bodies[b.index()], other));
                if gap < -tolerance {
                    visit(a.min(b), a.max(b), gap);
                }
            }
        }
    }
}
