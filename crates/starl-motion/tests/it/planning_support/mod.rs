//! Shared code of the planning tests: requests, worlds and a judge of paths that uses none of the
//! planners' own geometry.

use starl_core::geometry::{ConvexPolygon, HeightSpan, Obstacle};
use starl_core::motion::{Body, Estimate, Path, PlanRequest, Planner};
use starl_core::{Point, Pose, Random};
use starl_motion::{Model, models, planning};
use std::sync::Arc;

pub const PLANNERS: [Planner; 3] = [Planner::Rrt, Planner::RrtConnect, Planner::RrtStar];

pub fn model(name: &str) -> Arc<dyn Model> {
    models::by_name(name).expect("a model of this name")
}

/// A question for a planner.
#[derive(Clone, Debug)]
pub struct Case {
    pub from: Point,
    pub yaw: f64,
    pub request: PlanRequest,
}

impl Case {
    pub fn new(from: Point, target: Point, obstacles: Vec<Obstacle>) -> Case {
        let request = PlanRequest {
            ticket: 0,
            target,
            vicinity: 0.0,
            unsafe_set: obstacles.into(),
            around_robots: false,
            planner: Planner::Auto,
            most_nodes: 3_000,
            seed: 1,
        };
        Case {
            from,
            yaw: 0.0,
            request,
        }
    }

    pub fn with(mut self, planner: Planner, seed: u64) -> Case {
        (self.request.planner, self.request.seed) = (planner, seed);
        self
    }

    pub fn estimate(&self) -> Estimate {
        Estimate {
            pose: Pose::level(self.from, self.yaw),
            ..Estimate::default()
        }
    }

    pub fn plan(&self, model: &dyn Model) -> Option<Path> {
        planning::plan(model, &self.estimate(), &self.request, &[])
    }

    /// The waypoints with the start before them.
    pub fn whole(&self, model: &dyn Model, path: &Path) -> Vec<Point> {
        core::iter::once(model.body().reachable(self.from))
            .chain(path.iter().copied())
            .collect()
    }
}

pub fn rectangle(low: (f64, f64), high: (f64, f64)) -> Obstacle {
    let low = Point::planar(low.0, low.1);
    let high = Point::planar(high.0, high.1);
    Obstacle::polygon(ConvexPolygon::rectangle(low, high).expect("a rectangle"))
}

pub fn wall(a: (f64, f64), b: (f64, f64)) -> Obstacle {
    let ends = [Point::planar(a.0, a.1), Point::planar(b.0, b.1)];
    Obstacle::polygon(ConvexPolygon::new(&ends).expect("a wall"))
}

/// Four walls around the square from `low` to `high` in both coordinates.
pub fn room(low: f64, high: f64) -> Vec<Obstacle> {
    let corners = [(low, low), (high, low), (high, high), (low, high)];
    (0..4)
        .map(|at| wall(corners[at], corners[(at + 1) % 4]))
        .collect()
}

/// Seven metres square with a wall that leaves a gap, columns, a low table, and a beam overhead.
pub fn hall() -> Vec<Obstacle> {
    let mut all = room(-0.5, 6.5);
    all.push(wall((3.0, -0.5), (3.0, 4.6)));
    all.push(rectangle((0.8, 1.8), (2.0, 2.1)));
    all.push(Obstacle::circle(Point::planar(4.6, 3.4), 0.4));
    all.push(Obstacle::circle(Point::planar(1.2, 4.1), 0.3));
    let triangle = [
        Point::planar(4.0, 1.0),
        Point::planar(5.2, 1.3),
        Point::planar(4.4, 2.0),
    ];
    all.push(Obstacle::polygon(
        ConvexPolygon::new(&triangle).expect("a triangle"),
    ));
    all.push(
        Obstacle::cuboid(Point::planar(5.0, 4.4), Point::planar(5.6, 5.0))
            .with_height(HeightSpan::new(0.0, 0.4)),
    );
    all
}

/// The side of random worlds, metres.
const SIDE: f64 = 5.0;

/// A random place in a random world.
pub fn place(random: &mut Random) -> Point {
    Point::planar(
        random.between(0.3, SIDE - 0.3),
        random.between(0.3, SIDE - 0.3),
    )
}

/// A closed room with walls, discs, triangles and boxes strewn about, and two walls across it, each
/// with a gap that is wide enough or not.
pub fn random_world(random: &mut Random) -> Vec<Obstacle> {
    let mut all = room(0.0, SIDE);
    for upright in [true, false] {
        let (at, gap) = (random.between(1.0, 4.0), random.between(0.0, 4.0));
        let width = random.between(0.1, 1.0);
        let across = |a: f64, b: f64| {
            if upright {
                wall((at, a), (at, b))
            } else {
                wall((a, at), (b, at))
            }
        };
        all.push(across(0.0, gap + 0.01));
        all.push(across(gap + width, SIDE));
    }
    while all.len() < 20 {
        let at = place(random);
        let near = |random: &mut Random| {
            at + Point::planar(random.between(-0.9, 0.9), random.between(-0.9, 0.9))
        };
        let corners = match random.below(4) {
            0 => {
                all.push(Obstacle::circle(at, random.between(0.05, 0.4)));
                continue;
            }
            1 => vec![at, near(random)],
            2 => vec![at, near(random), near(random)],
            _ => {
                all.push(Obstacle::cuboid(at, near(random).at_height(1.0)));
                continue;
            }
        };
        all.extend(ConvexPolygon::new(&corners).map(Obstacle::polygon));
    }
    all
}

/// The least gap in metres between the body and any obstacle at closely spaced places of the path.
pub fn least_gap(body: Body, path: &[Point], obstacles: &[Obstacle]) -> f64 {
    let mut least = f64::INFINITY;
    for ends in path.windows(2) {
        let steps = (ends[0].distance(ends[1]) / 0.002).ceil().max(1.0) as u32;
        for step in 0..=steps {
            let at = ends[0].lerp(ends[1], f64::from(step) / f64::from(steps));
            for obstacle in obstacles {
                least = least.min(obstacle.body_gap(at, body.radius, body.height));
            }
        }
    }
    least
}

pub fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}
