//! With leases a holder may crash: others get its resources when the lease ends, with a greater number. Clocks may
//! drift within the bound; beyond it two robots may hold the same resource, and their numbers distinguish them.

use crate::harness::locker::{Locker, RESOURCES, acquire, entries, mutex, numbers, release, set};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random};
use starl_primitives::mutex::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn world(count: usize, seed: u64, wire: Wire, is_busy: bool) -> World {
    let boxed = Locker::boxed(Algorithm::Lease, is_busy);
    World::new(count, seed, wire, PERIOD, boxed)
}

fn calm(count: usize) -> World {
    let mut world = world(count, 1, Wire::perfect(), false);
    world.run_for(SECOND * 5);
    world
}

/// Whether a robot that waits enters within this number of half seconds.
fn enters(world: &mut World, robot: usize, halves: u32) -> bool {
    (0..halves).any(|_| {
        world.run_for(SECOND / 2);
        mutex(world, robot).crit()
    })
}

#[test]
fn resources_of_a_crashed_robot_are_free_after_its_lease() {
    let mut world = calm(4);
    world.command(3, acquire(&["a", "b"]));
    world.run_for(SECOND * 30);
    let first = mutex(&world, 3).fencing();
    assert!(first.is_some());
    world.crash(3);
    world.command(0, acquire(&["b", "c"]));
    world.run_for(Duration::from_millis(1500));
    assert!(!mutex(&world, 0).crit());
    world.run_for(Duration::from_millis(1500));
    assert!(mutex(&world, 0).holds(&set(&["b", "c"])));
    assert!(mutex(&world, 0).fencing() > first);
    assert!(!mutex(&world, 0).failed());
}

#[test]
fn a_robot_that_can_send_but_not_hear_blocks_no_majority() {
    for seed in 0..20 {
        let mut world = world(3, seed, Wire::perfect(), false);
        world.run_for(SECOND * 5);
        world.wire.cut.extend([(0, 2), (1, 2)]);
        world.command(2, acquire(&["a"]));
        world.run_for(SECOND / 10);
        world.command(0, acquire(&["a"]));
        world.run_for(SECOND * 20);
        assert!(mutex(&world, 0).holds(&set(&["a"])), "seed {seed}");
        assert!(mutex(&world, 2).is_waiting() && mutex(&world, 2).failed());
        world.wire.cut.clear();
        world.command(0, release(&["a"]));
        world.run_for(SECOND * 5);
        assert!(mutex(&world, 2).holds(&set(&["a"])), "seed {seed}");
    }
}

#[test]
fn a_robot_that_hears_others_than_hear_it_blocks_no_majority() {
    // Robot 2 is heard by 0 alone, and hears 1 alone: it trusts a majority, and each of its requests reaches an arbiter.
    for seed in 0..20 {
        let wire = Wire {
            loss: [0.0, 0.2][seed as usize % 2],
            ..Wire::perfect()
        };
        let mut world = world(3, seed, wire, false);
        world.run_for(SECOND * 5);
        world.wire.cut.extend([(0, 2), (2, 1)]);
        world.command(2, acquire(&["a"]));
        world.run_for(SECOND * 5);
        for turn in 0..6 {
            let robot = turn % 2;
            world.command(robot, acquire(&["a"]));
            assert!(enters(&mut world, robot, 24), "seed {seed}, turn {turn}");
            world.command(robot, release(&["a"]));
        }
        world.wire.cut.clear();
        world.run_for(SECOND * 10);
        assert!(mutex(&world, 2).crit(), "seed {seed}");
    }
}

#[test]
fn robots_that_fail_soon_after_the_start_leave_a_majority_that_works() {
    for seed in 0..60 {
        let wire = Wire {
            loss: [0.0, 0.3][seed as usize % 2],
            ..Wire::perfect()
        };
        let mut world = world(5, seed, wire, false);
        for robot in world.lose_two_early(seed) {
            world.command(robot, acquire(&["a"]));
            assert!(enters(&mut world, robot, 40), "seed {seed}, robot {robot}");
            world.command(robot, release(&["a"]));
        }
    }
}

#[test]
fn a_robot_that_hears_a_minority_keeps_no_grants() {
    for seed in 0..10 {
        let mut world = world(4, seed, Wire::perfect(), false);
        world.run_for(SECOND * 5);
        world.wire.cut.extend([(0, 3), (1, 3)]);
        world.run_for(SECOND * 10);
        world.command(3, acquire(&["a"]));
        world.run_for(SECOND);
        world.command(0, acquire(&["a"]));
        world.run_for(SECOND * 12);
        assert!(mutex(&world, 0).crit(), "seed {seed}");
    }
}

#[test]
fn a_robot_that_is_taken_for_deaf_has_its_turn_again_when_it_answers() {
    // Robots 0 and 1 ask for the same all the time. Robot 2 was deaf, and must not wait behind them for ever.
    for seed in 0..10 {
        let mut world = world(3, seed, Wire::perfect(), false);
        world.run_for(SECOND * 5);
        world.wire.cut.extend([(0, 2), (1, 2)]);
        world.command(2, acquire(&["a"]));
        let mut entered = None;
        for turn in 0..60 {
            if turn == 30 {
                world.wire.cut.clear();
            }
            for robot in [0, 1] {
                world.command(robot, acquire(&["a"]));
            }
            world.run_for(SECOND / 2);
            for robot in [0, 1] {
                world.command(robot, release(&["a"]));
            }
            if mutex(&world, 2).crit() {
                entered = entered.or(Some(turn));
            }
        }
        assert!(
            entered.is_some_and(|turn| turn < 45),
            "seed {seed}: {entered:?}"
        );
    }
}

#[test]
fn copies_of_the_requests_of_a_holder_that_has_crashed_do_not_keep_its_lease() {
    let wire = Wire {
        duplication: 1.0,
        late: (0.2, 10_000),
        ..Wire::perfect()
    };
    let mut times = Vec::new();
    for seed in 0..40 {
        let mut world = world(5, seed, wire.clone(), false);
        world.run_for(SECOND * 5);
        world.command(3, acquire(&["a"]));
        world.run_for(SECOND * 15);
        assert!(mutex(&world, 3).crit(), "seed {seed}");
        world.crash(3);
        let since = world.now;
        world.command(0, acquire(&["a"]));
        while !mutex(&world, 0).crit() {
            world.run_for(Duration::from_millis(50));
            assert!(world.now.since(since) < SECOND * 60, "seed {seed}");
        }
        times.push(world.now.since(since));
    }
    times.sort_unstable();
    let (median, longest) = (times[times.len() / 2], times[times.len() - 1]);
    println!("median {median}, longest {longest}");
    assert!(median < SECOND * 4, "{median}");
}

#[test]
fn a_holder_that_is_cut_off_knows_when_its_lease_has_ended() {
    let mut world = calm(4);
    world.command(3, acquire(&["a"]));
    world.run_for(SECOND);
    world.command(0, acquire(&["a"]));
    world.wire.cut = (0..3).flat_map(|robot| [(robot, 3), (3, robot)]).collect();
    let mut last_held = None;
    for step in 0..5000 {
        world.run_for(Duration::from_millis(1));
        let both = mutex(&world, 3).crit() && mutex(&world, 0).crit();
        assert!(!both);
        if mutex(&world, 3).crit() {
            last_held = Some(step);
        }
    }
    assert!(
        last_held > Some(1000) && last_held < Some(2000),
        "{last_held:?}"
    );
    assert!(mutex(&world, 0).crit());
    assert!(mutex(&world, 3).fencing().is_none() && !mutex(&world, 3).holds(&set(&["a"])));
}

#[test]
fn no_request_waits_for_a_lease_if_all_arbiters_hear_of_each_other() {
    let mut world = world(3, 1, Wire::perfect(), false);
    world.run_for(SECOND / 5);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND / 5);
    let first = mutex(&world, 0).fencing();
    assert!(first.is_some());
    // Both others have forgotten what they granted.
    for robot in [1, 2] {
        world.crash(robot);
        world.run_for(Duration::from_millis(10));
        world.start(robot);
    }
    world.command(1, acquire(&["a"]));
    world.command(2, acquire(&["b"]));
    world.run_for(SECOND / 5);
    assert!(mutex(&world, 0).crit() && !mutex(&world, 1).crit());
    assert!(mutex(&world, 2).crit());
    world.command(0, release(&["a"]));
    world.run_for(SECOND / 5);
    assert!(mutex(&world, 1).crit() && mutex(&world, 1).fencing() > first);
}

#[test]
fn numbers_grow_though_robots_that_forgot_them_have_different_clocks() {
    let mut world = world(3, 1, Wire::perfect(), false);
    world.set_clock_ahead(1, 3_600_000_000_000);
    world.run_for(SECOND / 5);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND / 5);
    let first = mutex(&world, 0).fencing();
    world.command(0, release(&["a"]));
    world.run_for(SECOND / 5);
    for robot in [0, 1, 2] {
        world.crash(robot);
    }
    world.run_for(Duration::from_millis(10));
    for robot in [0, 1, 2] {
        world.start(robot);
    }
    world.run_for(SECOND / 5);
    world.command(2, acquire(&["a"]));
    world.run_for(SECOND / 5);
    assert!(first.is_some() && mutex(&world, 2).fencing() > first);
}

#[test]
fn a_minority_waits_and_says_so() {
    let mut world = calm(5);
    world.run_for(SECOND * 20);
    for robot in [2, 3, 4] {
        world.crash(robot);
    }
    world.run_for(SECOND * 5);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND * 5);
    assert!(!mutex(&world, 0).crit() && mutex(&world, 0).failed());
    // A majority may have forgotten numbers that those two have never heard of, or be cut off and know them.
    for robot in [2, 3] {
        world.start(robot);
        world.run_for(SECOND * 20);
        assert!(!mutex(&world, 0).crit() && mutex(&world, 0).failed());
    }
    // Three are seen to have forgotten, and that is a majority.
    world.start(4);
    world.run_for(SECOND * 8);
    assert!(mutex(&world, 0).crit() && !mutex(&world, 0).failed());
}

#[test]
fn clocks_that_run_wrong_within_the_bound_do_not_matter() {
    for seed in 0..30 {
        let mut random = Random::keyed(seed, &[5]);
        let mut world = world(5, seed, Wire::bad(), true);
        for robot in 0..5 {
            world.set_clock_drift(robot as usize, random.between(-0.01, 0.01));
            world.set_clock_ahead(robot as usize, i64::from(random.bits()));
        }
        let mut crashes = Vec::new();
        for _ in 0..20 {
            world.run_for(Duration::from_millis(u64::from(random.below(6000))));
            let robot = random.below(5);
            world.crash(robot as usize);
            crashes.push((world.now, robot));
            world.run_for(Duration::from_millis(u64::from(random.below(4000))));
            world.start(robot as usize);
        }
        world.run_for(SECOND * 60);
        let entries = entries(&world, &crashes);
        assert!(
            entries.values().sum::<usize>() >= 10,
            "seed {seed}: {entries:?}"
        );
    }
}

#[test]
fn no_two_have_the_same_number_however_wrong_clocks_run() {
    let mut at_once = 0;
    for seed in 0..30 {
        let mut random = Random::keyed(seed, &[6]);
        let mut world = world(5, seed, Wire::bad(), true);
        for robot in 0..5 {
            world.set_clock_drift(robot as usize, random.between(-0.9, 3.0));
        }
        for _ in 0..20 {
            let (one, other) = (random.below(5), random.below(5));
            world.wire.cut = [(one, other), (other, one)].into();
            world.run_for(Duration::from_millis(u64::from(random.below(8000))));
        }
        at_once += numbers(&world);
    }
    // Otherwise this would show nothing.
    assert!(at_once > 0);
}

#[test]
fn a_renewed_lease_lasts_as_long_as_it_is_used() {
    let mut world = calm(3);
    world.command(1, acquire(&RESOURCES));
    world.run_for(SECOND);
    let number = mutex(&world, 1).fencing();
    for _ in 0..100 {
        world.run_for(SECOND);
        assert!(mutex(&world, 1).holds(&set(&RESOURCES)));
        assert_eq!(mutex(&world, 1).fencing(), number);
    }
    world.command(1, release(&["a"]));
    world.run_for(SECOND * 10);
    assert_eq!(mutex(&world, 1).held(), &set(&["b", "c", "d"]));
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND);
    assert!(mutex(&world, 0).crit());
}
