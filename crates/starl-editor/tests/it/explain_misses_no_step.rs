//! A state machine has every step that robots take: each fired action has an edge, and each robot is in the state at
//! the end of an edge.

use std::collections::BTreeSet;

use crate::common::{generator, mutation, written};
use crate::explain_listings::listing;
use crate::robot_support::{World, compile};
use starl_editor::explain::{StateMachine, Target};
use starl_lang::check::{NoLibraries, check};
use starl_lang::machine::Value;

fn machine(source: &str) -> StateMachine {
    let checked = check(source, &NoLibraries);
    StateMachine::of(&checked.program, None).expect("it has states")
}

/// The state that a robot is in.
fn state(machine: &StateMachine, world: &World, robot: usize) -> usize {
    let Value::Variant(name) = world.get(robot, &machine.variable) else {
        panic!("{} is no enum", machine.variable);
    };
    let mut states = machine.states.iter();
    states
        .position(|state| state.name == name)
        .expect("a state")
}

/// With the states to which handlers lead from these.
fn handled(machine: &StateMachine, mut states: BTreeSet<usize>) -> BTreeSet<usize> {
    loop {
        let edges = machine.edges.iter().filter(|edge| edge.cause.is_handler);
        let edges = edges.filter(|edge| states.contains(&edge.from));
        let new: Vec<usize> = edges
            .filter_map(|edge| match edge.to {
                Target::State(next) if !states.contains(&next) => Some(next),
                _ => None,
            })
            .collect();
        if new.is_empty() {
            return states;
        }
        states.extend(new);
    }
}

/// Where an action may lead from these states.
fn fired(machine: &StateMachine, states: &BTreeSet<usize>, action: &str) -> BTreeSet<usize> {
    let edges = machine.edges.iter();
    let own = edges.filter(|edge| !edge.cause.is_handler && edge.cause.name == action);
    own.filter(|edge| states.contains(&edge.from))
        .map(|edge| match edge.to {
            Target::State(next) => next,
            Target::Unknown | Target::End => edge.from,
        })
        .collect()
}

/// Holds a run to the state machine, and gives the actions that were done.
fn follow(source: &str, mut world: World, steps: u32) -> BTreeSet<String> {
    let machine = machine(source);
    let robots = world.robots.len();
    let mut all = BTreeSet::new();
    for _ in 0..steps {
        let before: Vec<usize> = (0..robots).map(|it| state(&machine, &world, it)).collect();
        let done: Vec<usize> = (0..robots)
            .map(|it| world.actions(it as u32).len())
            .collect();
        world.step();
        for robot in 0..robots {
            let mut may_be = handled(&machine, BTreeSet::from([before[robot]]));
            for action in &world.actions(robot as u32)[done[robot]..] {
                all.insert(action.clone());
                may_be = handled(&machine, fired(&machine, &may_be, action));
                assert!(
                    !may_be.is_empty(),
                    "robot {robot} does {action}, which has no edge"
                );
            }
            let now = state(&machine, &world, robot);
            assert!(
                may_be.contains(&now),
                "robot {robot} is in {now}, not in {may_be:?}"
            );
        }
    }
    all
}

#[test]
fn of_race() {
    let source = listing("race");
    let places = [(1.0, 0.0), (2.0, 1.0), (0.0, 3.0)];
    let world = World::of(&compile(source), 3).with_way_points(&places);
    let all = follow(source, world, 20);
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    assert_eq!(all, ["initialize", "pick", "wait"]);
}

#[test]
fn of_formation() {
    let source = listing("formation");
    let mut world = World::of(&compile(source), 3);
    for (robot, x) in [(0, 0.0), (1, 2.0), (2, 1.0)] {
        world.put(robot, starl_core::Point::planar(x, 0.3 * x));
    }
    let all = follow(source, world, 60);
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    assert_eq!(all, ["initialize", "update", "wait"]);
}

#[test]
fn any_text_can_be_drawn_or_is_refused() {
    let mut drawn = 0;
    let mut draw = |text: &str| {
        let program = check(text, &NoLibraries).program;
        let Ok(machine) = StateMachine::of(&program, None) else {
            return;
        };
        for edge in &machine.edges {
            assert!(machine.states[edge.from].is_reached);
            if let Target::State(number) = edge.to {
                assert!(machine.states[number].is_reached);
            }
        }
        assert!(machine.mermaid().ends_with('\n') && machine.dot().ends_with("}\n"));
        drawn += 1;
    };
    for (_, text) in written() {
        for seed in 0..100 {
            draw(&mutation::mutated(text, seed));
        }
    }
    for seed in 0..100 {
        draw(&generator::program(seed));
    }
    assert!(drawn > 100, "{drawn}");
}
