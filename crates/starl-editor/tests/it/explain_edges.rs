//! Which steps a state machine has: those that the guard and the ways through the effect allow.

use starl_editor::explain::{StateMachine, Target};
use starl_lang::check::{NoLibraries, check};
use starl_lang::diagnostic::{Colour, render};

fn machine(text: &str, variable: Option<&str>) -> StateMachine {
    let checked = check(text, &NoLibraries);
    let said = render("program", text, checked.diagnostics(), Colour::Off);
    let program = checked.correct().unwrap_or_else(|| panic!("{said}"));
    StateMachine::of(program, variable).expect("it has states")
}

/// The edges, as `from -> to: cause`, after the states in which a robot starts.
fn steps(text: &str) -> Vec<String> {
    lines(&machine(text, None))
}

fn lines(machine: &StateMachine) -> Vec<String> {
    let name = |target| match target {
        Target::State(number) => machine.states[number].name.as_str(),
        Target::Unknown => "?",
        Target::End => "end",
    };
    let starts = machine.states.iter().filter(|state| state.is_initial);
    let starts = starts.map(|state| format!("-> {}", state.name));
    let edges = machine.edges.iter().map(|edge| {
        let from = &machine.states[edge.from].name;
        format!("{from} -> {}: {}", name(edge.to), edge.cause)
    });
    starts.chain(edges).collect()
}

#[test]
fn an_action_that_does_not_ask_for_the_state_leaves_every_state() {
    let text = "program P\nloc: enum {a, b, c} = a\ngo()\n    pre loc == a\n    eff loc = b\nalarm()\n    pre bumped != none\n    eff loc = c\nback()\n    pre loc == c\n    eff loc = a\n";
    let expected = [
        "-> a",
        "a -> b: go",
        "a -> c: alarm",
        "b -> c: alarm",
        "c -> a: back",
    ];
    assert_eq!(steps(text), expected);
}

#[test]
fn a_bool_has_states_where_no_enum_has() {
    let text = "program P\nradio = Broadcast()\nmessage Go()\nis_done: Bool = false\nis_late: Bool = false\nhurry()\n    pre not is_done and not is_late\n    eff is_late = true\ngo()\n    pre not is_done\n    eff is_done = is_late; radio.broadcast(Go())\non Go(_)\n    is_done = not is_done\n";
    let expected = [
        "-> false",
        "false -> false: hurry",
        "false -> false: go",
        "false -> true: go",
        "false -> true: on Go",
        "true -> false: on Go",
    ];
    assert_eq!(steps(text), expected);
    let late = machine(text, Some("is_late"));
    assert_eq!(lines(&late), ["-> false", "false -> true: hurry"]);
}

#[test]
fn a_handler_that_asks_for_the_state_leaves_that_state_alone() {
    let text = "program P\nmessage Go()\nradio = Broadcast()\nloc: enum {a, b, c} = a\nsend()\n    pre loc == b\n    eff radio.broadcast(Go()); loc = c\non Go(_)\n    if loc == a\n        loc = b\n    elif loc == c\n        loc = a\n";
    let expected = ["-> a", "a -> b: on Go", "b -> c: send", "c -> a: on Go"];
    assert_eq!(steps(text), expected);
}

#[test]
fn an_input_leaves_the_states_that_it_asks_for() {
    let text = "program P\nloc: enum {a, b} = a\non input go(far: Bool)\n    if loc == a and far then loc = b\non input way_points()\n    loc = a\n";
    let expected = ["-> a", "a -> b: on input go", "b -> a: on input way_points"];
    assert_eq!(steps(text), expected);
}

#[test]
fn the_last_value_on_each_way_counts() {
    let text = "program P\nloc: enum {a, b, c, d} = a\nn: Int = 0\ngo()\n    pre loc == a\n    eff\n        loc = b\n        if n > 3\n            loc = c\n            return\n        n += 1\n        loc = d\nback()\n    pre loc != a\n    eff loc = a\n";
    let expected = [
        "-> a",
        "a -> c: go",
        "a -> d: go",
        "c -> a: back",
        "d -> a: back",
    ];
    assert_eq!(steps(text), expected, "`b` is never there after an action");
    let unreached = machine(text, None);
    let unreached = unreached.states.iter().find(|state| !state.is_reached);
    assert_eq!(unreached.map(|state| state.name.as_str()), Some("b"));
}

#[test]
fn effects_in_loops_are_possible_but_not_certain() {
    let text = "program P\nloc: enum {a, b, c} = a\ngo()\n    pre loc == a\n    eff\n        for p in way_points()\n            loc = if p.x > 1.0 then b else c\nback()\n    pre loc != a\n    eff loc = a\n";
    let expected = [
        "-> a",
        "a -> a: go",
        "a -> b: go",
        "a -> c: go",
        "b -> a: back",
        "c -> a: back",
    ];
    assert_eq!(steps(text), expected);
}

#[test]
fn an_unknown_value_may_be_any() {
    let text = "program P\nenum Loc {a, b}\nloc: Loc = a\nfunction next(l: Loc) -> Loc = if l == a then b else a\ngo()\n    pre loc in [a, b]\n    eff loc = next(loc)\n";
    assert_eq!(steps(text), ["-> a", "a -> ?: go", "b -> ?: go"]);
}

#[test]
fn finish_leads_to_the_end() {
    let text = "program P\nloc: enum {a, b} = a\ngo()\n    pre loc == a\n    eff loc = b\nend()\n    pre loc == b\n    eff finish()\n";
    assert_eq!(steps(text), ["-> a", "a -> b: go", "b -> end: end"]);
}

#[test]
fn init_and_the_entry_of_a_role_decide_where_a_robot_starts() {
    let text = "program P\nenum Loc {a, b, c, d}\nloc: Loc = a\ninit\n    loc = b\nrole leader\n    init\n        loc = c\n    lead()\n        pre loc == c\n        eff role = follower\nrole follower\n    follow()\n        pre loc == b or loc == c\n        eff loc = d; role = leader\n";
    let expected = [
        "-> b",
        "-> c",
        "b -> c: follower: follow",
        "b -> d: follower: follow",
        "c -> c: leader: lead",
        "c -> c: follower: follow",
        "c -> d: follower: follow",
    ];
    assert_eq!(lines(&machine(text, Some("loc"))), expected);
    let roles = [
        "-> leader",
        "-> follower",
        "leader -> follower: leader: lead",
        "follower -> leader: follower: follow",
    ];
    assert_eq!(lines(&machine(text, Some("role"))), roles);
}

#[test]
fn the_variable_that_the_most_guards_ask_for_is_shown() {
    let text = "program P\nside: enum {l, r} = l\nloc: enum {a, b} = a\ngo()\n    pre loc == a\n    eff loc = b; side = r\nback()\n    pre loc == b and side == r\n    eff loc = a\n";
    assert_eq!(machine(text, None).variable, "loc");
    assert_eq!(machine(text, Some("side")).variable, "side");
}
