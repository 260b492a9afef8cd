//! The numbers of a lease mutex grow independent of clocks, as long as no majority forgets them at once; robots report
//! if one has.

use crate::harness::locker::{Locker, acquire, entries, mutex, release};
use crate::harness::{Wire, World};
use starl_core::event::{MutexEvent, PrimitiveEvent};
use starl_core::{Duration, Event, Random};
use starl_primitives::mutex::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));
const HOUR: i64 = 3_600_000_000_000;

/// Clocks are up to an hour or, of a robot that knows the date, half a century ahead.
fn set_clocks(world: &mut World, random: &mut Random) {
    for robot in 0..world.size() {
        let ahead = random.between(0.0, 1.0) * HOUR as f64;
        let years = if random.chance(0.2) { 50 * 365 * 24 } else { 0 };
        world.set_clock_ahead(robot, ahead as i64 + years * HOUR);
    }
}

/// The robots that continued without knowing the last number.
fn anew(world: &World) -> Vec<u32> {
    let mut anew = Vec::new();
    for (_, robot, event) in &world.records {
        if let Event::Primitive {
            event: PrimitiveEvent::Mutex(MutexEvent::Ready { anew: true, .. }),
            ..
        } = event
        {
            anew.push(robot.0);
        }
    }
    anew
}

/// A robot gets a resource, and gives it back; with this number.
fn enter(world: &mut World, robot: usize) -> u64 {
    world.command(robot, acquire(&["a"]));
    for _ in 0..100 {
        world.run_for(SECOND / 10);
        if let Some(number) = mutex(world, robot).fencing() {
            world.command(robot, release(&["a"]));
            world.run_for(SECOND / 10);
            return number;
        }
    }
    panic!("robot {robot} waits");
}

#[test]
fn numbers_grow_while_robots_crash_in_turn() {
    for seed in 0..40 {
        let mut random = Random::keyed(seed, &[1]);
        let count = 3 + random.below(5) as usize;
        let make = Locker::boxed(Algorithm::Lease, true);
        let mut world = World::new(count, seed, Wire::bad(), PERIOD, make);
        set_clocks(&mut world, &mut random);
        world.run_for(SECOND * 15);
        let at_first = anew(&world).len();
        assert!(at_first > 0);
        let mut crashes = Vec::new();
        for _ in 0..30 {
            let robot = random.below(count as u32);
            world.crash(robot as usize);
            crashes.push((world.now, robot));
            world.run_for(Duration::from_millis(u64::from(random.below(3000))));
            world.start(robot as usize);
            let is_ready = |world: &World| {
                let mut ready = world.records.iter().rev();
                let own = ready.find(|(_, id, event)| {
                    let is_ready = matches!(
                        event,
                        Event::Primitive {
                            event: PrimitiveEvent::Mutex(MutexEvent::Ready { .. }),
                            ..
                        }
                    );
                    id.0 == robot && is_ready
                });
                own.is_some_and(|(at, ..)| *at > crashes[crashes.len() - 1].0)
            };
            for _ in 0..200 {
                if !is_ready(&world) {
                    world.run_for(SECOND / 10);
                }
            }
            assert!(is_ready(&world), "seed {seed}: {robot}");
            world.run_for(Duration::from_millis(u64::from(random.below(3000))));
        }
        assert_eq!(anew(&world).len(), at_first, "seed {seed}");
        let entries = entries(&world, &crashes);
        assert!(entries.values().sum::<usize>() > 30, "seed {seed}");
    }
}

#[test]
fn a_restarted_robot_waits_for_robots_that_may_know_more() {
    let make = Locker::boxed(Algorithm::Lease, false);
    let mut world = World::new(3, 1, Wire::perfect(), PERIOD, make);
    world.set_clock_ahead(2, HOUR);
    world.run_for(SECOND);
    let isolate = |world: &mut World, robot| {
        world.wire.cut.clear();
        world.wire.isolate(robot, 3);
    };
    isolate(&mut world, 0);
    let last = (0..5).map(|_| enter(&mut world, 1)).max();
    // Robot 2 knows the number, and robot 0 has never heard of it.
    isolate(&mut world, 2);
    world.crash(1);
    world.start(1);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND * 30);
    assert!(!mutex(&world, 0).crit());
    assert!(mutex(&world, 0).failed());
    world.wire.cut.clear();
    world.run_for(SECOND * 3);
    assert!(mutex(&world, 0).fencing() > last);
}

#[test]
fn with_storage_numbers_grow_though_all_crash_and_the_fast_clock_does_not_return() {
    for fast in 0..3 {
        let make = Locker::boxed(Algorithm::Lease, false);
        let mut world = World::with_storage(3, 1, Wire::perfect(), PERIOD, make);
        world.set_clock_ahead(fast, HOUR);
        world.run_for(SECOND);
        let last = enter(&mut world, fast);
        (0..3).for_each(|robot| world.crash(robot));
        world.run_for(SECOND);
        let slow = [(fast + 1) % 3, (fast + 2) % 3];
        slow.iter().for_each(|&robot| world.start(robot));
        assert!(enter(&mut world, slow[0]) > last);
        assert_eq!(anew(&world), []);
    }
}

#[test]
fn without_storage_a_majority_that_forgot_is_reported() {
    let make = Locker::boxed(Algorithm::Lease, false);
    let mut world = World::new(3, 1, Wire::perfect(), PERIOD, make);
    world.set_clock_ahead(2, HOUR);
    world.run_for(SECOND);
    enter(&mut world, 2);
    (0..3).for_each(|robot| world.crash(robot));
    world.records.clear();
    world.run_for(SECOND);
    world.start(0);
    world.start(1);
    enter(&mut world, 0);
    assert_eq!(anew(&world).len(), 2);
    // The third learns from them.
    world.start(2);
    world.run_for(SECOND * 5);
    let next = enter(&mut world, 0);
    assert!(enter(&mut world, 2) > next);
    assert_eq!(anew(&world).len(), 2);
}
