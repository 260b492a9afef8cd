//! Random seeds find the fault of a shared variable that uses raw clocks, and it is shrunk to two robots whose clocks
//! differ.

use crate::broken::writes::Writer;
use crate::broken::{hunt, robots};
use starl_sim::Profile;

const ORDER: &str = "shared_memory.order";

#[test]
fn clocks_that_are_apart_lose_a_later_write() {
    let quarry = hunt(&robots(5), Profile::Clocks, ORDER, &Writer::default());
    let smallest = &quarry.smallest;
    assert_eq!(smallest.fleet.len(), 2, "{}", quarry.text);
    assert_eq!(smallest.faults.schedule, [], "{}", quarry.text);
    let clock = smallest.fleet.groups[0].clock;
    // Either that it is ahead or that it is fast; both are not needed.
    let (is_ahead, is_fast) = (!clock.offset.is_zero(), clock.drift_ppm != 0.0);
    assert!(is_ahead != is_fast, "{}", quarry.text);
    assert!(smallest.duration < quarry.found.duration);
    assert!(quarry.found.duration.seconds() == 30.0);
}

#[test]
fn shrinking_chaos_leaves_only_the_clocks() {
    let quarry = hunt(&robots(4), Profile::Chaos, ORDER, &Writer::default());
    let smallest = &quarry.smallest;
    let link = starl_sim::scenario::Link {
        distribution: starl_sim::scenario::DelayDistribution::Constant,
        ..Default::default()
    };
    assert_eq!(smallest.fleet.len(), 2, "{}", quarry.text);
    assert_eq!(smallest.faults.schedule, [], "{}", quarry.text);
    assert_eq!(smallest.network.link, link, "{}", quarry.text);
    assert!(
        !smallest.fleet.groups[0].clock.offset.is_zero(),
        "{}",
        quarry.text
    );
}
