//! Random worlds, judged by flooding a fine grid: if the flood gets through with room to spare a path is found, if it
//! does not get through there is none, and every path is clear of obstacles.

use crate::planning_support::{Case, least_gap, model, place, random_world as world};
use starl_core::geometry::Obstacle;
use starl_core::motion::{Body, Planner};
use starl_core::{Point, Random};
use starl_motion::planning::Options;

const CELL: f64 = 0.05;
const CELLS: usize = 100;

/// Whether one gets from one place to another over neighbouring cells whose centres are at least
/// `clearance` from everything.
fn flood(obstacles: &[Obstacle], from: Point, to: Point, clearance: f64) -> bool {
    let cell = |p: Point| {
        ((p.y / CELL) as usize).min(CELLS - 1) * CELLS + ((p.x / CELL) as usize).min(CELLS - 1)
    };
    let center = |cell: usize| {
        Point::planar(
            ((cell % CELLS) as f64 + 0.5) * CELL,
            ((cell / CELLS) as f64 + 0.5) * CELL,
        )
    };
    let free = |cell: usize| {
        obstacles
            .iter()
            .all(|o| o.body_gap(center(cell), clearance, 0.1) >= 0.0)
    };
    let mut seen = vec![false; CELLS * CELLS];
    let mut waiting = vec![cell(from)];
    seen[cell(from)] = true;
    while let Some(at) = waiting.pop() {
        if at == cell(to) {
            return true;
        }
        let (x, y) = (at % CELLS, at / CELLS);
        let sides = [
            (x + 1, y),
            (x.wrapping_sub(1), y),
            (x, y + 1),
            (x, y.wrapping_sub(1)),
        ];
        for (x, y) in sides {
            if x < CELLS && y < CELLS && !seen[y * CELLS + x] {
                seen[y * CELLS + x] = true;
                if free(y * CELLS + x) {
                    waiting.push(y * CELLS + x);
                }
            }
        }
    }
    false
}

fn gap(body: Body, at: Point, obstacles: &[Obstacle]) -> f64 {
    least_gap(body, &[at, at], obstacles)
}

#[test]
fn existing_paths_are_found_and_are_clear() {
    let model = model("create");
    let body = model.body();
    let clear = body.radius * (1.0 + Options::default().margin_radii);
    let (mut open, mut closed) = (0, 0);
    for seed in 0..150 {
        let mut random = Random::keyed(seed, &[]);
        let obstacles = world(&mut random);
        let (from, to) = (place(&mut random), place(&mut random));
        if gap(body, from, &obstacles) < 0.1 || gap(body, to, &obstacles) < 0.1 {
            continue;
        }
        let wide = flood(&obstacles, from, to, clear + CELL);
        let narrow = flood(&obstacles, from, to, body.radius - CELL);
        for planner in [Planner::RrtConnect, Planner::RrtStar] {
            let mut case = Case::new(from, to, obstacles.clone()).with(planner, seed);
            case.request.most_nodes = 2_000;
            let path = case.plan(&*model);
            assert!(
                path.is_some() || !wide,
                "world {seed}: {planner:?} missed a path"
            );
            assert!(
                path.is_none() || narrow,
                "world {seed}: {planner:?} went through something"
            );
            if let Some(path) = path {
                let whole = case.whole(&*model, &path);
                assert!(
                    least_gap(body, &whole, &obstacles) >= 0.0,
                    "world {seed} {path:?}"
                );
            }
        }
        open += u32::from(wide);
        closed += u32::from(!narrow);
    }
    assert!(
        open >= 20 && closed >= 10,
        "too few worlds to tell: {open} open, {closed} closed"
    );
}
