//! The state machines of programs, as the thesis's figures show them.

use crate::common;
use starl_editor::explain::{Refusal, StateMachine, Target};
use starl_lang::check::{NoLibraries, check};

/// The state machine of a program without errors.
fn machine(text: &str, variable: Option<&str>) -> Result<StateMachine, Refusal> {
    let checked = check(text, &NoLibraries);
    let program = checked.correct().expect("the program has no errors");
    StateMachine::of(program, variable)
}

/// The edges, as `from -> to: cause`.
fn edges(machine: &StateMachine) -> Vec<String> {
    let name = |target| match target {
        Target::State(number) => machine.states[number].name.as_str(),
        Target::Unknown => "?",
        Target::End => "end",
    };
    let edges = machine.edges.iter();
    edges
        .map(|edge| {
            let from = &machine.states[edge.from].name;
            format!("{from} -> {}: {}", name(edge.to), edge.cause)
        })
        .collect()
}

fn initial(machine: &StateMachine) -> Vec<&str> {
    let states = machine.states.iter().filter(|state| state.is_initial);
    states.map(|state| state.name.as_str()).collect()
}

pub fn listing(name: &str) -> &'static str {
    let mut all = common::LISTINGS.iter();
    let (_, text) = all.find(|(own, _)| *own == name).expect("it is there");
    text
}

#[test]
fn race_goes_round_as_in_figure_2_1() {
    let machine = machine(listing("race"), None).expect("it has states");
    assert_eq!(machine.variable, "loc");
    assert_eq!(initial(&machine), ["init"]);
    // The target was given up by ReachAvoid: `pick` fires in `wait` too, and stays there.
    let expected = [
        "init -> pick: initialize",
        "init -> pick: on Reached",
        "pick -> wait: pick",
        "wait -> pick: wait",
        "wait -> pick: on Reached",
        "wait -> wait: pick",
    ];
    assert_eq!(edges(&machine), expected);
}

#[test]
fn the_intersection_is_crossed_in_one_way_as_in_figure_5_2() {
    let machine = machine(listing("intersection"), None).expect("it has states");
    let expected = [
        "register -> reg_wait: start",
        "reg_wait -> mux_wait: do_mutex",
        "mux_wait -> mov_wait: od_mutex",
        "mov_wait -> mov_wait: release",
        "mov_wait -> s1: done",
    ];
    assert_eq!(edges(&machine), expected);
    let not_left: Vec<&str> = (machine.states.iter().filter(|state| !state.is_left))
        .map(|state| state.name.as_str())
        .collect();
    assert_eq!(not_left, ["s1"]);
}

#[test]
fn formation_waits_in_rounds_as_in_figure_5_5() {
    let machine = machine(listing("formation"), None).expect("it has states");
    let expected = [
        "init -> calc: initialize",
        "init -> wait: update",
        "calc -> wait: update",
        "wait -> calc: wait",
        "wait -> wait: update",
        "wait -> wait: wait",
    ];
    assert_eq!(edges(&machine), expected);
}

#[test]
fn a_program_without_states_is_refused() {
    let refused = machine("program Plain\n\nn: Int = 0\n", None);
    assert_eq!(refused, Err(Refusal::NoControlVariable));
    let refused = machine("library own\n", None);
    assert_eq!(refused, Err(Refusal::Library));
    let refused = machine(listing("race"), Some("target"));
    let expected = Refusal::UnknownVariable {
        name: "target".into(),
        others: vec!["loc".into()],
    };
    assert_eq!(refused, Err(expected));
}
