//! A run is decided by its program, scenario and seed, and by nothing else.

use crate::support::*;

const ARGUMENTS: [&str; 5] = ["race", "--duration", "10s", "--set", "network.loss=20%"];

fn with(more: &[&'static str]) -> Vec<&'static str> {
    [&ARGUMENTS[..], more].concat()
}

#[test]
fn the_same_seed_gives_the_same_digest() {
    let folder = folder("seed_same");
    assert_eq!(
        digest(&folder, &with(&["--seed", "3"])),
        digest(&folder, &with(&["--seed", "3"]))
    );
}

#[test]
fn another_seed_gives_another() {
    let folder = folder("seed_other");
    assert_ne!(
        digest(&folder, &with(&["--seed", "3"])),
        digest(&folder, &with(&["--seed", "4"]))
    );
}

#[test]
fn threads_change_nothing() {
    let folder = folder("seed_threads");
    // More robots than step together on one thread.
    let fleet = ["race", "--robots", "holonomic=600", "--duration", "2s"];
    let fleet = [
        &fleet[..],
        &["--set", "world.start_area={low=[-50,-50],high=[50,50]}"],
    ]
    .concat();
    let digests =
        ["1", "2", "3"].map(|n| digest(&folder, &[&fleet[..], &["--threads", n]].concat()));
    assert_eq!(digests[0], digests[1]);
    assert_eq!(digests[0], digests[2]);
}

#[test]
fn watching_changes_nothing() {
    let folder = folder("seed_watched");
    let plain = digest(&folder, &with(&[]));
    assert_eq!(
        plain,
        digest(&folder, &with(&["--trace", "a.mcap", "--plot", "a.svg"]))
    );
}
