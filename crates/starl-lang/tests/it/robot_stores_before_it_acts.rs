//! An action with `atomic` takes place after its writes are stored, exactly as computed. Until then nothing that it
//! depends on changes, while unrelated actions continue. Robots that crash do not block others.

use crate::robot_support::{self, PERIOD, World, compile};
use starl_core::event::{MutexEvent, PrimitiveEvent};
use starl_core::{Duration, Event, Random};
use starl_host::Clock;
use starl_lang::machine::Value;

/// Robot 0 moves what it has to what all share, and gets more all the time by an action and by messages.
const DEPOSIT: &str = r#"
program Deposit

message More(amount: Int)

allwrite[linearizable] total: Int = 0
radio = Unicast()
mine: Int = 5
got: Int = 5
given: Int = 0
drawn: Float = 0.0
place: Point = position
ticks: Int = 0
told: Int = 0

deposit()
    pre me == peers.min() and mine > 0
    eff
        atomic
            total += mine
            given += mine
        mine = 0
        drawn = random(0.0, 1.0)
        place = position
        emit("deposited", given = given)

grow()
    pre me == peers.min()
    eff mine += 1; got += 1

tick()
    eff ticks += 1

send()
    pre me != peers.min() and told < 50
    eff radio.send(peers.min()!, More(3)); told += 1

on More(_, amount)
    mine += amount
    got += amount
"#;

#[test]
fn the_dependencies_of_an_action_do_not_change_until_it_takes_place() {
    let code = compile(DEPOSIT);
    for seed in 0..30 {
        let mut world = World::over_bad_network(&code, 3, seed, 300);
        for _ in 0..300 {
            let ticks = world.int(0, "ticks");
            world.step();
            assert_eq!(world.int(0, "ticks"), ticks + 1, "other actions go on");
            let (mine, given) = (world.int(0, "mine"), world.int(0, "given"));
            assert_eq!(mine + given, world.int(0, "got"), "seed {seed}");
        }
        assert!(world.int(0, "given") > 200, "seed {seed}");
        // Each message was handled once, though many came while an action was being stored.
        let told: i64 = (1..3).map(|robot| world.int(robot, "told")).sum();
        assert_eq!(told, 100);
        assert!(world.int(0, "got") >= 5 + 3 * told, "seed {seed}");
    }
}

#[test]
fn an_action_that_cannot_be_stored_has_not_happened() {
    let code = compile(DEPOSIT);
    let mut world = World::of(&code, 3);
    world.steps(60);
    let given = world.int(0, "given");
    assert!(given > 0);
    // Its questions come to the others, and their answers get lost.
    world.wire.cut = [(1, 0), (2, 0)].into();
    world.steps(100);
    assert!(world.int(0, "given") <= given + 20, "nothing is given then");
    let given = world.int(0, "given");
    let deposits = world.emitted(0).len();
    world.steps(50);
    assert_eq!(world.int(0, "given"), given);
    assert_eq!(world.emitted(0).len(), deposits, "it says so when it has");
    world.wire.cut.clear();
    world.steps(100);
    assert!(world.int(0, "given") > given);
}

/// Each robot adds one to the sum again and again.
const COUNT: &str = r#"
program Count

allwrite[linearizable] sum: Int = 0
added: Int = 0
seen: Int = 0

add()
    eff
        atomic
            sum += 1
            seen = sum
        added += 1
"#;

/// Whether a robot holds the lock now, by what it says.
fn holds(world: &World, robot: u32) -> bool {
    let last = world.events_of(robot).filter_map(|event| match event {
        Event::Primitive {
            event: PrimitiveEvent::Mutex(event),
            ..
        } => Some(event),
        _ => None,
    });
    matches!(last.last(), Some(MutexEvent::Enter { .. }))
}

#[test]
fn a_crash_with_the_lock_does_not_block_others_for_long() {
    let code = compile(COUNT);
    let mut longest = Duration::ZERO;
    for seed in 0..60 {
        let mut world = World::of(&code, 4);
        world.random = Random::keyed(seed, &[3]);
        world.wire.delay_ms = (5, 40);
        world.steps(40 + seed as u32 % 10);
        let mut millisecond = world.now;
        while !holds(&world, 0) {
            millisecond += Duration::from_millis(1);
            if millisecond.0.is_multiple_of(PERIOD.0) {
                world.step();
            } else {
                world.run_before(millisecond);
            }
        }
        world.crash(0);
        let (died, before) = (world.now, world.int(1, "added") + world.int(2, "added"));
        while world.int(1, "added") + world.int(2, "added") < before + 2 {
            world.step();
            let waited = world.now.since(died);
            assert!(waited < Duration::from_seconds(4), "seed {seed}");
        }
        longest = longest.max(world.now.since(died));
    }
    println!("at most {longest:?} until two others have had their turn");
}

/// How many events of registers had this name.
fn told(world: &World, wanted: &str) -> usize {
    let records = world.records.iter();
    let is_it = |event: &Event| match event {
        Event::Primitive {
            event: PrimitiveEvent::Register(event),
            ..
        } => event.name() == wanted,
        _ => false,
    };
    records.filter(|(_, _, event)| is_it(event)).count()
}

#[test]
fn clocks_that_run_wrong_leases_that_overlap_crashes_and_partitions_lose_no_count() {
    let code = compile(COUNT);
    let (mut lost, mut counted) = (0, 0);
    for seed in 0..30 {
        let mut world = World::over_bad_network(&code, 4, seed, 300);
        let mut random = Random::keyed(seed, &[4]);
        // Far beyond the bound that leases count on, so that a holder believes in them too long.
        for unit in &mut world.robots {
            let rate = 1.0 + random.between(-0.7, 2.0);
            unit.node.set_clock(Clock { offset: 0, rate });
        }
        let (mut before, mut uncertain) = (0, 0);
        for _ in 0..8 {
            let side: Vec<bool> = (0..4).map(|_| random.chance(0.5)).collect();
            let pairs = (0..4).flat_map(|a| (0..4).map(move |b| (a, b)));
            let cut = pairs.filter(|&(a, b)| side[a as usize] != side[b as usize]);
            world.wire.cut = cut.collect();
            world.steps(20 + random.below(60));
            world.wire.cut.clear();
            world.steps(20 + random.below(60));
            let robot = random.below(4) as usize;
            (before, uncertain) = (before + world.int(robot, "added"), uncertain + 1);
            world.crash(robot);
            world.steps(random.below(40));
            world.restart(robot, robot_support::program(&code));
            world.steps(100);
        }
        world.steps(200);
        let added = (0..4).map(|robot| world.int(robot, "added"));
        let added = before + added.sum::<i64>();
        let seen = (0..4).map(|robot| world.int(robot, "seen")).max();
        let seen = seen.expect("there are robots");
        // Those that were storing something when they crashed, or do now.
        let fits = seen >= added && seen <= added + uncertain + 4;
        assert!(fits, "seed {seed}: {seen} of {added}");
        lost += told(&world, "lost");
        counted += added;
    }
    println!("{counted} counted, {lost} tried anew");
    assert!(
        counted > 1000 && lost > 20,
        "{counted} counted, {lost} lost"
    );
}

#[test]
fn two_crashed_robots_of_five_do_not_block_the_others() {
    let code = compile(COUNT);
    for seed in 0..20 {
        let mut world = World::over_bad_network(&code, 5, seed, 300);
        let mut random = Random::keyed(seed, &[4]);
        // All robots have joined by now; values that only robots remember which crash earlier would be lost.
        world.steps(60);
        for _ in 0..2 {
            world.steps(20 + random.below(20));
            let dead = random.below(5) as usize;
            world.crash(dead);
        }
        world.steps(60);
        let alive: Vec<usize> = (0..5)
            .filter(|&robot| !world.robots[robot].node.condition().down)
            .collect();
        let added = |world: &World| -> Vec<i64> {
            let alive = alive.iter();
            alive.map(|&robot| world.int(robot, "added")).collect()
        };
        let before = added(&world);
        world.steps(400);
        for (before, after) in before.iter().zip(added(&world)) {
            assert!(after > *before, "seed {seed}: {before} to {after}");
        }
        let failed = (0..5).find_map(|robot| world.failure(robot));
        assert_eq!(failed, None);
    }
}

#[test]
fn an_action_that_fails_writes_nothing() {
    let source = "program Wrong\nallwrite[linearizable] sum: Int = 1\nseen: Int = 0\nadd()\n    pre me == \
                  peers.min()\n    eff\n        atomic\n            sum += 1\n            sum = sum / (sum \
                  - 2)\nlook()\n    pre me != peers.min() and seen == 0\n    eff\n        atomic\n            \
                  seen = sum\n";
    let mut world = World::of(&compile(source), 3);
    world.steps(60);
    let failed = world.failure(0);
    assert!(failed.is_some_and(|text| text.contains("division by zero")));
    assert_eq!(world.get(1, "seen"), Value::Int(1));
}
