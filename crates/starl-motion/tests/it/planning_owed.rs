//! Guarantees in any world: a path starts at the robot, ends within the vicinity of the target, touches
//! nothing on the way, and is the same for each call. Starts and targets are anywhere, also in margins,
//! in contact and in obstacles.

use crate::planning_support::{Case, PLANNERS, least_gap, model, place, random_world};
use starl_core::geometry::HeightSpan;
use starl_core::{Obstacle, Random};

const VICINITY: f64 = 0.2;

/// A world in which every other thing is of limited height.
fn uneven_world(random: &mut Random) -> Vec<Obstacle> {
    let world = random_world(random);
    let mut low_or_high = |obstacle: Obstacle| match random.below(4) {
        0 => obstacle.with_height(HeightSpan::new(0.0, random.between(0.1, 1.5))),
        1 => obstacle.with_height(HeightSpan::new(random.between(0.1, 1.0), 2.0)),
        _ => obstacle,
    };
    world.into_iter().map(&mut low_or_high).collect()
}

/// How many of these worlds gave a path, and how many of those paths start or end in the margin.
fn tried(name: &str, worlds: u64) -> (u32, u32) {
    let model = model(name);
    let body = model.body();
    let (mut found, mut tight) = (0, 0);
    for (world, planner) in (0..worlds).flat_map(|world| PLANNERS.map(|planner| (world, planner))) {
        let mut random = Random::keyed(world, &[1]);
        let obstacles = uneven_world(&mut random);
        let (from, target) = (place(&mut random), body.reachable(place(&mut random)));
        let mut case = Case::new(from, target, obstacles.clone()).with(planner, world);
        (case.request.vicinity, case.request.most_nodes) = (VICINITY, 400);
        let path = case.plan(&*model);
        assert_eq!(
            case.plan(&*model),
            path,
            "{name} {planner:?}, world {world}"
        );
        let Some(path) = path else { continue };
        let whole = case.whole(&*model, &path);
        let gap = |at| least_gap(body, &[at, at], &obstacles);
        let (start, end) = (whole[0], whole[whole.len() - 1]);
        let off = end.distance(target);
        assert!(off <= VICINITY, "{name} {planner:?}, world {world}: {off}");
        assert!(
            off == 0.0 || gap(target) <= 0.0,
            "{name} {planner:?}, world {world}: {off}"
        );
        // A robot that is in contact leads out of it first, and never further in.
        let leads_out = usize::from(gap(start) <= 0.0);
        let least = least_gap(body, &whole[leads_out..], &obstacles);
        assert!(
            least > 0.0,
            "{name} {planner:?}, world {world}: {least} {path:?}"
        );
        let first = least_gap(body, &whole[..2], &obstacles);
        assert!(
            leads_out == 0 || first >= gap(start) - 1e-9,
            "{name} {planner:?}, world {world}"
        );
        found += 1;
        tight += u32::from(gap(start).min(gap(end)) < 0.1 * body.radius);
    }
    (found, tight)
}

#[test]
fn by_robots_on_the_floor() {
    for name in ["create", "holonomic", "differential"] {
        let (found, tight) = tried(name, 120);
        assert!(found >= 100 && tight >= 10, "{name} {found} {tight}");
    }
}

#[test]
fn by_robots_in_the_air() {
    let (found, tight) = tried("drone", 120);
    assert!(found >= 50 && tight >= 5, "{found} {tight}");
}

#[test]
fn by_a_car() {
    let (found, tight) = tried("car", 120);
    assert!(found >= 30 && tight >= 3, "{found} {tight}");
}
