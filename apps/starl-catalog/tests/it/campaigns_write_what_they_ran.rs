//! The scenario of a campaign's run is the same again when it is written and read, so that a failure can be repeated
//! from its file.

use crate::support::Case;
use starl_catalog::examples::{self, EXAMPLES, Example};
use starl_catalog::programs::Registry;
use starl_core::Duration;
use starl_sim::profile::Profile;
use starl_sim::read::{Request, Source};
use starl_sim::{Scenario, write};

fn again(scenario: &Scenario, example: &Example) -> Scenario {
    let source = Source::new("written", write::scenario(scenario));
    let read = starl_catalog::read(&Request::new(source), example, &Registry::default());
    read.unwrap_or_else(|problems| panic!("{problems}"))
        .scenario()
        .clone()
}

fn assert_all_the_same(case: Case<'_>, seeds: std::ops::Range<u64>) {
    let example = examples::find(case.example).expect("it is an example");
    let application = case.application();
    for profile in Profile::ALL {
        for seed in seeds.clone() {
            let drawn = profile.apply(application.scenario(), Duration::from_seconds(60), seed);
            let (drawn, read) = (
                format!("{drawn:#?}"),
                format!("{:#?}", again(&drawn, example)),
            );
            let mut lines = drawn.lines().zip(read.lines());
            let difference = lines.find(|(drawn, read)| drawn != read);
            let profile = profile.name();
            assert_eq!(difference, None, "{}, {profile}, seed {seed}", case.example);
            assert_eq!(drawn.len(), read.len());
        }
    }
}

#[test]
fn every_example_in_every_weather() {
    for example in EXAMPLES {
        assert_all_the_same(Case::new(example.name, &[], 1), 1..3);
    }
}

#[test]
fn a_fleet_of_other_models() {
    for robots in ["car=4", "create=1,drone=2", "drone=1"] {
        let case = Case {
            robots: Some(robots),
            ..Case::new("race", &[], 1)
        };
        assert_all_the_same(case, 1..3);
    }
}
