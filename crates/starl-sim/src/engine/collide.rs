//! Which motions would make bodies overlap, and so do not take place.
//!
//! A body meets another if their predicted places overlap, unless the present ones do too and are
//! nearer to each other: bodies that overlap already may part. A body that is stopped stays where it was, and
//! may so stop others that counted on its leaving; [`settle`] follows that to its end. It ends since
//! present places do not overlap and each round stops more bodies.

use super::sense::same_height;
use super::shared::Shared;
use starl_core::event::Hit;
use starl_core::geometry::Bounds;
use starl_core::{Point, RobotId};

/// The first contact of a robot's predicted motion, the deepest overlap first. No body moves
/// farther than `reach` in the step.
#[inline]
pub fn first_hit(shared: &Shared, robot: RobotId, next: &[Point], reach: f64) -> Option<Hit> {
    let body = &shared.bodies[robot.index()];
    let (now, then) = (body.position, next[robot.index()]);
    let mut deepest = 0.0;
    let mut hit = None;
    if now != then {
        shared.map.any_near(
            &Bounds::of_body(now, then, body.radius, body.height),
            |index| {
                let obstacle = &shared.map.obstacles()[index as usize];
                let gap = obstacle.body_gap(then, body.radius, body.height);
                if gap < deepest && gap < obstacle.body_gap(now, body.radius, body.height) {
                    deepest = gap;
                    hit = Some(Hit::Obstacle(shared.standing[index as usize]));
                }
                false
            },
        );
    }
    let reach = body.radius + shared.grid.greatest_radius() + 2.0 * reach;
    shared.grid.for_each_near(now, reach, |entry| {
        if entry.robot == robot.0 || entry.distance_squared(now) > reach * reach {
            return;
        }
        if let Some(gap) = overlap(
            shared,
            robot,
            then,
            entry.robot(),
            next[entry.robot as usize],
        ) && gap < deepest
        {
            deepest = gap;
            hit = Some(Hit::Robot(entry.robot()));
        }
    });
    hit
}

/// How deep two bodies at new places would overlap, a negative number; none if they do not, or overlap
/// already and are moving apart.
fn overlap(shared: &Shared, a: RobotId, a_then: Point, b: RobotId, b_then: Point) -> Option<f64> {
    let (first, second) = (&shared.bodies[a.index()], &shared.bodies[b.index()]);
    let reach = first.radius + second.radius;
    let gap = a_then.planar_distance(b_then) - reach;
    if gap >= 0.0 {
        return None;
    }
    let (mut a_moved, mut b_moved) = (*first, *second);
    a_moved.position = a_then;
    b_moved.position = b_then;
    let nearing = a_then.distance(b_then) < first.position.distance(second.position);
    // One that sinks onto another which drives off may enter it while their centres part.
    let apart = first.position.planar_distance(second.position) >= reach;
    let entering = nearing || apart || !same_height(first, second);
    (entering && same_height(&a_moved, &b_moved)).then_some(gap)
}

/// Stops the robots that run into robots that have been stopped, until there are no more.
pub fn settle(shared: &Shared, next: &mut [Point], reach: f64, hits: &mut [Option<Hit>]) {
    let mut stopped: Vec<u32> = (0..hits.len() as u32)
        .filter(|&robot| hits[robot as usize].is_some())
        .collect();
    for &robot in &stopped {
        next[robot as usize] = shared.bodies[robot as usize].position;
    }
    let mut done = 0;
    while done < stopped.len() {
        let robot = RobotId(stopped[done]);
        done += 1;
        let body = &shared.bodies[robot.index()];
        let reach = body.radius + shared.grid.greatest_radius() + 2.0 * reach;
        shared.grid.for_each_within(body.position, reach, |entry| {
            let other = entry.robot as usize;
            if entry.robot == robot.0 || hits[other].is_some() {
                return;
            }
            if overlap(shared, entry.robot(), next[other], robot, body.position).is_some() {
                hits[other] = Some(Hit::Robot(robot));
                next[other] = shared.bodies[other].position;
                stopped.push(entry.robot);
            }
        });
    }
}

/// Unit vector from a robot's centre towards what it has met.
pub fn direction(shared: &Shared, robot: RobotId, hit: Hit) -> Point {
    let from = shared.bodies[robot.index()].position;
    let to = match hit {
        Hit::Robot(other) => shared.bodies[other.index()].position,
        Hit::Obstacle(world_index) => match shared.standing.binary_search(&world_index) {
            Ok(index) => shared.map.obstacles()[index].nearest_point(from),
            Err(_) => from,
        },
    };
    (to - from)
        .at_height(0.0)
        .normalized()
        .unwrap_or(Point::planar(1.0, 0.0))
}
