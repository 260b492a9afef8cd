//! A search on several threads finds the same, down to the path to a violation, as on one.

use crate::support::locker::Locker;
use crate::support::tieless::Tieless;
use crate::support::{setup, watched};
use starl_explore::{Bounds, End, Report, Search, Setup};
use starl_primitives::mutex::Options;

fn search(setup: Setup, parallel: bool) -> (End, Report) {
    let mut search = Search::new(setup).expect("few robots");
    search.set_parallel(parallel);
    (search.run().clone(), search.report())
}

#[test]
fn the_same_states_and_the_same_path_to_a_violation() {
    let bounds = |timers, most_states| Bounds {
        timers,
        most_states,
        ..Bounds::default()
    };
    let locker = || Locker::new(&[&["a"], &["a"], &["a"]], Options::default());
    let subjects = [
        setup(3, locker(), bounds(0, 1_000_000)),
        setup(3, locker(), bounds(0, 10_000)),
        setup(3, Tieless::default(), bounds(1, 1_000_000)),
    ];
    let subjects = subjects.map(watched);
    let ends = subjects.map(|setup| {
        let (end, report) = search(setup.clone(), false);
        assert!(report.transitions > 5_000, "there are few steps");
        assert_eq!(search(setup, true), (end.clone(), report));
        end
    });
    assert!(matches!(ends, [End::Complete, End::Full, End::Violated(_)]));
}
