//! A path from beside one side of a block to beside another is found with few nodes and the whole margin.
//! Searches begin where there is room, not in the dents around the ends, where nearly all extensions of a
//! tree are dead ends.

use crate::planning_support::{Case, model, rectangle};
use starl_core::Point;
use starl_core::motion::Planner;
use starl_motion::planning::{self, Options};

const SEEDS: u64 = 200;

#[test]
fn few_nodes_suffice_for_ends_beside_a_wall() {
    for name in ["create", "drone"] {
        let model = model(name);
        let radius = model.body().radius;
        for (start_gap, target_gap) in [(0.01, 0.02), (0.04, 0.04), (0.006, 0.006)] {
            // With the whole margin alone.
            let options = Options {
                least_margin: Options::default().margin_radii * radius,
                ..Options::default()
            };
            let is_found = |seed: u64| {
                let block = rectangle((0.0, 0.0), (2.0, 2.0));
                let from = Point::planar(-radius - start_gap, 1.0);
                let target = Point::planar(1.0, 2.0 + radius + target_gap);
                let target = model.body().reachable(target);
                let mut case = Case::new(from, target, vec![block]);
                case = case.with(Planner::RrtConnect, seed);
                case.request.most_nodes = 600;
                let estimate = case.estimate();
                planning::plan_with(&options, &*model, &estimate, &case.request, &[]).is_some()
            };
            let found = (0..SEEDS).filter(|&seed| is_found(seed)).count();
            assert!(
                found >= 195,
                "{name} {start_gap} {target_gap}: {found} of {SEEDS}"
            );
        }
    }
}
