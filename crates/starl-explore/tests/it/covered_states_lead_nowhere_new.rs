//! A search leaves out states that another one covers. It comes to the same states of robots and checkers as one that
//! tells all states apart.

use crate::any_copies::{REGISTER_IS_UP, WRITE_AND_READ, ballots, barrier, memory, register};
use crate::arbitrated_mutexes_are_safe::{ALL, leases, quorums};
use crate::broadcasts_keep_their_order::{ONE, broadcasts};
use crate::elections_are_safe::election;
use crate::registrations_agree::registration;
use crate::support::tieless::Tieless;
use crate::support::{seeing, setup, watched};
use starl_explore::{Bounds, End, Report, Search, Setup, Step, Walk};
use starl_primitives::broadcast::Order;
use starl_primitives::election::Algorithm::{Bully, Leases};

fn search(setup: Setup, warm_up: u16, covering: bool) -> (End, Report) {
    let (mut walk, _) = Walk::start(setup);
    walk.warm_up(warm_up).expect("robots come to rest");
    let mut search = Search::from(&walk, Vec::new()).expect("few robots");
    search.set_covering(covering);
    (search.run().clone(), search.report())
}

/// Compares both searches; gives how many states of the one the other leaves out.
fn compare(name: &str, setup: &Setup, warm_up: u16) -> u32 {
    let [all, fewer] = [false, true].map(|covering| {
        let (end, report) = search(setup.clone(), warm_up, covering);
        assert_eq!(end, End::Complete, "{name}");
        report
    });
    let seen = |report: &Report| (report.robot_states, report.checker_states);
    assert_eq!(seen(&fewer), seen(&all), "{name}");
    // Steps that only add datagrams come first, so the way to some states is longer.
    assert!(
        setup.bounds.any_copies || fewer.depth <= all.depth,
        "{name}"
    );
    all.states - fewer.states
}

#[test]
fn the_same_states_of_robots_are_reached() {
    let subjects = [
        ("broadcast", broadcasts(Order::Fifo, ONE), 0),
        ("election by leases", election(Leases, 1, 0, 0), 3),
        ("election with late datagrams", election(Bully, 2, 1, 0), 3),
        ("mutex by quorums", quorums(2, &ALL, 0, 1), 0),
        ("mutex by leases", leases(2, &ALL, 0, 1), 1),
        ("registration", registration(1, None, 0), 0),
        ("memory", memory(1), 0),
        ("barrier", barrier(), 0),
        ("register", register(WRITE_AND_READ, 0), REGISTER_IS_UP),
    ];
    for (name, setup, warm_up) in subjects {
        let left_out = compare(name, &watched(setup), warm_up);
        assert!(left_out > 0, "{name}: no state is left out");
    }
}

#[test]
fn a_violation_is_found_in_as_few_steps() {
    for robots in [2, 3] {
        let steps = [false, true].map(|covering| {
            let setup = watched(setup(robots, Tieless::default(), Bounds::default()));
            match search(setup, 0, covering).0 {
                End::Violated(counterexample) => counterexample.steps.len(),
                other => panic!("{other:?}"),
            }
        });
        assert_eq!(steps[0], steps[1], "{robots} robots");
    }
}

/// Whether these steps are possible after a warm-up, and violate something.
fn lead_to_a_violation<'a>(
    setup: &Setup,
    warm_up: u16,
    steps: impl Iterator<Item = &'a Step>,
) -> bool {
    let (mut walk, _) = Walk::start(setup.clone());
    walk.warm_up(warm_up).expect("robots come to rest");
    let mut is_violated = false;
    for step in steps {
        let Ok(moment) = walk.step(step) else {
            return false;
        };
        is_violated |= !moment.violations.is_empty();
    }
    is_violated
}

#[test]
fn with_any_copies_no_step_to_a_violation_can_be_omitted() {
    let write_and_read = register(WRITE_AND_READ, 0);
    let subjects = [
        ("register", write_and_read, REGISTER_IS_UP, ("done", 2)),
        ("election by ballots", ballots(1), 3, ("leader", 3)),
        ("barrier", barrier(), 0, ("pass", 3)),
    ];
    for (name, setup, warm_up, (event, times)) in subjects {
        let setup = seeing(setup, event, times);
        let [all, fewer] =
            [false, true].map(
                |covering| match search(setup.clone(), warm_up, covering).0 {
                    End::Violated(counterexample) => counterexample.steps,
                    other => panic!("{name}: {other:?}"),
                },
            );
        assert_eq!(all.len(), fewer.len(), "{name}");
        assert!(lead_to_a_violation(&setup, warm_up, fewer.iter()), "{name}");
        for omitted in 0..fewer.len() {
            let others = fewer.iter().enumerate();
            let others = others.filter(|(place, _)| *place != omitted);
            assert!(
                !lead_to_a_violation(&setup, warm_up, others.map(|(_, step)| step)),
                "{name}: {} is needless",
                fewer[omitted]
            );
        }
    }
}
