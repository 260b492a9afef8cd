//! Actions with `atomic`: increments by several robots are counted exactly once, whatever the network does and
//! whichever robot crashes; without `atomic` some are lost.

use crate::robot_support::{self, World, compile};
use starl_core::event::{PrimitiveEvent, RegisterEvent};
use starl_core::{Event, Port, Random};
use starl_lang::machine::Value;
use starl_lang::robot::Code;

/// Each robot adds one to the sum twenty times.
const COUNT: &str = r#"
program Count

allwrite[linearizable] sum: Int = 0
added: Int = 0
seen: Int = 0
blocked: Bool = false

add()
    pre added < 20
    eff
        atomic
            sum += 1
            seen = sum
        added += 1

look()
    eff blocked = atomic_blocked
"#;

/// The same without keeping others out.
const CARELESS: &str = r#"
program Careless

allwrite sum: Int = 0
added: Int = 0
seen: Int = 0

add()
    pre added < 20
    eff
        sum += 1
        added += 1

look()
    eff seen = sum
"#;

fn sum(world: &World, robots: usize, variable: &str) -> i64 {
    (0..robots).map(|robot| world.int(robot, variable)).sum()
}

fn most_seen(world: &World, robots: usize) -> i64 {
    let seen = (0..robots).map(|robot| world.int(robot, "seen"));
    seen.max().expect("there are robots")
}

/// The robot has crashed and starts again.
fn restart(world: &mut World, code: &Code, robot: usize) {
    world.restart(robot, robot_support::program(code));
}

#[test]
fn no_increment_is_lost() {
    let code = compile(COUNT);
    for seed in 0..30 {
        let mut world = World::over_bad_network(&code, 4, seed, 200);
        let mut steps = 0;
        while sum(&world, 4, "added") < 80 {
            world.step();
            steps += 1;
            let (added, seen) = (sum(&world, 4, "added"), most_seen(&world, 4));
            // Values that others have seen may be stored without this being known.
            assert!(added <= seen && seen <= added + 3, "seed {seed}");
            assert!(steps < 10_000, "seed {seed}: {added} were added");
        }
        assert_eq!(most_seen(&world, 4), 80, "seed {seed}");
    }
}

#[test]
fn without_atomic_increments_are_lost() {
    let code = compile(CARELESS);
    let mut world = World::over_bad_network(&code, 4, 1, 200);
    world.steps(600);
    assert_eq!(sum(&world, 4, "added"), 80);
    assert!(most_seen(&world, 4) < 80, "{}", most_seen(&world, 4));
}

#[test]
fn partitions_delay_actions_are_reported_and_lose_nothing() {
    let code = compile(COUNT);
    for seed in 0..20 {
        let mut world = World::over_bad_network(&code, 5, seed, 200);
        let mut random = Random::keyed(seed, &[4]);
        let mut was_blocked = false;
        for _ in 0..12 {
            let side: Vec<bool> = (0..5).map(|_| random.chance(0.5)).collect();
            let pairs = (0..5).flat_map(|a| (0..5).map(move |b| (a, b)));
            let cut = pairs.filter(|&(a, b)| side[a as usize] != side[b as usize]);
            world.wire.cut = cut.collect();
            for _ in 0..80 {
                world.step();
                let (added, seen) = (sum(&world, 5, "added"), most_seen(&world, 5));
                assert!(added <= seen && seen <= added + 4, "seed {seed}");
                was_blocked |= (0..5).any(|r| world.get(r, "blocked") == Value::Bool(true));
            }
            world.wire.cut.clear();
            world.steps(30);
        }
        assert!(was_blocked, "seed {seed}");
        let mut steps = 0;
        while sum(&world, 5, "added") < 100 {
            world.step();
            steps += 1;
            assert!(steps < 10_000, "seed {seed}");
        }
        assert_eq!(most_seen(&world, 5), 100, "seed {seed}");
        world.steps(100);
        assert!((0..5).all(|r| world.get(r, "blocked") == Value::Bool(false)));
    }
}

/// Whether a robot is storing something: what it says of registers ends with an update.
fn is_storing(world: &World, robot: usize) -> bool {
    let events = world
        .events_of(robot as u32)
        .filter_map(|event| match event {
            Event::Primitive {
                event: PrimitiveEvent::Register(event),
                ..
            } if !matches!(event, RegisterEvent::Up { .. }) => Some(event),
            _ => None,
        });
    matches!(
        events.last(),
        Some(RegisterEvent::Update { .. } | RegisterEvent::NoQuorum { .. })
    )
}

#[test]
fn an_increment_before_a_crash_counts_at_most_once() {
    let code = compile(COUNT);
    for seed in 0..60 {
        let mut world = World::over_bad_network(&code, 3, seed, 200);
        let mut random = Random::keyed(seed, &[5]);
        world.steps(40);
        // Added in lives that are over.
        let mut before = 0;
        // How many of these may not have been stored.
        let mut uncertain = 0;
        for _ in 0..10 {
            let robot = random.below(3) as usize;
            before += world.int(robot, "added");
            uncertain += i64::from(is_storing(&world, robot));
            world.crash(robot);
            world.steps(random.below(20));
            restart(&mut world, &code, robot);
            world.steps(60 + random.below(40));
        }
        let mut steps = 0;
        while sum(&world, 3, "added") < 60 {
            world.step();
            steps += 1;
            assert!(steps < 10_000, "seed {seed}");
        }
        let (added, seen) = (before + 60, most_seen(&world, 3));
        let fits = seen >= added && seen <= added + uncertain;
        assert!(
            fits,
            "seed {seed}: {seen} of {added}, {uncertain} uncertain"
        );
    }
}

#[test]
fn after_a_corruption_it_continues() {
    let code = compile(COUNT);
    for seed in 0..40 {
        let mut world = World::of(&code, 3);
        world.random = Random::keyed(seed, &[3]);
        world.steps(30);
        for robot in 0..3 {
            let mut random = Random::keyed(seed, &[6, robot as u64]);
            world.corrupt(robot, &mut random);
        }
        world.steps(600);
        for robot in 0..3 {
            // Whatever the numbers are, those that should be added are; overflow ends a program.
            let is_done = world.failure(robot).is_some() || world.int(robot, "added") >= 20;
            assert!(
                is_done || world.int(robot, "added") < 0,
                "seed {seed}, robot {robot}"
            );
        }
    }
}

/// Several variables that actions use together, in different combinations.
const TRANSFER: &str = r#"
program Transfer

allwrite[linearizable] left: Int = 1000
allwrite[linearizable] right: Int = 0
allwrite[linearizable] other: Int = 0
moved: Int = 0
checked: Int = 0
is_wrong: Bool = false

move()
    pre moved < 20 and left > 0
    eff
        atomic
            left -= 5
            right += 5
        moved += 1

check()
    pre checked < 20
    eff
        atomic
            is_wrong = is_wrong or left + right != 1000
        checked += 1

count()
    pre other < 30
    eff
        atomic
            other += 1
"#;

#[test]
fn writes_of_one_action_are_seen_together_even_if_robots_crash() {
    let code = compile(TRANSFER);
    for seed in 0..20 {
        let mut world = World::over_bad_network(&code, 3, seed, 200);
        let mut random = Random::keyed(seed, &[5]);
        world.steps(40);
        for _ in 0..6 {
            let robot = random.below(3) as usize;
            world.crash(robot);
            world.steps(random.below(20));
            restart(&mut world, &code, robot);
            world.steps(60 + random.below(40));
        }
        let mut steps = 0;
        while sum(&world, 3, "checked") < 60 || sum(&world, 3, "moved") < 60 {
            world.step();
            steps += 1;
            assert!(steps < 20_000, "seed {seed}");
        }
        for robot in 0..3 {
            assert_eq!(
                world.get(robot, "is_wrong"),
                Value::Bool(false),
                "seed {seed}"
            );
        }
    }
}

#[test]
fn an_action_waits_no_longer_when_its_guard_holds_no_longer() {
    let source = "program Patient\nallwrite[linearizable] sum: Int = 0\nwants: Bool = true\n\
                  gave_up: Bool = false\nadd()\n    pre wants\n    eff\n        atomic\n            \
                  sum += 1\n        wants = false\ngive_up()\n    pre wants and atomic_blocked\n    \
                  eff wants = false; gave_up = true\n";
    let mut world = World::of(&compile(source), 3);
    world.steps(30);
    assert_eq!(world.get(0, "gave_up"), Value::Bool(false));
    let mut world = World::of(&compile(source), 3);
    world.wire.isolate(0, 3);
    world.steps(200);
    assert_eq!(world.get(0, "gave_up"), Value::Bool(true));
    world.wire.cut.clear();
    world.steps(200);
    assert_eq!(world.get(1, "wants"), Value::Bool(false));
    assert!((0..3).all(|robot| world.failure(robot).is_none()));
}

#[test]
fn an_action_has_its_documented_cost() {
    let source = COUNT.replace("pre added < 20", "pre added < 20 and peers.min() == me");
    for robots in [3, 5] {
        let mut world = World::of(&compile(&source), robots);
        while world.int(0, "added") < 20 {
            let before = (world.int(0, "added"), world.records.len());
            world.step();
            let ports = ["Count/atomic", "Count/linearizable"].map(Port::named);
            let sent = world.records[before.1..].iter();
            let is_it =
                |event: &Event| matches!(event, Event::Sent { port, .. } if ports.contains(port));
            let sent = sent.filter(|(_, _, event)| is_it(event)).count();
            if before.0 > 0 {
                // The action is done within one step. Copies may be compared besides.
                assert_eq!(world.int(0, "added"), before.0 + 1);
                let count = 3 * robots as usize + 1;
                assert!(
                    (count..=count + 4).contains(&sent),
                    "{robots} robots: {sent}"
                );
            }
        }
    }
}
