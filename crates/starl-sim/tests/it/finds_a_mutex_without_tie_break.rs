//! A mutex without the tie-break is caught from random seeds, and shrunk to two robots that ask at the same
//! time in a network without fault.

use crate::broken::mutex::Locker;
use crate::broken::{hunt, robots, trial};
use starl_core::Duration;
use starl_sim::Profile;

const SAFETY: &str = "mutex.safety";

#[test]
fn two_robots_that_ask_at_the_same_time_both_enter() {
    let quarry = hunt(&robots(4), Profile::Lossy, SAFETY, &Locker::default());
    let smallest = &quarry.smallest;
    assert_eq!(smallest.fleet.len(), 2, "{}", quarry.text);
    assert_eq!(smallest.faults.schedule, [], "{}", quarry.text);
    assert_eq!(smallest.network.link.loss, 0.0, "{}", quarry.text);
    assert!(
        smallest.duration < Duration::from_seconds(15),
        "{}",
        quarry.text
    );
}

#[test]
fn with_the_tie_break_no_seed_is_found() {
    let right = Locker::without_mistake();
    for seed in 1..=100 {
        let scenario = robots(4);
        let drawn = Profile::Lossy.apply(&scenario, scenario.duration, seed);
        assert_eq!(trial(drawn, &right).finding, None, "seed {seed}");
    }
}
