//! Finds motions that would make bodies overlap, and prevents them.
//!
//! The rule is the simulator's (`collide.rs` of starl-sim): a motion is stopped if the bodies would overlap more deeply
//! than now; a stopped body stays where it was, and may stop others behind it. Every pair is checked: a world of
//! emulated devices has tens of bodies, not thousands.

use super::body::Body;
use starl_core::Point;
use starl_core::geometry::{Bounds, ObstacleIndex};
use starl_motion::{Impact, State};

/// Whether a new body would overlap an existing one or an obstacle.
pub(super) fn blocked(map: &ObstacleIndex, bodies: &[Body], new: &Body) -> bool {
    let at = new.state.pose.position;
    let shape = new.model.body();
    map.blocks_body(at, at, shape.radius, shape.height)
        || bodies
            .iter()
            .any(|body| overlap(new, at, body, body.state.pose.position))
}

/// The obstacle that stops each body on its way to the predicted state.
pub(super) fn impacts(
    map: &ObstacleIndex,
    bodies: &[Body],
    predicted: &[State],
) -> Vec<Option<Impact>> {
    let mut next: Vec<Point> = predicted.iter().map(|state| state.pose.position).collect();
    let mut impacts: Vec<Option<Impact>> = bodies
        .iter()
        .zip(&next)
        .map(|(body, &then)| obstacle_hit(map, body, then))
        .collect();
    // Bodies that meet each other on the way both stop; then those stop that run into one which has stopped.
    let mut first_round = true;
    loop {
        let mut stopped = Vec::new();
        for (index, body) in bodies.iter().enumerate() {
            if impacts[index].is_some() {
                next[index] = body.state.pose.position;
            }
        }
        for (index, body) in bodies.iter().enumerate() {
            if impacts[index].is_some() {
                continue;
            }
            let met = (0..bodies.len()).find(|&other| {
                other != index
                    && (first_round || impacts[other].is_some())
                    && runs_into(body, next[index], &bodies[other], next[other])
            });
            if let Some(other) = met {
                stopped.push((index, bodies[other].state.pose.position));
            }
        }
        if stopped.is_empty() && !first_round {
            return impacts;
        }
        first_round = false;
        for (index, target) in stopped {
            impacts[index] = Some(towards(&bodies[index], target));
        }
    }
}

fn obstacle_hit(map: &ObstacleIndex, body: &Body, then: Point) -> Option<Impact> {
    let now = body.state.pose.position;
    let shape = body.model.body();
    let mut deepest = 0.0;
    let mut hit = None;
    if now != then {
        let way = Bounds::of_body(now, then, shape.radius, shape.height);
        map.any_near(&way, |index| {
            let obstacle = &map.obstacles()[index as usize];
            let gap = obstacle.body_gap(then, shape.radius, shape.height);
            if gap < deepest && gap < obstacle.body_gap(now, shape.radius, shape.height) {
                deepest = gap;
                hit = Some(towards(body, obstacle.nearest_point(now)));
            }
            false
        });
    }
    hit
}

/// Whether two bodies would overlap, other than by parting from an overlap that is there already.
fn runs_into(a: &Body, a_then: Point, b: &Body, b_then: Point) -> bool {
    let (a_now, b_now) = (a.state.pose.position, b.state.pose.position);
    overlap(a, a_then, b, b_then)
        && (!overlap(a, a_now, b, b_now) || a_then.distance(b_then) < a_now.distance(b_now))
}

fn overlap(a: &Body, a_at: Point, b: &Body, b_at: Point) -> bool {
    let (a, b) = (a.model.body(), b.model.body());
    a_at.planar_distance(b_at) < a.radius + b.radius
        && a_at.z < b_at.z + b.height
        && b_at.z < a_at.z + a.height
}

fn towards(body: &Body, target: Point) -> Impact {
    let place = body.state.pose.position;
    let way = (target - place).at_height(0.0);
    Impact {
        place,
        direction: way.normalized().unwrap_or(Point::planar(1.0, 0.0)),
    }
}
