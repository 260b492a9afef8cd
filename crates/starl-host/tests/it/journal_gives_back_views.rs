//! A journal restores the calls and the robot's knowledge exactly, although it stores only changes.

use crate::support::{Deed, World, messages, random_deeds, read, text};
use starl_core::{Input, Obstacle, Point, RobotId, Time};

fn assert_same(deeds: &[(Time, Deed)], size: usize) {
    let mut shown = Vec::new();
    for (at, deed) in deeds {
        deed.show(*at, &mut |at, observed| shown.push(text(at, observed)));
    }
    let seen = read(&messages(deeds, size)).expect("it is a journal");
    assert_eq!(seen.len(), shown.len());
    for (number, (seen, shown)) in seen.iter().zip(&shown).enumerate() {
        assert_eq!(seen, shown, "entry {number}");
    }
}

#[test]
fn every_change_is_restored() {
    for seed in 0..200 {
        assert_same(&random_deeds(seed, 60), 1 + seed as usize % 7);
    }
}

fn activation(world: &World) -> Deed {
    Deed::Input(Box::new(world.clone()), Input::Activate, Vec::new())
}

/// Zeros of different sign are equal as numbers, and a program can tell them apart.
#[test]
fn zeros_of_different_sign() {
    let mut world = World::default();
    let mut deeds = Vec::new();
    for zero in [0.0, -0.0, 0.0] {
        world.estimate.pose.yaw = zero;
        world.way_points[0].position = Point::planar(zero, 1.0);
        world.obstacles = [Obstacle::circle(Point::planar(zero, 0.0), 1.0)].into();
        deeds.push((Time(deeds.len() as u64), activation(&world)));
    }
    assert_same(&deeds, 2);
}

/// A clock that runs at another rate shows something new at each moment.
#[test]
fn clocks_that_drift_and_lag() {
    let mut world = World::default();
    let mut deeds = Vec::new();
    for step in 0..50u64 {
        world.now = Time(step * 999_983);
        world.estimate.at = Time(world.now.0.saturating_sub(step % 3));
        deeds.push((Time(step * 1_000_000), activation(&world)));
    }
    assert_same(&deeds, 5);
}

#[test]
fn lists_are_kept_once() {
    let mut world = World {
        fleet: (0..1_000).map(RobotId).collect(),
        ..World::default()
    };
    let first = [(Time(0), activation(&world))];
    let again: Vec<_> = (0..100).map(|at| (Time(at), activation(&world))).collect();
    let size = |deeds: &[(Time, Deed)]| -> usize {
        let messages = messages(deeds, 1);
        messages.iter().map(|(_, bytes)| bytes.len()).sum()
    };
    assert!(size(&first) > 1_000);
    assert!(size(&again) < size(&first) + 99 * 20, "{}", size(&again));
    // A list that comes back is not written again.
    let mut back = again;
    world.fleet.pop();
    back.push((Time(200), activation(&world)));
    let shorter = size(&back);
    world.fleet.push(RobotId(999));
    back.push((Time(201), activation(&world)));
    assert!(size(&back) < shorter + 50);
    assert_same(&back, 3);
}
