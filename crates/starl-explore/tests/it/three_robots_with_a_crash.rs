//! Three robots, of which one crashes and restarts, one datagram that arrives twice, and any number that never arrive:
//! what is hard for a protocol without storage. The checkers are those of every run. `any_copies` has the protocols that
//! are explored with any number of copies.

use crate::broadcasts_keep_their_order::{FOUNDED, ONE, broadcasts, total};
use crate::elections_are_safe::election;
use crate::support::locker::Locker;
use crate::support::{happens, setup, size, watched};
use starl_explore::{Bounds, End, Search, Setup, Walk};
use starl_primitives::broadcast::Order;
use starl_primitives::election::Algorithm::Leases;
use starl_primitives::mutex::{Algorithm, Options};

/// The one resource is wanted by all of them, or by two.
pub const ALL: [&[&str]; 3] = [&["a"], &["a"], &["a"]];
pub const TWO: [&[&str]; 3] = [&["a"], &["a"], &[]];

pub fn mutex(algorithm: Algorithm, wishes: &[&[&'static str]], timers: u8) -> Setup {
    let options = Options {
        algorithm,
        ..Options::default()
    };
    let bounds = Bounds {
        timers,
        ..Bounds::default()
    };
    setup(3, Locker::new(wishes, options), bounds)
}

/// The states, transitions and depth of a complete exploration after a warm-up.
fn explore(setup: Setup, warm_up: u16) -> (u32, u64, u32) {
    let (mut walk, _) = Walk::start(with_faults(setup));
    walk.warm_up(warm_up).expect("robots come to rest");
    let mut search = Search::from(&walk, Vec::new()).expect("few robots");
    assert_eq!(search.run(), &End::Complete);
    size(&search.report())
}

fn with_faults(setup: Setup) -> Setup {
    let mut setup = watched(setup);
    setup.bounds.crashes = 1;
    setup.bounds.duplicates = 1;
    setup.bounds.most_states = 200_000_000;
    setup
}

#[test]
fn resources_are_held_and_messages_delivered() {
    let permission = mutex(Algorithm::Permission, &TWO, 0);
    assert!(happens(with_faults(permission), 0, "enter"));
    let fifo = broadcasts(Order::Fifo, &[2, 0, 0]);
    assert!(happens(with_faults(fifo), 0, "deliver"));
}

#[test]
fn mutex_by_permission_that_two_want() {
    let mutex = mutex(Algorithm::Permission, &TWO, 0);
    assert_eq!(explore(mutex, 0), (314_839, 1_311_019, 25));
}

#[test]
#[ignore = "takes a minute without optimisation"]
fn mutex_by_permission_that_two_want_with_a_repetition() {
    let mutex = mutex(Algorithm::Permission, &TWO, 1);
    assert_eq!(explore(mutex, 0), (4_668_565, 22_725_660, 30));
}

#[test]
#[ignore = "takes minutes"]
fn mutex_by_permission_that_all_want() {
    let mutex = mutex(Algorithm::Permission, &ALL, 0);
    assert_eq!(explore(mutex, 0), (29_551_103, 141_590_068, 33));
}

#[test]
#[ignore = "takes minutes"]
fn mutex_by_quorums_that_two_want() {
    let mutex = mutex(Algorithm::Quorum, &TWO, 0);
    assert_eq!(explore(mutex, 0), (26_022_473, 125_643_847, 34));
}

#[test]
#[ignore = "takes a minute without optimisation"]
fn election_by_leases() {
    let size = (3_823_719, 18_142_591, 26);
    assert_eq!(explore(election(Leases, 1, 0, 1), 3), size);
}

#[test]
fn two_messages_of_one_robot() {
    let sizes = [
        (Order::Unordered, (235_808, 916_867, 19)),
        (Order::Fifo, (235_808, 916_867, 19)),
        (Order::Causal, (239_642, 927_247, 19)),
    ];
    for (order, expected) in sizes {
        let size = explore(broadcasts(order, &[2, 0, 0]), 0);
        assert_eq!(size, expected, "{order:?}");
    }
}

#[test]
#[ignore = "takes minutes, and 5 GB of memory"]
fn messages_of_two_robots_in_causal_order() {
    let broadcasts = broadcasts(Order::Causal, &[1, 1, 0]);
    assert_eq!(explore(broadcasts, 0), (81_542_639, 291_065_904, 25));
}

#[test]
#[ignore = "takes minutes, and 7 GB of memory"]
fn one_message_in_total_order() {
    let size = (57_555_840, 181_768_765, 33);
    assert_eq!(explore(total(ONE, Bounds::default()), FOUNDED), size);
}
