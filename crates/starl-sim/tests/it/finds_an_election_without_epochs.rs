//! Random seeds find the fault of an election without epochs, and it is shrunk to one partition of three robots: the
//! majority that existed all the time remains.

use crate::broken::election::Bully;
use crate::broken::{hunt, robots};
use starl_core::Duration;
use starl_sim::Profile;
use starl_sim::scenario::FaultKind;

const EXCLUSION: &str = "election.exclusion";

#[test]
fn each_part_of_a_partition_has_a_leader() {
    let quarry = hunt(
        &robots(5),
        Profile::Partitions,
        EXCLUSION,
        &Bully::default(),
    );
    let smallest = &quarry.smallest;
    assert_eq!(smallest.fleet.len(), 3, "{}", quarry.text);
    let faults = &smallest.faults.schedule;
    assert_eq!(faults.len(), 1, "{}", quarry.text);
    assert!(
        matches!(faults[0].kind, FaultKind::Partition(_)),
        "{}",
        quarry.text
    );
    assert!(
        smallest.duration < Duration::from_seconds(25),
        "{}",
        quarry.text
    );
}
