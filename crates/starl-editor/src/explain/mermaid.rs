//! A state machine as a Mermaid state diagram (<https://mermaid.js.org/syntax/stateDiagram.html>).

use super::{State, StateMachine, Target};

/// Words that Mermaid takes for something else than the name of a state.
const RESERVED: &[&str] = &[
    "accDescr",
    "accTitle",
    "as",
    "choice",
    "class",
    "classDef",
    "click",
    "default",
    "direction",
    "end",
    "fork",
    "hide",
    "href",
    "join",
    "note",
    "root",
    "scale",
    "state",
    "stateDiagram",
    "style",
    "title",
];

/// The identifier of the unknown state; no state of a program has it.
const UNKNOWN: &str = "unknown_state_";

pub(super) fn write(machine: &StateMachine) -> String {
    let StateMachine {
        program, variable, ..
    } = machine;
    let mut text = format!("---\ntitle: \"{program}: {variable}\"\n---\nstateDiagram-v2\n");
    let mut line = |words: &str| {
        text.push_str("    ");
        text.push_str(words);
        text.push('\n');
    };
    for state in &machine.states {
        let name = &state.name;
        match identifier(state) {
            own if own == *name => line(name),
            own => line(&format!("state \"{name}\" as {own}")),
        }
    }
    if machine.edges.iter().any(|edge| edge.to == Target::Unknown) {
        line(&format!("state \"unknown\" as {UNKNOWN}"));
    }
    for state in machine.states.iter().filter(|state| state.is_initial) {
        line(&format!("[*] --> {}", identifier(state)));
    }
    for edge in &machine.edges {
        let to = match edge.to {
            Target::State(number) => identifier(&machine.states[number]),
            Target::Unknown => UNKNOWN.to_string(),
            Target::End => "[*]".to_string(),
        };
        let from = identifier(&machine.states[edge.from]);
        line(&format!("{from} --> {to}: {}", edge.cause));
    }
    classes(machine, &mut line);
    text
}

/// States that are not left, or not reached, look different.
fn classes(machine: &StateMachine, line: &mut impl FnMut(&str)) {
    let stuck = |state: &&State| state.is_reached && !state.is_left;
    let unreached = |state: &&State| !state.is_reached;
    if machine.states.iter().any(|state| stuck(&state)) {
        line("classDef notLeft stroke-width:4px");
    }
    if machine.states.iter().any(|state| unreached(&state)) {
        line("classDef notReached stroke-dasharray:4");
    }
    for state in machine.states.iter().filter(stuck) {
        line(&format!("class {} notLeft", identifier(state)));
    }
    for state in machine.states.iter().filter(unreached) {
        line(&format!("class {} notReached", identifier(state)));
    }
}

/// A word that Mermaid takes for the name of the state: the state's own where it can.
fn identifier(state: &State) -> String {
    let name = &state.name;
    let is_reserved = (RESERVED.iter()).any(|word| word.eq_ignore_ascii_case(name));
    // Names that end so get one more, so that no two become the same.
    match is_reserved || name.ends_with('_') {
        true => format!("{name}_"),
        false => name.clone(),
    }
}
