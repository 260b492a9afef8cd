//! Actions that wait: `pre ... for` and `every`.

use crate::robot_support::{World, compile};
use starl_core::{Event, Random};

/// At which activations an action has fired, counted from 0.
fn firings(world: &World, name: &str) -> Vec<u64> {
    let own = world.records.iter();
    let fired =
        own.filter(|(_, _, event)| matches!(event, Event::Action(action) if action == name));
    fired
        .map(|(at, _, _)| (at.0 + 50_000_000) / 100_000_000)
        .collect()
}

#[test]
fn a_guard_has_to_hold_for_its_time() {
    let code = compile(
        "program Wait

steps: Int = 0
open: Bool = true

count()
    eff steps += 1; open = steps != 4

wait()
    pre open for 300ms
    eff emit(\"waited\")
",
    );
    let mut world = World::of(&code, 1);
    world.steps(15);
    let first = firings(&world, "count")[0];
    let waited = firings(&world, "wait");
    let waited: Vec<u64> = waited.into_iter().map(|at| at - first).collect();
    // The guard is false at activation 3, so the time starts again at 4; it also restarts after each firing.
    assert_eq!(waited, [7, 10, 13]);
}

#[test]
fn an_action_fires_at_most_once_in_its_time() {
    let code = compile(
        "program Repeat

param pause: Duration in 0s..1h = 250ms
steps: Int = 0

count()
    eff steps += 1

show()
    pre steps > 1
    every pause
    eff emit(\"shown\")
",
    );
    let mut world = World::of(&code, 1);
    world.steps(12);
    let first = firings(&world, "count")[0];
    let shown: Vec<u64> = firings(&world, "show")
        .into_iter()
        .map(|at| at - first)
        .collect();
    // Each 250 ms on average, at activations each 100 ms.
    assert_eq!(shown, [1, 4, 6, 9, 11]);
}

#[test]
fn a_time_may_be_a_variable() {
    let code = compile(
        "program Vary

time: Duration = 100ms
fired: Int = 0

wait()
    pre true for time
    eff fired += 1; time = time + 100ms
",
    );
    let mut world = World::of(&code, 1);
    world.steps(16);
    // After 1, 2, 3, 4 and 5 activations.
    assert_eq!(world.int(0, "fired"), 5);
}

#[test]
fn moments_that_a_fault_has_written_block_nothing() {
    let code = compile(
        "program Again

fired: Int = 0

wait()
    pre true for 200ms
    every 300ms
    eff fired = fired % 1000 + 1
",
    );
    for seed in 0..100 {
        let mut world = World::of(&code, 1);
        world.steps(5);
        world.corrupt(0, &mut Random::keyed(seed, &[2]));
        let before = firings(&world, "wait").len();
        world.steps(10);
        assert!(firings(&world, "wait").len() >= before + 2, "seed {seed}");
    }
}
