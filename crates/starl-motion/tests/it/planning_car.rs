//! A car's waypoints can be followed by the car: driven by its own tracker it touches nothing.

use crate::planning_support::{self, Case, hall, least_gap, model, place, random_world};
use starl_core::motion::Estimate;
use starl_core::{Duration, Obstacle, Point, Pose, Random, Time, math};
use starl_motion::tracking::{Goal, Tracking};
use starl_motion::{Disturbance, Model};

/// Drives along the waypoints with an estimate every 0.1 s, from one to the next within 0.15 m if the
/// straight way there is free, otherwise within 0.075 m; the least gap on the way, and where it ends.
fn follow(model: &dyn Model, case: &Case, path: &[Point]) -> (f64, Point) {
    let mut state = model.at_rest(Pose::level(case.from, case.yaw));
    let body = model.body();
    let period = Duration::from_millis(20);
    let mut at = Time::ZERO;
    let mut least = f64::INFINITY;
    let turn_radius = model.limits().turn_radius;
    for (index, &target) in path.iter().enumerate() {
        let free = |from: Point, to: Point| {
            let mut obstacles = case.request.unsafe_set.iter();
            !obstacles.any(|o| o.blocks_body(from, to, body.radius, body.height))
        };
        let pass = |from: Point| path.get(index + 1).is_some_and(|&next| free(from, next));
        let mut tracking = Tracking::default();
        let mut command = starl_core::Command::Stop;
        for step in 0..5_000 {
            if step % 5 == 0 {
                let here = state.pose.position;
                let near = if pass(here) { 0.15 } else { 0.075 };
                if here.distance(target) <= near {
                    break;
                }
                let estimate = Estimate {
                    pose: state.pose,
                    twist: state.twist,
                    at,
                };
                command = model.track(&mut tracking, &estimate, &Goal::stop_at(target));
            }
            let before = state.pose;
            state = model.predict(&state, &command, &Disturbance::default(), period);
            at += period;
            // It never turns more tightly than it can.
            let turned = math::wrap_angle(state.pose.yaw - before.yaw).abs();
            let driven = before.position.distance(state.pose.position);
            assert!(
                turned * turn_radius <= 1.001 * driven + 1e-4,
                "{turned} {driven}"
            );
            for obstacle in case.request.unsafe_set.iter() {
                least = least.min(obstacle.body_gap(state.pose.position, body.radius, body.height));
            }
        }
    }
    (least, state.pose.position)
}

#[test]
fn the_car_follows_its_path_clear_of_everything() {
    let model = model("car");
    let legs = [
        ((0.3, 0.5), (5.5, 5.8)),
        ((5.6, 0.5), (0.5, 5.5)),
        ((2.2, 3.4), (3.7, 2.8)),
    ];
    let mut found = 0;
    for seed in 0..10 {
        for (yaw, (from, to)) in [0.0, 1.5, 3.0, -1.5]
            .into_iter()
            .flat_map(|yaw| legs.map(|leg| (yaw, leg)))
        {
            let (from, to) = (Point::planar(from.0, from.1), Point::planar(to.0, to.1));
            let mut case = Case::new(from, to, hall());
            (case.yaw, case.request.seed) = (yaw, seed);
            case.request.most_nodes = 20_000;
            let Some(path) = case.plan(&*model) else {
                continue;
            };
            found += 1;
            assert_eq!(path.last(), Some(&case.request.target));
            let (gap, end) = follow(&*model, &case, &path);
            assert!(gap >= 0.0, "seed {seed}: {gap} {from} {yaw} {path:?}");
            assert!(end.distance(to) <= 0.1, "seed {seed}: {end} {path:?}");
        }
    }
    assert!(found >= 115, "{found} of 120");
}

#[test]
fn in_random_worlds_too() {
    let model = model("car");
    let body = model.body();
    let (mut found, mut searched) = (0, 0);
    for seed in 0..200 {
        let mut random = Random::keyed(seed, &[9]);
        // Those worlds are cramped for a car: the room, and one thing in three.
        let all = random_world(&mut random).into_iter().enumerate();
        let some = all.filter(|(index, _)| *index < 4 || index % 3 == 0);
        let obstacles: Vec<Obstacle> = some.map(|(_, obstacle)| obstacle).collect();
        let (from, to) = (place(&mut random), place(&mut random));
        let free = |at: Point| least_gap(body, &[at, at], &obstacles) > 0.15;
        if !free(from) || !free(to) {
            continue;
        }
        let mut case = Case::new(from, to, obstacles.clone());
        case.yaw = random.between(-3.0, 3.0);
        (case.request.seed, case.request.most_nodes) = (seed, 2_000);
        let Some(path) = case.plan(&*model) else {
            continue;
        };
        found += 1;
        searched += u32::from(path.len() > 1);
        let (gap, end) = follow(&*model, &case, &path);
        assert!(gap >= 0.0, "seed {seed}: {gap} {path:?}");
        assert!(end.distance(to) <= 0.1, "seed {seed}: {end} {path:?}");
    }
    assert!(found >= 60 && searched >= 30, "{found} {searched}");
}

#[test]
fn a_car_facing_a_wall_is_not_sent_straight_on() {
    let model = model("car");
    // The target is free and in sight, but on the car's left, inside its turning circle, and a wall
    // is ahead: the straight segment would do for a robot that turns on the spot.
    let obstacles = vec![planning_support::wall((0.5, -3.0), (0.5, 3.0))];
    let case = Case::new(Point::planar(0.0, 0.0), Point::planar(0.0, 0.9), obstacles);
    let path = case.plan(&*model).expect("a path");
    let (gap, end) = follow(&*model, &case, &path);
    assert!(
        gap >= 0.0 && end.distance(case.request.target) <= 0.1,
        "{gap} {end} {path:?}"
    );
}

/// A fault can set a target anywhere: the work may not grow with its distance.
#[test]
fn a_target_at_the_end_of_the_world_is_planned_for_at_once() {
    let model = model("car");
    for yaw in [0.0, 2.0, 3.0] {
        for distance in [1e4, 1e7, 1e9] {
            let (from, to) = (
                Point::planar(0.5, 0.5),
                Point::planar(distance, 0.3 * distance),
            );
            let mut case = Case::new(from, to, Vec::new());
            case.yaw = yaw;
            let path = case.plan(&*model).expect("there is nothing in the way");
            assert_eq!(path.last(), Some(&to));
        }
    }
    // In a closed room there is no path, and a tree has no chance.
    let (from, to) = (Point::planar(0.5, 0.5), Point::planar(1e9, 1e9));
    let case = Case::new(from, to, planning_support::room(-5.0, 5.0));
    assert_eq!(case.plan(&*model), None);
    let wall = planning_support::wall((3.0, -3.0), (3.0, 3.0));
    let case = Case::new(from, Point::planar(1e9, 0.0), vec![wall]);
    case.plan(&*model);
}
