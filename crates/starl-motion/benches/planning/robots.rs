//! Robots in their worlds, through [`plan`]: the legs of Race, a target that cannot be reached, and
//! many obstacles.

use super::{median, quickest};
use starl_core::geometry::ConvexPolygon;
use starl_core::motion::{Estimate, Obstacles, PlanRequest, Planner};
use starl_core::{Obstacle, Point, Pose, Random};
use starl_motion::models;
use starl_motion::planning::plan;

/// Nodes as ReachAvoid asks for them.
const MOST_NODES: u32 = 20_000;

fn request(target: Point, obstacles: &Obstacles, planner: Planner, seed: u64) -> PlanRequest {
    PlanRequest {
        ticket: 0,
        target,
        vicinity: 0.075,
        unsafe_set: obstacles.clone(),
        around_robots: false,
        planner,
        most_nodes: MOST_NODES,
        seed,
    }
}

fn standing(at: Point) -> Estimate {
    Estimate {
        pose: Pose::level(at, 0.0),
        ..Estimate::default()
    }
}

fn wall(a: (f64, f64), b: (f64, f64)) -> Obstacle {
    let ends = [Point::planar(a.0, a.1), Point::planar(b.0, b.1)];
    Obstacle::polygon(ConvexPolygon::new(&ends).expect("a wall"))
}

/// The legs of the Race example, as the simulator asks for them.
pub fn race(seeds: u64) {
    let low = Point::planar(0.3, 1.0);
    let block = ConvexPolygon::rectangle(low, Point::planar(1.5, 1.2)).expect("a rectangle");
    let obstacles: Obstacles = [Obstacle::polygon(block)].into();
    let way_points = [
        (0.594, 0.508),
        (0.093, 1.430),
        (2.517, 2.734),
        (0.800, 1.650),
    ];
    println!("\nRace: microseconds a call of `plan`, median and worst, and waypoints");
    println!(
        "{:<12} {:<14} {:>8} {:>8} {:>8} {:>8}",
        "robot", "planner", "leg", "median", "worst", "points"
    );
    for (robot, planner) in [
        ("create", Planner::Auto),
        ("drone", Planner::Auto),
        ("car", Planner::Auto),
        ("create", Planner::Rrt),
        ("create", Planner::RrtStar),
    ] {
        let model = models::by_name(robot).expect("a model");
        for from in 0..way_points.len() {
            let [a, b] =
                [from, (from + 1) % 4].map(|at| Point::planar(way_points[at].0, way_points[at].1));
            let start = standing(a);
            let (mut times, mut points) = (Vec::new(), Vec::new());
            for seed in 0..if planner == Planner::RrtStar {
                seeds / 50
            } else {
                seeds
            } {
                let target = model.body().reachable(b);
                let mut request = request(target, &obstacles, planner, seed);
                if planner == Planner::RrtStar {
                    request.most_nodes = 1_000; // It uses everything that it gets.
                }
                let (seconds, path) = quickest(|| plan(&*model, &start, &request, &[]));
                times.push(seconds * 1e6);
                points.push(path.map_or(f64::NAN, |path| path.len() as f64));
            }
            let worst = times.iter().copied().fold(0.0, f64::max);
            println!(
                "{robot:<12} {:<14} {:>8} {:>8.1} {worst:>8.1} {:>8}",
                format!("{planner:?}"),
                ["A to B", "B to C", "C to D", "D to A"][from],
                median(&mut times),
                median(&mut points),
            );
        }
    }
}

/// A sealed room round the target within another round both: milliseconds until the planner gives up.
pub fn giving_up(seeds: u64) {
    println!(
        "\nGiving up: milliseconds a call of `plan` with {MOST_NODES} nodes, median and worst"
    );
    let room = |half: f64| {
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
        (0..4).map(move |at| wall(corners[at], corners[(at + 1) % 4]))
    };
    let obstacles: Obstacles = room(4.0).chain(room(1.0)).collect();
    for robot in ["create", "drone", "car"] {
        let model = models::by_name(robot).expect("a model");
        let target = model.body().reachable(Point::ZERO);
        let start = standing(Point::planar(3.0, 3.0));
        let mut times = Vec::new();
        for seed in 0..seeds / 10 {
            let request = request(target, &obstacles, Planner::Auto, seed);
            let (seconds, path) = quickest(|| plan(&*model, &start, &request, &[]));
            assert_eq!(path, None, "{robot}");
            times.push(seconds * 1e3);
        }
        let worst = times.iter().copied().fold(0.0, f64::max);
        println!("{robot:<12} {:>8.1} {worst:>8.1}", median(&mut times));
    }
}

/// Columns of 0.3 m, one in four square metres, and ways across all of it and of half a metre.
pub fn many_obstacles(seeds: u64) {
    println!("\nMany obstacles: solved, and median microseconds, far and near");
    for count in [10, 100, 1_000] {
        let side = 2.0 * f64::from(count).sqrt();
        let mut random = Random::keyed(1, &[]);
        let place = |random: &mut Random| {
            Point::planar(random.between(0.0, side), random.between(0.0, side))
        };
        let column = |_| Obstacle::circle(place(&mut random), 0.3);
        let obstacles: Obstacles = (0..count).map(column).collect();
        for robot in ["create", "drone", "car"] {
            let model = models::by_name(robot).expect("a model");
            let clear = |at: Point| {
                let radius = 1.5 * model.body().radius;
                obstacles.iter().all(|o| o.body_gap(at, radius, 0.1) > 0.0)
            };
            let (mut far, mut near, mut solved, mut asked) = (Vec::new(), Vec::new(), 0, 0);
            let mut random = Random::keyed(2, &[]);
            while asked < seeds / 5 {
                let (a, b) = (place(&mut random), place(&mut random));
                let (b, times) = match asked % 2 {
                    0 => (b, &mut far),
                    _ => (a + Point::planar(0.5, 0.1), &mut near),
                };
                if !clear(a) || !clear(b) {
                    continue;
                }
                asked += 1;
                let target = model.body().reachable(b);
                let request = request(target, &obstacles, Planner::Auto, asked);
                let (seconds, path) = quickest(|| plan(&*model, &standing(a), &request, &[]));
                times.push(seconds * 1e6);
                solved += u64::from(path.is_some());
            }
            println!(
                "{count:>6} {robot:<12} {solved:>4}/{asked} {:>10.1} {:>10.1}",
                median(&mut far),
                median(&mut near)
            );
        }
    }
}
