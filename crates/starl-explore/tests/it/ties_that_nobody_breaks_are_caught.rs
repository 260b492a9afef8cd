//! A mutex that lacks the order of requests with the same time lets two robots in, and the search finds
//! the shortest way there.

use crate::support::tieless::Tieless;
use crate::support::{search, setup, watched};
use starl_explore::{Bounds, Counterexample, End, Setup, Step, Walk};

fn broken(robots: usize) -> Setup {
    watched(setup(robots, Tieless::default(), Bounds::default()))
}

fn counterexample(robots: usize) -> Counterexample {
    match search(broken(robots)).run() {
        End::Violated(counterexample) => counterexample.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn two_robots_ask_at_the_same_time_and_both_enter() {
    let Counterexample { steps, violation } = counterexample(2);
    // Two ask, two requests arrive, two permissions arrive: nothing of it can be left out.
    assert_eq!(steps.len(), 6, "{steps:?}");
    let activations = steps
        .iter()
        .filter(|step| matches!(step, Step::Activate(_)));
    assert_eq!(activations.count(), 2);
    assert_eq!(violation.property, "mutex.safety");
}

#[test]
fn among_three_robots_the_third_has_to_permit_both() {
    // One that need not ask itself: 2 activations, 4 requests and 4 permissions.
    assert_eq!(counterexample(3).steps.len(), 10);
}

#[test]
fn the_counterexample_can_be_walked() {
    for robots in [2, 3] {
        let Counterexample { steps, violation } = counterexample(robots);
        let (mut walk, first) = Walk::start(broken(robots));
        assert_eq!(first.violations, []);
        let (last, before) = steps.split_last().expect("some steps");
        for step in before {
            assert_eq!(walk.step(step).expect("it is possible").violations, []);
        }
        let moment = walk.step(last).expect("it is possible");
        assert_eq!(moment.violations, [violation]);
        assert!(walk.step(last).is_err(), "the datagram has arrived");
    }
}
