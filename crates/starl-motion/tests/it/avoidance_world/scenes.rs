//! Scenes in which robots meet, sized to their bodies and speeds.

use super::{Placed, Scene};
use starl_core::geometry::ConvexPolygon;
use starl_core::{Obstacle, Point, Random, math};
use starl_motion::models;

/// The models that turn on the spot or move any way: they can leave any place they have got into.
pub const AGILE: [&str; 4] = ["create", "drone", "holonomic", "differential"];

/// Height at which drones travel in these scenes, metres.
const FLIGHT: f64 = 0.5;

pub fn radius(model: &str) -> f64 {
    models::by_name(model)
        .expect("a model of this name")
        .body()
        .radius
}

/// The point of the plane, or above it for a drone.
pub fn at(model: &str, x: f64, y: f64) -> Point {
    Point::new(x, y, if model == "drone" { FLIGHT } else { 0.0 })
}

/// A robot that goes from one point of the plane to another.
pub fn from_to(model: &'static str, start: (f64, f64), goal: (f64, f64)) -> Placed {
    Placed {
        model,
        start: at(model, start.0, start.1),
        goal: at(model, goal.0, goal.1),
    }
}

/// Two that each want to be where the other one is, 4 m away.
pub fn head_on(model: &'static str) -> Scene {
    let robots = vec![
        from_to(model, (0.0, 0.0), (4.0, 0.0)),
        from_to(model, (4.0, 0.0), (0.0, 0.0)),
    ];
    Scene {
        robots,
        ..Scene::default()
    }
}

/// The second robot is in the middle of the first one's way, to be halted there.
pub fn one_in_the_way(model: &'static str) -> Scene {
    let robots = vec![
        from_to(model, (0.0, 0.0), (4.0, 0.0)),
        from_to(model, (2.0, 0.0), (2.0, 0.0)),
    ];
    Scene {
        robots,
        ..Scene::default()
    }
}

/// Robots on a circle, each of which wants to get to the other side.
pub fn circle(model: &'static str, count: u32) -> Scene {
    let between = 2.0 * radius(model) + 0.5;
    let reach = (f64::from(count) * between / math::TAU).max(1.5);
    let robots = (0..count).map(|index| {
        let (sine, cosine) = math::sincos(math::TAU * f64::from(index) / f64::from(count));
        let (x, y) = (reach * cosine, reach * sine);
        from_to(model, (x, y), (-x, -y))
    });
    Scene {
        robots: robots.collect(),
        ..Scene::default()
    }
}

/// Two streams of four abreast that cross at a right angle.
pub fn crossing(model: &'static str) -> Scene {
    let mut robots = Vec::new();
    for lane in 0..4 {
        let beside = f64::from(lane) * (2.0 * radius(model) + 0.12);
        robots.push(from_to(model, (-3.0, beside), (4.0, beside)));
        robots.push(from_to(model, (beside, -3.0), (beside, 4.0)));
    }
    Scene {
        robots,
        ..Scene::default()
    }
}

/// A corridor along the x axis from -1 to 1 m with `free` metres on each side of a robot in its middle,
/// and mouths that open at 45 degrees.
pub fn corridor(model: &str, free: f64) -> Vec<Obstacle> {
    let half = radius(model) + free;
    let wall = |side: f64| {
        let far = half + 1.0;
        let corners = [(-1.0, half), (1.0, half), (2.0, far), (-2.0, far)];
        let corners = corners.map(|(x, y)| Point::planar(x, side * y));
        Obstacle::polygon(ConvexPolygon::new(&corners).expect("a trapezium"))
    };
    vec![wall(1.0), wall(-1.0)]
}

/// Two that meet in a corridor that is too narrow for both.
pub fn narrow_corridor(model: &'static str) -> Scene {
    let robots = vec![
        from_to(model, (-2.0, 0.0), (2.5, 0.0)),
        from_to(model, (2.0, 0.0), (-2.5, 0.0)),
    ];
    Scene {
        robots,
        obstacles: corridor(model, 0.1),
    }
}

/// Robots in random places, all of which want to get to the origin.
pub fn shared_goal(model: &'static str, count: u32, seed: u64) -> Scene {
    let mut scene = strewn(&[model], count, &[], seed);
    for robot in &mut scene.robots {
        robot.goal = at(model, 0.0, 0.0);
    }
    scene
}

/// Robots of these models in turn, from random places to random places among obstacles, in a square of
/// 5 m. Robots that stand at their goals leave room to pass between them.
pub fn strewn(models: &[&'static str], count: u32, obstacles: &[Obstacle], seed: u64) -> Scene {
    let mut random = Random::keyed(seed, &[2]);
    let mut robots: Vec<Placed> = Vec::new();
    while robots.len() < count as usize {
        let model = models[robots.len() % models.len()];
        let start = place_for(model, &mut random, obstacles);
        let goal = place_for(model, &mut random, obstacles);
        let clear = |other: &Placed| {
            let radii = radius(model) + radius(other.model);
            start.planar_distance(other.start) > radii + 0.1
                && goal.planar_distance(other.goal) > radii + 0.3
        };
        if robots.iter().all(clear) {
            robots.push(Placed { model, start, goal });
        }
    }
    Scene {
        robots,
        obstacles: obstacles.to_vec(),
    }
}

/// A random place in a square of 5 m that keeps 5 cm from obstacles.
pub fn place_for(model: &str, random: &mut Random, obstacles: &[Obstacle]) -> Point {
    let body = models::by_name(model).expect("a model of this name").body();
    loop {
        let place = at(model, random.between(-2.5, 2.5), random.between(-2.5, 2.5));
        let free = |obstacle: &Obstacle| obstacle.body_gap(place, body.radius, body.height) > 0.05;
        if obstacles.iter().all(free) {
            return place;
        }
    }
}
