//! All behaviours of the permission mutex: no resource is held by two robots, and no robot waits for something that
//! never happens. The sizes are pinned: another number means another protocol or another exploration. Checkers whose
//! state may grow are therefore excluded from the count.

use crate::support::locker::{Exclusion, Locker};
use crate::support::{search, setup, size, watched};
use starl_explore::{Bounds, End};
use starl_primitives::mutex::Options;

/// Explores robots that all want the same resource once.
fn explore(robots: usize, bounds: Bounds) -> (u32, u64, u32) {
    let everyone: &[&[&'static str]] = &[&["a"], &["a"], &["a"]];
    explore_wishes(robots, everyone, bounds)
}

fn explore_wishes(robots: usize, wishes: &[&[&'static str]], bounds: Bounds) -> (u32, u64, u32) {
    let mut setup = setup(robots, Locker::new(wishes, Options::default()), bounds);
    setup.checkers.push(Box::new(Exclusion::default()));
    setup.model.all_finish = true;
    let mut search = search(setup);
    assert_eq!(search.run(), &End::Complete);
    let report = search.report();
    assert!(report.compared > 0, "no two robots came to the same state");
    size(&report)
}

const QUIET: Bounds = Bounds {
    losses: 0,
    duplicates: 0,
    any_copies: false,
    crashes: 0,
    suspicions: 0,
    timers: 0,
    clocks: starl_explore::Clocks::Still,
    depth: None,
    most_states: 10_000_000,
};

#[test]
fn two_robots() {
    assert_eq!(explore(2, QUIET), (50, 73, 9));
}

#[test]
fn two_robots_with_a_crash_a_loss_and_a_repetition() {
    let bounds = Bounds {
        timers: 1,
        losses: 1,
        crashes: 1,
        ..QUIET
    };
    assert_eq!(explore(2, bounds), (31_634, 119_635, 18));
}

#[test]
fn three_robots() {
    assert_eq!(explore(3, QUIET), (18_523, 66_102, 21));
}

#[test]
fn the_checkers_of_every_run_find_nothing() {
    let wishes: &[&[&'static str]] = &[&["a", "b"], &["b", "c"], &["c", "a"]];
    let locker = Locker::new(wishes, Options::default());
    let mut search = search(watched(setup(3, locker, QUIET)));
    assert_eq!(search.run(), &End::Complete);
}

#[test]
fn three_robots_with_overlapping_wishes() {
    let wishes: &[&[&'static str]] = &[&["a", "b"], &["b", "c"], &["c", "a"]];
    assert_eq!(explore_wishes(3, wishes, QUIET), (18_523, 66_102, 21));
}

#[test]
fn three_robots_with_a_loss() {
    let bounds = Bounds { losses: 1, ..QUIET };
    assert_eq!(explore(3, bounds), (71_046, 295_874, 21));
}

#[test]
fn three_robots_with_a_repetition() {
    let bounds = Bounds { timers: 1, ..QUIET };
    assert_eq!(explore(3, bounds), (593_468, 2_730_518, 26));
}

#[test]
#[ignore = "takes a minute without optimisation"]
fn three_robots_with_a_loss_and_a_repetition() {
    let bounds = Bounds {
        timers: 1,
        losses: 1,
        ..QUIET
    };
    assert_eq!(explore(3, bounds), (2_119_073, 11_882_887, 27));
}
