//! With storage, acknowledgements, grants and promises survive crashes of all robots at once, under all network faults;
//! the robots continue without waiting. A robot whose storage is lost recovers like robots without storage.

use crate::harness::elector::{self, Elector, agreed, by, election};
use crate::harness::keeper::{self, Keeper, known, read, result, write};
use crate::harness::locker::{self, Locker, acquire, entries, mutex, release};
use crate::harness::{Wire, World};
use starl_core::{Duration, Program, Random, Time};
use starl_primitives::election::Algorithm as Election;
use starl_primitives::mutex::Algorithm as Mutex;

const SECOND: Duration = Duration::from_seconds(1);
const MILLISECOND: Duration = Duration::from_millis(1);

/// A fleet with storage that often crashes, now and then all at once.
struct Stormy {
    world: World,
    random: Random,
    /// When each robot crashed, and how many records there were before.
    crashes: Vec<(Time, usize, u32)>,
}

impl Stormy {
    fn new(
        count: usize,
        seed: u64,
        period: Option<Duration>,
        make: impl Fn() -> Box<dyn Program> + 'static,
    ) -> Stormy {
        let mut world = World::with_storage(count, seed, Wire::bad(), period, make);
        let random = Random::keyed(seed, &[9]);
        world.write_time = MILLISECOND * u64::from(random.clone().below(50));
        Stormy {
            world,
            random,
            crashes: Vec::new(),
        }
    }

    /// Some robots or all crash; each restarts within a second.
    fn storm(&mut self) {
        let share = if self.random.chance(0.3) { 1.0 } else { 0.4 };
        let mut down = Vec::new();
        for robot in 0..self.world.size() {
            if self.random.chance(share) {
                let (now, records) = (self.world.now, self.world.records.len());
                self.crashes.push((now, records, robot as u32));
                self.world.crash(robot);
                down.push(robot);
            }
            // Not all at the same moment of what they do.
            self.world
                .run_for(MILLISECOND * u64::from(self.random.below(20)));
        }
        for robot in down {
            self.world
                .run_for(MILLISECOND * u64::from(self.random.below(300)));
            self.world.start(robot);
        }
    }

    fn storms(&mut self, count: u32) {
        for _ in 0..count {
            self.world
                .run_for(MILLISECOND * u64::from(self.random.below(4000)));
            self.storm();
        }
    }
}

#[test]
fn registers_stay_linearizable_when_all_robots_crash() {
    let mut done = 0;
    for seed in 0..60 {
        let make = Keeper::boxed(true, None);
        let mut stormy = Stormy::new(3 + seed as usize % 3, seed, Some(MILLISECOND * 50), make);
        stormy.storms(25);
        stormy.world.run_for(SECOND * 10);
        let judged = keeper::judge(&stormy.world);
        done += judged
            .unwrap_or_else(|error| panic!("seed {seed}: {error}"))
            .values()
            .sum::<usize>();
    }
    println!("{done} operations");
    assert!(done > 5_000, "{done}");
}

#[test]
fn a_register_is_there_again_when_all_robots_are() {
    let mut world = World::with_storage(3, 1, Wire::perfect(), None, Keeper::boxed(false, None));
    world.run_for(SECOND);
    world.command(0, write(7));
    world.run_for(SECOND);
    (0..3).for_each(|robot| world.crash(robot));
    world.run_for(SECOND * 60);
    // A majority is enough, and answers at once.
    world.start(1);
    world.start(2);
    assert_eq!(known(&world, 1), Some(7));
    world.command(2, read());
    world.run_for(MILLISECOND * 100);
    assert_eq!(result(&world, 2), Some(7));
}

#[test]
fn a_robot_whose_storage_is_lost_recovers_from_the_others() {
    let mut world = World::with_storage(3, 1, Wire::perfect(), None, Keeper::boxed(false, None));
    world.command(0, write(7));
    world.run_for(SECOND);
    world.crash(2);
    world.lose_storage(2);
    world.start(2);
    assert!(!keeper::keeper(&world, 2).register.is_up());
    world.run_for(SECOND * 5);
    assert!(keeper::keeper(&world, 2).register.is_up());
    assert_eq!(known(&world, 2), Some(7));
    // Then its storage holds it again.
    (0..3).for_each(|robot| world.crash(robot));
    world.start(2);
    assert_eq!(known(&world, 2), Some(7));
}

#[test]
fn locks_stay_exclusive_when_all_arbiters_crash() {
    for algorithm in locker::ALGORITHMS {
        let mut granted = 0;
        for seed in 0..40 {
            let make = Locker::boxed(algorithm, true);
            let mut stormy =
                Stormy::new(3 + seed as usize % 3, seed, Some(MILLISECOND * 100), make);
            stormy.storms(20);
            stormy.world.run_for(SECOND * 10);
            let crashes: Vec<(Time, u32)> = stormy
                .crashes
                .iter()
                .map(|&(at, _, robot)| (at, robot))
                .collect();
            granted += entries(&stormy.world, &crashes).values().sum::<usize>();
        }
        println!("{algorithm:?}: {granted} entries");
        assert!(granted > 500, "{algorithm:?}: {granted}");
    }
}

#[test]
fn fencing_numbers_grow_though_a_clock_is_an_hour_ahead_and_all_restart() {
    let make = Locker::boxed(Mutex::Lease, false);
    let mut world = World::with_storage(3, 1, Wire::perfect(), Some(MILLISECOND * 100), make);
    world.set_clock_ahead(0, 3_600_000_000_000);
    world.run_for(SECOND * 5);
    for _ in 0..5 {
        world.command(0, release(&["a"]));
        world.command(0, acquire(&["a"]));
        world.run_for(SECOND * 5);
    }
    let first = mutex(&world, 0).fencing();
    assert!(first.is_some());
    (0..3).for_each(|robot| world.crash(robot));
    world.run_for(SECOND);
    world.start(1);
    world.start(2);
    world.run_for(SECOND * 10);
    world.command(1, acquire(&["a"]));
    world.run_for(SECOND * 10);
    assert!(
        mutex(&world, 1).fencing() > first,
        "{:?} {first:?}",
        mutex(&world, 1).fencing()
    );
}

#[test]
fn epochs_grow_though_all_voters_crash_at_once() {
    let mut led = 0;
    for seed in 0..60 {
        let make = Elector::eager(by(Election::Leases));
        let mut stormy = Stormy::new(3 + seed as usize % 3, seed, None, make);
        stormy.storms(20);
        stormy.world.run_for(SECOND * 30);
        let everyone: Vec<usize> = (0..stormy.world.size()).collect();
        // Where datagrams are lost, a leader may just have been lost.
        let mut patience = 5;
        while agreed(&stormy.world, &everyone).is_none() {
            stormy.world.run_for(SECOND);
            patience -= 1;
            assert!(patience > 0, "seed {seed}");
        }
        let crashes: Vec<(usize, u32)> = stormy
            .crashes
            .iter()
            .map(|&(_, records, robot)| (records, robot))
            .collect();
        led += elector::judge(&stormy.world, &crashes).len();
    }
    println!("{led} epochs");
    assert!(led > 200, "{led}");
}

#[test]
fn epochs_grow_though_a_clock_is_an_hour_ahead_and_all_restart() {
    let make = Elector::boxed(by(Election::Leases), None, false, true);
    let mut world = World::with_storage(3, 1, Wire::perfect(), None, make);
    world.set_clock_ahead(0, 3_600_000_000_000);
    world.command(0, elector::ELECT);
    world.run_for(SECOND * 5);
    let first = election(&world, 0).epoch();
    assert!(first.is_some());
    (0..3).for_each(|robot| world.crash(robot));
    world.start(1);
    world.start(2);
    world.command(1, elector::ELECT);
    world.run_for(SECOND * 10);
    let second = election(&world, 1).epoch();
    assert!(second > first, "{second:?} after {first:?}");
}

#[test]
fn voters_with_storage_vote_at_once() {
    let make = Elector::eager(by(Election::Leases));
    let mut world = World::with_storage(3, 1, Wire::perfect(), None, make);
    world.run_for(SECOND / 2);
    let everyone = [0, 1, 2];
    assert!(agreed(&world, &everyone).is_some());
    // A promise of before the restart may bind for a whole lease, and no longer.
    everyone.iter().for_each(|&robot| world.crash(robot));
    everyone.iter().for_each(|&robot| world.start(robot));
    world.run_for(SECOND * 5);
    assert!(agreed(&world, &everyone).is_some());
}
