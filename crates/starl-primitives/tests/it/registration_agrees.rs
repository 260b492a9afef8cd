//! Registered robots eventually show the same list, and a new one whenever a robot registers, leaves,
//! crashes or restarts.

use crate::harness::registrar::{
    Registrar, agree, judge, list, register, register_within, registration, unregister,
};
use crate::harness::{Wire, World};
use starl_core::{Duration, Point};
use starl_primitives::registration::Options;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn idle(count: usize, seed: u64, wire: Wire) -> World {
    let make = Registrar::boxed(false, Options::default());
    World::new(count, seed, wire, PERIOD, make)
}

fn checked(world: &World) -> usize {
    judge(world, &[], Options::default().settle)
}

#[test]
fn robots_that_register_together_are_in_one_list() {
    for seed in 0..50 {
        let mut world = idle(5, seed, Wire::perfect());
        (0..4).for_each(|robot| world.command(robot, register()));
        assert_eq!(list(&world, 0), None);
        world.run_for(Options::default().agreement_bound(world.wire.longest_delay()));
        assert!(agree(&world, &[0, 1, 2, 3]));
        assert_eq!(list(&world, 4), None);
        assert_eq!(checked(&world), 4);
    }
}

#[test]
fn a_lone_robot_agrees_with_itself() {
    let mut world = idle(3, 1, Wire::perfect());
    world.command(1, register());
    world.run_for(SECOND);
    assert!(agree(&world, &[1]));
}

#[test]
fn newcomers_and_leavers_make_for_a_new_list() {
    for seed in 0..50 {
        let mut world = idle(4, seed, Wire::perfect());
        for robot in [2, 0, 3, 1] {
            world.command(robot, register());
            world.run_for(Options::default().agreement_bound(world.wire.longest_delay()));
            assert!(
                list(&world, robot).unwrap().contains(&(robot as u32)),
                "seed {seed}"
            );
        }
        assert!(agree(&world, &[0, 1, 2, 3]));
        // One after the other, they came to four lists, which 1, 2, 3 and 4 robots showed.
        assert_eq!(checked(&world), 10);
        for (robot, rest) in [(2, &[0, 1, 3][..]), (0, &[1, 3]), (1, &[3])] {
            world.command(robot, unregister());
            assert_eq!(list(&world, robot), None);
            world.run_for(SECOND);
            assert!(agree(&world, rest), "seed {seed}");
            assert_eq!(list(&world, robot), None);
        }
        checked(&world);
    }
}

#[test]
fn a_crash_is_noticed_and_a_restart_too() {
    for seed in 0..50 {
        for robot in 0..4 {
            let mut world = idle(4, seed, Wire::perfect());
            (0..4).for_each(|robot| world.command(robot, register()));
            world.run_for(SECOND * 20);
            let rest: Vec<u32> = (0..4).filter(|&other| other != robot as u32).collect();
            world.crash(robot);
            world.run_for(SECOND * 5);
            assert!(agree(&world, &rest), "seed {seed}");
            world.start(robot);
            world.run_for(SECOND * 2);
            assert!(agree(&world, &rest) && list(&world, robot).is_none());
            world.command(robot, register());
            world.run_for(SECOND);
            assert!(agree(&world, &[0, 1, 2, 3]), "seed {seed}");
            // A restart that is too short to be noticed.
            world.run_for(SECOND * 10);
            world.crash(robot);
            world.start(robot);
            world.run_for(SECOND * 5);
            assert!(agree(&world, &rest), "seed {seed}");
        }
    }
}

#[test]
fn a_crash_without_a_failure_detector_is_noticed_at_the_next_change() {
    let mut world = idle(4, 1, Wire::perfect());
    (0..3).for_each(|robot| world.command(robot, register()));
    world.run_for(SECOND);
    world.crash(1);
    world.command(3, register());
    world.run_for(SECOND * 2 + Options::default().exclusion_bound());
    assert!(agree(&world, &[0, 2, 3]));
}

#[test]
fn robots_of_one_area_agree() {
    for seed in 0..20 {
        let mut world = idle(5, seed, Wire::perfect());
        for (robot, x) in [(0, 50.0), (1, 1.0), (2, 80.0), (3, 2.0), (4, 3.0)] {
            world.place(robot, Point::planar(x, 0.0));
        }
        (0..4).for_each(|robot| world.command(robot, register_within(10)));
        world.run_for(SECOND);
        assert!(agree(&world, &[1, 3]));
        // These are far from them and from each other.
        assert!(agree(&world, &[0]) && agree(&world, &[2]));
        // A robot that has left the area stays in the list; the next still enters.
        world.place(1, Point::planar(200.0, 0.0));
        world.command(4, register_within(10));
        world.run_for(SECOND * 3);
        assert!(agree(&world, &[1, 3, 4]), "seed {seed}");
        checked(&world);
    }
}

#[test]
fn a_long_wait_is_reported() {
    let mut world = idle(2, 1, Wire::perfect());
    world.command(0, register());
    world.command(1, register());
    world.run_for(SECOND * 5);
    assert!(agree(&world, &[0, 1]));
    // Robot 0 hears nothing any more and does not know it: it is heard, but does not answer.
    world.wire.cut.insert((1, 0));
    world.command(1, unregister());
    world.command(1, register());
    let mut failed = false;
    for _ in 0..200 {
        world.run_for(SECOND / 10);
        failed |= registration(&world, 1).failed();
        assert!(!registration(&world, 1).failed() || list(&world, 1).is_none());
    }
    assert!(list(&world, 1).is_some() || failed);
    checked(&world);
}

#[test]
fn a_list_of_one_that_has_left_since_is_not_waited_for() {
    let reorders = Wire {
        delay_ms: (1, 300),
        ..Wire::perfect()
    };
    for seed in 0..20 {
        let make = Registrar::boxed(false, Options::default());
        let mut world = World::new(2, seed, reorders.clone(), None, make);
        (0..2).for_each(|robot| world.command(robot, register()));
        while world.events("propose").is_empty() {
            world.run_for(Duration::from_millis(1));
        }
        let coordinator = world.events("propose")[0].1.index();
        world.command(coordinator, unregister());
        world.run_for(Duration::from_seconds(3));
        let other = 1 - coordinator;
        assert_eq!(list(&world, other), Some(vec![other as u32]), "seed {seed}");
    }
}
