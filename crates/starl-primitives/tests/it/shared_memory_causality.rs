//! Causal variables: no robot shows a write without those that its writer showed when it wrote.

use crate::harness::sharer::{Sharer, read, read_of, write, write_own};
use crate::harness::{Wire, World, int, robot};
use starl_core::{Duration, Random, Time, Value};
use starl_primitives::shared_memory::Options;
use std::collections::BTreeMap;

const SECOND: Duration = Duration::from_seconds(1);

fn world(robots: usize, seed: u64, wire: Wire, causal: u16) -> World {
    World::new(
        robots,
        seed,
        wire,
        None,
        Sharer::causal(Options::default(), causal),
    )
}

/// Robot 0 writes `x0`, which does not reach robot 2; robot 1 sees it and writes `x1`, which does.
fn broken_chain(causal: u16) -> World {
    let mut world = world(3, 1, Wire::perfect(), causal);
    world.run_for(SECOND * 20);
    world.wire.cut = [(0, 2), (2, 0)].into();
    world.command(0, write(0, 1));
    world.run_for(Duration::from_millis(5));
    assert_eq!(read(&world, 1, 0), Some(1));
    world.command(1, write(1, 2));
    world.run_for(Duration::from_millis(5));
    world
}

#[test]
fn writes_are_held_back_until_their_dependencies_arrive() {
    let eventual = broken_chain(0);
    assert_eq!(read(&eventual, 2, 0), None);
    assert_eq!(read(&eventual, 2, 1), Some(2), "eventual variables are not");
    let mut causal = broken_chain(2);
    assert_eq!(read(&causal, 2, 1), None);
    // Robot 1 has both.
    causal.run_for(SECOND * 10);
    assert_eq!(read(&causal, 2, 0), Some(1));
    assert_eq!(read(&causal, 2, 1), Some(2));
}

#[test]
fn overwritten_writes_do_not_break_the_chain() {
    let mut world = world(4, 1, Wire::perfect(), 3);
    world.run_for(SECOND * 20);
    world.wire.cut = (0..3).flat_map(|r| [(r, 3), (3, r)]).collect();
    world.command(0, write(2, 7));
    world.run_for(Duration::from_millis(5));
    world.command(0, write(0, 1));
    world.run_for(Duration::from_millis(5));
    world.command(0, write(1, 2));
    world.run_for(Duration::from_millis(5));
    // Robot 3 knows of none of these, and its later write wins over that of x0.
    world.run_for(SECOND);
    world.command(3, write(0, 9));
    // Robot 2 passes on x1 alone.
    world.wire.cut = [(0, 3), (1, 3), (3, 0), (3, 1)].into();
    for _ in 0..2000 {
        world.run_for(Duration::from_millis(5));
        let shows_end = read(&world, 3, 1) == Some(2);
        assert!(!shows_end || read(&world, 3, 2) == Some(7));
    }
    assert_eq!(read(&world, 3, 1), Some(2));
}

#[test]
fn elements_of_arrays_depend_on_each_other_too() {
    let mut world = world(2, 1, Wire::perfect(), 2);
    world.run_for(SECOND * 20);
    world.wire.cut = [(0, 1)].into();
    world.command(0, write_own(0, 5));
    world.run_for(Duration::from_millis(5));
    world.wire.cut.clear();
    world.command(0, write_own(1, 6));
    world.run_for(Duration::from_millis(5));
    assert_eq!(read_of(&world, 1, 1, 0), None);
    world.run_for(SECOND * 10);
    assert_eq!(read_of(&world, 1, 0, 0), Some(5));
    assert_eq!(read_of(&world, 1, 1, 0), Some(6));
}

/// The order of writes, and their writers.
type Stamp = (Time, i64, u32);

/// The values that robots show, from their events: an element is its variable and its owner. Crashes
/// leave no event, so they are given.
fn judge(world: &World, crashes: &[(Time, u32)]) -> usize {
    type Element = (String, Option<u32>);
    type Shown = BTreeMap<Element, Stamp>;
    type Fresh = (Time, u32, Element, Shown);
    let mut shown: BTreeMap<u32, Shown> = BTreeMap::new();
    let mut past: BTreeMap<(String, Option<u32>, Stamp), Shown> = BTreeMap::new();
    let mut crashes = crashes.iter().copied().peekable();
    let mut fresh: Vec<Fresh> = Vec::new();
    let mut count = 0;
    let mut events: Vec<_> = ["write", "write_again", "update"]
        .into_iter()
        .flat_map(|name| {
            world
                .events(name)
                .into_iter()
                .map(move |event| (event, name))
        })
        .collect();
    events.sort_by_key(|((at, robot, _), _)| (*at, *robot));
    for ((at, me, fields), name) in events {
        // Updates of one moment are shown together.
        let is_over = fresh
            .first()
            .is_some_and(|first| first.0 < at || first.1 != me.0);
        for (at, me, key, past) in fresh.drain(..if is_over { fresh.len() } else { 0 }) {
            for (element, needed) in past {
                assert!(
                    shown[&me].get(&element) >= Some(&needed),
                    "robot {me} shows {key:?} at {at:?} without {element:?}"
                );
            }
        }
        while let Some((_, crashed)) = crashes.next_if(|(time, _)| *time < at) {
            shown.remove(&crashed);
        }
        let Value::Text(variable) = &fields["variable"] else {
            panic!("no variable");
        };
        let Value::Time(time) = fields["time"] else {
            panic!("no time");
        };
        let stamp = (time, int(&fields["count"]), robot(&fields["writer"]));
        let owner = (fields["single_writer"] == Value::Bool(true)).then_some(stamp.2);
        let own = shown.entry(me.0).or_default();
        let key = (variable.to_string(), owner);
        if name == "update" {
            let past = past[&(key.0.clone(), key.1, stamp)].clone();
            fresh.push((at, me.0, key.clone(), past));
            count += 1;
        } else {
            let mut before = own.clone();
            before.remove(&key);
            past.insert((key.0.clone(), key.1, stamp), before);
        }
        own.insert(key, stamp);
    }
    count
}

#[test]
fn no_write_is_shown_before_its_dependencies() {
    for seed in 0..60 {
        let mut random = Random::keyed(seed, &[9]);
        let mut world = world(4, seed, Wire::bad(), 4);
        let mut crashes = Vec::new();
        for round in 0..200 {
            let who = random.below(4) as usize;
            let variable = random.below(4) as u8;
            let command = match random.chance(0.5) {
                true => write(variable, round),
                false => write_own(variable, round),
            };
            world.command(who, command);
            world.run_for(Duration::from_millis(u64::from(random.below(300))));
            if random.chance(0.05) {
                let side: Vec<bool> = (0..4).map(|_| random.chance(0.5)).collect();
                let pairs = (0..4).flat_map(|a| (0..4).map(move |b| (a, b)));
                let cut = pairs.filter(|&(a, b)| side[a as usize] != side[b as usize]);
                world.wire.cut = cut.collect();
            }
            if random.chance(0.02) {
                world.crash(who);
                crashes.push((world.now, who as u32));
                world.run_for(Duration::from_millis(1));
                world.start(who);
            }
        }
        world.wire.cut.clear();
        // All is written again, so that nothing waits for what is lost.
        for variable in 0..4 {
            world.command(0, write(variable, 1000));
            (0..4).for_each(|who| world.command(who, write_own(variable, 1001)));
        }
        world.run_for(SECOND * 60);
        let shown = judge(&world, &crashes);
        assert!(shown > 100, "seed {seed}: {shown}");
        for who in 0..4 {
            for variable in 0..4 {
                assert_eq!(read(&world, who, variable), Some(1000), "seed {seed}");
                for owner in 0..4 {
                    let element = read_of(&world, who, variable, owner);
                    assert_eq!(element, Some(1001), "seed {seed}");
                }
            }
        }
    }
}

#[test]
fn writes_after_a_corruption_are_shown() {
    for seed in 0..100 {
        let mut world = world(3, seed, Wire::bad(), 3);
        for variable in 0..3 {
            world.command(variable as usize, write(variable, 5));
            world.run_for(SECOND);
        }
        world.run_for(SECOND * 20);
        (0..3).for_each(|robot| world.corrupt(robot));
        world.run_for(SECOND * 30);
        for variable in 0..3 {
            world.command(variable as usize, write(variable, 50));
        }
        world.run_for(SECOND * 60);
        for robot in 0..3 {
            for variable in 0..3 {
                assert_eq!(read(&world, robot, variable), Some(50), "seed {seed}");
            }
        }
    }
}

/// Robots 0 and 1, and 2 and 3, hear each other in one direction only. While all write all the time, a robot can show
/// the writes of the one that it does not hear only with all that a third one shows at one moment.
#[test]
fn writes_reach_robots_that_do_not_hear_the_writer_while_all_write_all_the_time() {
    for seed in 0..10 {
        let mut wire = Wire::perfect();
        wire.loss = 0.3;
        let mut world = world(4, seed, wire, 2);
        world.wire.cut = [(0, 1), (2, 3)].into();
        let mut shown = [[Time::ZERO; 4]; 4];
        for round in 1..600 {
            for writer in 0..4 {
                world.command(writer, write_own(0, round));
                world.command(writer, write_own(1, round));
            }
            world.run_for(Duration::from_millis(100));
            for (reader, shown) in shown.iter_mut().enumerate() {
                for (writer, last) in shown.iter_mut().enumerate() {
                    let old = *last;
                    let value = read_of(&world, reader, 0, writer as u32);
                    let time = Duration::from_millis(100) * value.unwrap_or(0) as u64;
                    *last = old.max(Time::ZERO + time);
                    let lag = world.now.since(*last);
                    assert!(
                        lag < SECOND * 10,
                        "seed {seed}: robot {reader} lags {lag} behind {writer}"
                    );
                }
            }
        }
    }
}
