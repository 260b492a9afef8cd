//! From any state that a fault leaves, the current command of ReachAvoid ends, and the next one is executed.

use crate::harness::pilot::{Bench, p};
use starl_core::Random;
use starl_primitives::reach_avoid::Options;

/// The planner answers at once, the robot drives to its target, and where neither happens the timer fires. Returns
/// whether the command ends.
fn goes_on_to_the_end(bench: &mut Bench) -> bool {
    let mut answered = bench.plans.len();
    for _ in 0..500 {
        if !bench.reach_avoid.active() {
            return true;
        }
        if bench.plans.len() > answered {
            answered = bench.plans.len();
            let target = bench.plans[answered - 1].target;
            bench.answer(Some(vec![bench.position.lerp(target, 0.5), target]));
        } else if let Some((target, _)) = bench.tracked
            && target.distance(bench.position) > 0.05
        {
            let way = target.distance(bench.position).max(1.0);
            bench.at(bench.position.lerp(target, 1.0 / way));
        } else if bench.timer.is_some() {
            bench.time_out();
        } else {
            return false;
        }
    }
    false
}

#[test]
fn commands_end_from_any_state() {
    let mut lost = 0;
    for seed in 0..500 {
        let mut random = Random::keyed(seed, &[]);
        let mut bench = Bench::new(Options::default());
        bench.go(p(9.0, 0.0), [].into());
        if random.chance(0.8) {
            bench.answer(Some(vec![p(3.0, 0.0), p(9.0, 0.0)]));
        }
        for step in 1..1 + random.below(6) {
            bench.at(p(f64::from(step), 0.0));
        }
        bench.reach_avoid.corrupt(&mut random);
        lost += usize::from(!bench.reach_avoid.active());
        assert!(
            goes_on_to_the_end(&mut bench),
            "seed {seed}: {:?}",
            bench.reach_avoid
        );
        bench.go(p(0.0, 5.0), [].into());
        assert!(goes_on_to_the_end(&mut bench), "seed {seed}");
        assert_eq!(bench.flags(), (false, true, false), "seed {seed}");
        assert!(bench.position.distance(p(0.0, 5.0)) < 0.1, "seed {seed}");
    }
    assert!((100..400).contains(&lost), "{lost}");
}
