//! A fleet may be one robot: nothing that its primitives promise is broken by that.

use crate::support::Case;
use starl_sim::Outcome;

#[test]
fn programs_run_on_one_robot() {
    let examples = [
        "race",
        "mutex",
        "election",
        "register",
        "memory",
        "registration",
        "barrier",
        "detector",
        "messages",
        "broadcast",
        "flocking",
        "auction",
    ];
    for example in examples {
        for seed in 1..3 {
            let case = Case {
                robots: Some("create=1"),
                ..Case::new(example, &[], seed)
            };
            let run = case.run();
            assert_eq!(run.violations(), [], "{example}, seed {seed}");
            assert_eq!(run.outcome(), Outcome::Reached, "{example}, seed {seed}");
        }
    }
}
