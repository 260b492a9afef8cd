//! A robot's program is its state: it can be copied, compared, digested, stored and continued at any time, and it is
//! small.

use crate::machine_support::{self, RACE, TestHost, program};
use starl_core::{Digest, Point, message};
use starl_lang::machine::{Limits, List, Machine, Object, Program, State, Workspace};

fn digest(state: &State) -> u64 {
    let mut digest = Digest::default();
    state.digest(&mut digest);
    digest.value()
}

/// Runs the second half of an activation; gives the fuel that is left.
fn go_on(program: &Program, state: &mut State) -> (u64, Vec<String>) {
    let mut host = TestHost::default();
    let mut workspace = Workspace::new();
    let limits = Limits::default();
    let mut machine = Machine::new(program, state, &mut workspace, &mut host, limits);
    for action in [1, 2, 1, 2, 1] {
        machine.action(action).expect("no error");
    }
    (machine.fuel(), host.calls)
}

fn half_way(program: &Program) -> State {
    let mut state = program.new_state();
    let mut workspace = Workspace::new();
    let mut host = TestHost::default();
    let limits = Limits::default();
    let mut machine = Machine::new(program, &mut state, &mut workspace, &mut host, limits);
    machine.start().expect("no error");
    machine.action(0).expect("no error");
    state
}

#[test]
fn copies_continue_alike_stored_or_not() {
    let program = program(RACE);
    let mut original = half_way(&program);
    let mut copy = original.clone();
    let mut stored: State = message::decode(&message::encode(&original)).expect("it was stored");
    for other in [&copy, &stored] {
        assert_eq!(*other, original);
        assert_eq!(digest(other), digest(&original));
    }
    let expected = go_on(&program, &mut original);
    assert_eq!(expected.1.len(), 4);
    assert_ne!(copy, original, "the copy stays as it was");
    assert_ne!(digest(&copy), digest(&original));
    assert_eq!(go_on(&program, &mut copy), expected);
    assert_eq!(go_on(&program, &mut stored), expected);
    assert_eq!(copy, original);
    assert_eq!(digest(&stored), digest(&original));
}

#[test]
fn fuel_does_not_depend_on_other_holders_of_a_value() {
    let program = program(
        "type List[Int]\n variable list type0\n\
         function f procedure () () registers 2 objects 0\n\
         int r0 5\n list_add s0 r0 b0 type0\n list_add s0 r0 b0 type0\n\
         int r1 0\n list_set s0 r1 r0 b0\n return #0 #0",
    );
    let run = |state: &mut State| {
        let (mut workspace, mut host) = (Workspace::new(), TestHost::default());
        let limits = Limits::default();
        let mut machine = Machine::new(&program, state, &mut workspace, &mut host, limits);
        machine.call(0, &[], &[]).expect("no error");
        machine.fuel()
    };
    let mut state = program.new_state();
    state.objects[0] = machine_support::ints(&[1; 1000]);
    let mut alone: State = message::decode(&message::encode(&state)).expect("it was stored");
    let snapshot = state.clone();
    assert_eq!(run(&mut state), run(&mut alone));
    assert_eq!(state, alone);
    assert_eq!(
        snapshot.objects[0].size(),
        1000,
        "a snapshot does not change"
    );
}

#[test]
fn all_empty_values_are_equal() {
    let emptied = {
        let mut list = List::of_scalars(vec![1]);
        list.remove(0);
        Object::from(list)
    };
    assert_eq!(emptied, Object::EMPTY);
    assert_eq!(Object::from(""), Object::EMPTY);
    let state = |object: &Object| State {
        scalars: [].into(),
        objects: [object.clone()].into(),
    };
    assert_eq!(digest(&state(&emptied)), digest(&state(&Object::EMPTY)));
    assert_ne!(digest(&state(&"x".into())), digest(&state(&Object::EMPTY)));
}

#[test]
fn race_takes_less_than_a_kibibyte_a_robot() {
    let program = program(RACE);
    let mut state = half_way(&program);
    assert!(state.bytes() < 256, "{} bytes", state.bytes());
    // The 20 waypoints of a long race.
    state.objects[0] = List::of_points(&[Point::ZERO; 20]).into();
    assert!(state.bytes() < 1024, "{} bytes", state.bytes());
}

#[test]
fn robots_may_run_on_any_thread() {
    fn anywhere<T: Send + Sync>() {}
    anywhere::<Program>();
    anywhere::<State>();
    anywhere::<Workspace>();
}
