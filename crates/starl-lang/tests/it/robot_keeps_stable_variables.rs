//! Stable variables: what a robot with storage remembers over a crash, and a robot without storage forgets.

use crate::robot_support::{World, compile, program};
use starl_core::effect::Effects;
use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{
    Agent, Effect, Estimate, Input, Payload, Port, Random, RobotId, Save, Saved, Sensors, Time,
    View,
};
use starl_host::Store;
use starl_lang::machine::Value;
use std::sync::Arc;

const COUNTER: &str = r"
program Counter

stable count: Int = 100
twice: Int = 2 * count
plain: Int = 0

tick()
    pre plain < 3
    eff count += 1; plain += 1
";

/// The storage of the only robot.
fn saved(world: &World) -> Saved {
    let store = world.robots[0].store.as_ref();
    Saved::clone(&store.map(Store::saved).unwrap_or_default())
}

fn crash_and_restart(world: &mut World, source: &str) {
    world.crash(0);
    let fresh = program(&compile(source));
    world.restart(0, fresh);
}

fn numbers(world: &World) -> [i64; 3] {
    ["count", "twice", "plain"].map(|name| world.int(0, name))
}

#[test]
fn a_stable_variable_survives_a_crash_and_a_plain_one_does_not() {
    let mut world = World::on_storage(&compile(COUNTER), Saved::default());
    assert_eq!(numbers(&world), [100, 200, 0]);
    world.steps(5);
    assert_eq!(numbers(&world), [103, 200, 3]);
    crash_and_restart(&mut world, COUNTER);
    // The variables below it are worked out from the saved value.
    assert_eq!(numbers(&world), [103, 206, 0]);
    world.steps(5);
    crash_and_restart(&mut world, COUNTER);
    assert_eq!(numbers(&world), [106, 212, 0]);
}

#[test]
fn without_storage_neither_survives() {
    let mut world = World::of(&compile(COUNTER), 1);
    world.steps(5);
    assert_eq!(numbers(&world), [103, 200, 3]);
    crash_and_restart(&mut world, COUNTER);
    assert_eq!(numbers(&world), [100, 200, 0]);
}

#[test]
fn without_storage_it_has_no_effect() {
    let mut plain = World::of(&compile(&COUNTER.replace("stable ", "")), 1);
    let mut stable = World::of(&compile(COUNTER), 1);
    for world in [&mut plain, &mut stable] {
        world.steps(5);
        world.crash(0);
    }
    assert_eq!(plain.records, stable.records);
    assert_eq!(plain.program(0).state(), stable.program(0).state());
}

#[test]
fn an_assignment_in_init_takes_the_place_of_the_saved_value() {
    let source = &format!("{COUNTER}\ninit\n    count = min(count, 101)\n");
    let mut world = World::on_storage(&compile(source), Saved::default());
    world.steps(5);
    crash_and_restart(&mut world, source);
    assert_eq!(numbers(&world), [101, 206, 0]);
}

#[test]
fn a_crash_before_the_write_undoes_the_change_and_its_effects() {
    let source = &format!("{COUNTER}\ntell()\n    eff emit(\"told\", count = count)\n");
    let mut world = World::on_storage(&compile(source), Saved::default());
    world.step();
    assert_eq!(world.int(0, "count"), 101);
    let told = world.emitted(0).len();
    world.input(0, &Input::Activate);
    assert_eq!(world.int(0, "count"), 102);
    assert_eq!(world.emitted(0).len(), told);
    crash_and_restart(&mut world, source);
    assert_eq!(world.int(0, "count"), 101);
}

const EVERYTHING: &str = r"
program Everything

enum Color {red, green, blue}
record Pair {color: Color, name: String?}

stable flag: Bool
stable count: Int
stable number: Float
stable name: String
stable place: Point
stable moment: Time
stable span: Duration
stable robot: RobotId = me
stable color: Color
stable loc: enum {init, pick} = init
stable maybe: Float?
stable somewhere: Point?
stable pair: Pair
stable nested: List[List[List[Int]]]
stable pairs: List[Pair]
stable table: Map[Color, Set[Int]]
stable points: Set[Point]
stable names: Map[String, Pair?]
stable region: Area = circle(Point(0.0, 0.0), 1.0)
stable stones: Obstacles = obstacles()
";

#[test]
fn values_of_all_types_survive() {
    let code = compile(EVERYTHING);
    let mut changed = 0;
    for seed in 0..50 {
        let mut world = World::on_storage(&code, Saved::default());
        let first = world.program(0).state().clone();
        world.corrupt(0, &mut Random::keyed(seed, &[]));
        world.step();
        let before = world.program(0).state().clone();
        changed += u32::from(before != first);
        world.crash(0);
        world.restart(0, program(&code));
        assert_eq!(world.failure(0), None);
        assert_eq!(*world.program(0).state(), before, "seed {seed}");
    }
    assert_eq!(changed, 50);
}

#[test]
fn a_saved_value_of_another_type_is_ignored_and_replaced() {
    let begins = |declaration: &str| format!("program Other\n\nstable {declaration}\n");
    let cases = [
        ("x: Int = 7", "x: Duration = 3s", "3s"),
        ("x: Int = 7", "x: Float = 2.5", "2.5"),
        ("x: Int = 7", "x: Int? = 4", "4"),
        ("x: enum {a, b} = b", "x: enum {b, a} = b", "b"),
        ("x: List[Int] = [1, 2]", "x: Set[Int] = {3}", "{3}"),
        ("x: Int = 7", "y: Int = 8", "8"),
    ];
    for (old, new, expected) in cases {
        let mut world = World::on_storage(&compile(&begins(old)), Saved::default());
        world.step();
        crash_and_restart(&mut world, &begins(new));
        let name = &new[..1];
        assert_eq!(world.get(0, name).to_string(), expected, "{old} to {new}");
        world.step();
        // The new value is in storage, so the old type finds none of its own.
        crash_and_restart(&mut world, &begins(new));
        assert_eq!(world.get(0, name).to_string(), expected);
    }
}

#[test]
fn damaged_bytes_are_ignored() {
    let code = compile(COUNTER);
    let mut world = World::on_storage(&code, Saved::default());
    world.steps(5);
    let whole = saved(&world);
    let (_, bytes) = whole.of(Port::PROGRAM).next().expect("a saved value");
    let restarted = |bytes: &[u8]| {
        let mut saved = Saved::default();
        saved.apply(Save {
            port: Port::PROGRAM,
            key: "count".into(),
            value: Some(bytes.into()),
        });
        World::on_storage(&code, saved).int(0, "count")
    };
    assert_eq!(restarted(bytes), 103);
    for length in 0..bytes.len() {
        assert_eq!(restarted(&bytes[..length]), 100);
    }
    assert_eq!(restarted(&[bytes, &[0]].concat()), 100);
    assert_eq!(restarted(&[&[0; 4], &bytes[4..]].concat()), 100);
}

/// The robot's software takes an input; gives the keys and values that it saves.
fn saves(agent: &mut Agent, input: &Input) -> Vec<(String, Option<Payload>)> {
    let obstacles: Obstacles = [].into();
    let view = View {
        id: RobotId(0),
        now: Time::ZERO,
        estimate: Estimate::default(),
        body: Body {
            radius: 0.1,
            height: 0.2,
            workspace: Workspace::Ground,
        },
        sensors: Sensors::default(),
        fleet: &[RobotId(0)],
        way_points: &[],
        obstacles: &obstacles,
    };
    let mut effects = Effects::default();
    agent.handle(input, &view, &mut effects);
    let saves = effects.list.into_iter().filter_map(|effect| match effect {
        Effect::Save(save) => Some((save.key.to_string(), save.value)),
        _ => None,
    });
    saves.collect()
}

fn started(source: &str, saved: Option<Saved>) -> (Agent, Vec<(String, Option<Payload>)>) {
    let program = Box::new(program(&compile(source)));
    let agent = Agent::new(program, Random::keyed(1, &[]));
    let mut agent = agent.with_saved(saved.map(Arc::new));
    let first = saves(&mut agent, &Input::Start);
    (agent, first)
}

#[test]
fn a_variable_is_saved_when_it_has_changed_and_not_otherwise() {
    let source = r"
program Two

stable often: Int = 0
stable once: Bool = false
plain: Int = 0

tick()
    pre plain < 6
    eff plain += 1; often = plain / 2; once = true
";
    let (mut agent, first) = started(source, Some(Saved::default()));
    let mut saved = Saved::default();
    let mut keys = Vec::new();
    let mut note = |saves: Vec<(String, Option<Payload>)>| {
        keys.push(
            saves
                .iter()
                .map(|(key, _)| key.clone())
                .collect::<Vec<_>>()
                .join(" "),
        );
        for (key, value) in saves {
            let (port, key) = (Port::PROGRAM, key.into());
            saved.apply(Save { port, key, value });
        }
    };
    note(first);
    for _ in 0..8 {
        note(saves(&mut agent, &Input::Activate));
    }
    let expected = [
        "often once",
        "once",
        "often",
        "",
        "often",
        "",
        "often",
        "",
        "",
    ];
    assert_eq!(keys, expected);
    // Values that are already in storage are not saved again.
    let (mut agent, again) = started(source, Some(saved));
    assert_eq!(again, []);
    let [first, second] = [(); 2].map(|()| saves(&mut agent, &Input::Activate));
    assert_eq!(first.len(), 1, "`often` goes back to 0");
    assert_eq!(second.len(), 1, "`often` is 1");
}

#[test]
fn nothing_is_saved_without_storage() {
    let (mut agent, first) = started(COUNTER, None);
    assert_eq!(first, []);
    assert_eq!(saves(&mut agent, &Input::Activate), []);
}

#[test]
fn a_start_that_fails_leaves_storage_alone() {
    let mut world = World::on_storage(&compile(COUNTER), Saved::default());
    world.steps(5);
    let before = saved(&world);
    let above = COUNTER.replace("stable", "zero: Int = 1 / (peers.size() - 1)\nstable");
    crash_and_restart(&mut world, &above);
    assert!(world.failure(0).is_some());
    world.steps(2);
    assert_eq!(saved(&world), before);
}

#[test]
fn a_run_time_error_keeps_earlier_changes() {
    let source =
        &format!("{COUNTER}\ncrash()\n    pre plain == 2\n    eff plain = 1 / (plain - 2)\n");
    let mut world = World::on_storage(&compile(source), Saved::default());
    world.steps(5);
    assert!(world.failure(0).is_some());
    crash_and_restart(&mut world, source);
    assert_eq!(world.int(0, "count"), 102);
}

#[test]
fn overwritten_memory_is_saved_like_any_other_change() {
    let mut world = World::on_storage(&compile(COUNTER), Saved::default());
    world.corrupt(0, &mut Random::keyed(3, &[]));
    let count = world.get(0, "count");
    assert_ne!(count, Value::Int(100));
    let late = COUNTER.replace("plain < 3", "false");
    world.input(0, &Input::Estimate);
    world.run_for(starl_core::Duration::from_millis(2));
    crash_and_restart(&mut world, &late);
    assert_eq!(world.get(0, "count"), count);
}

#[test]
fn two_robots_differ_if_they_would_save_something_else() {
    let text = |saved: Option<Saved>| {
        let program = Box::new(program(&compile(COUNTER)));
        let agent = Agent::new(program, Random::keyed(1, &[]));
        let mut agent = agent.with_saved(saved.map(Arc::new));
        saves(&mut agent, &Input::Start);
        let mut text = String::new();
        assert!(agent.write_state(&mut text));
        text
    };
    assert_eq!(text(None), text(None));
    assert_ne!(text(None), text(Some(Saved::default())));
}

#[test]
fn a_stable_tuple_survives_a_crash() {
    let source = "
program Pairs

stable best: (Int, (String, RobotId?)) = (0, (\"\", none))

tick()
    pre best.0 < 3
    eff best.0 += 1; best.1 = (\"at \" + String(best.0), me)
";
    let mut world = World::on_storage(&compile(source), Saved::default());
    world.steps(5);
    crash_and_restart(&mut world, source);
    let best = world.get(0, "best").to_string();
    assert_eq!(best, "(3, (\"at 3\", robot0))");
}
