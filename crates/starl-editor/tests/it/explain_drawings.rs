//! How state machines are written for Mermaid and for Graphviz.

use starl_editor::explain::StateMachine;
use starl_lang::check::{NoLibraries, check};

const DOOR: &str = include_str!("../drawings/door.starl");

fn door() -> StateMachine {
    let checked = check(DOOR, &NoLibraries);
    let program = checked.correct().expect("the program has no errors");
    StateMachine::of(program, None).expect("it has states")
}

#[test]
fn mermaid_shows_starts_steps_and_states_that_are_not_left() {
    assert_eq!(door().mermaid(), include_str!("../drawings/door.mmd"));
}

#[test]
fn states_that_are_not_reached_look_different() {
    let text = "program P\nloc: enum {a, b, c} = a\ngo()\n    pre loc == a\n    eff loc = b\nback()\n    pre loc == b\n    eff loc = a\n";
    let checked = check(text, &NoLibraries);
    let machine = StateMachine::of(&checked.program, None).expect("it has states");
    assert!(machine.mermaid().contains("    class c notReached\n"));
    let dotted = "    s2 [label = \"c\", style = \"rounded,dotted\"];\n";
    assert!(machine.dot().contains(dotted));
}

#[test]
fn graphviz_shows_handlers_dashed() {
    assert_eq!(door().dot(), include_str!("../drawings/door.dot"));
}
