//! A state machine as a graph for Graphviz (<https://graphviz.org/doc/info/lang.html>).
//!
//! Handlers are dashed. A state that is not left has a double border, one that is not reached a dotted one.

use super::{StateMachine, Target};

pub(super) fn write(machine: &StateMachine) -> String {
    let StateMachine {
        program, variable, ..
    } = machine;
    let title = format!("{program}: {variable}");
    let mut text = format!("digraph {} {{\n", quoted(&title));
    let mut line = |words: &str| {
        text.push_str("    ");
        text.push_str(words);
        text.push_str(";\n");
    };
    line(&format!("label = {}", quoted(&title)));
    line("labelloc = t");
    line("node [shape = box, style = rounded]");
    for (number, state) in machine.states.iter().enumerate() {
        let look = match (state.is_reached, state.is_left) {
            (false, _) => ", style = \"rounded,dotted\"",
            (true, false) => ", peripheries = 2",
            (true, true) => "",
        };
        line(&format!(
            "s{number} [label = {}{look}]",
            quoted(&state.name)
        ));
    }
    line("start [shape = point, width = 0.15]");
    for (number, state) in machine.states.iter().enumerate() {
        if state.is_initial {
            line(&format!("start -> s{number}"));
        }
    }
    let leads_to = |target| machine.edges.iter().any(|edge| edge.to == target);
    if leads_to(Target::End) {
        line(
            "end [shape = doublecircle, style = filled, fillcolor = black, label = \"\", width = 0.12]",
        );
    }
    if leads_to(Target::Unknown) {
        line("unknown [label = \"unknown\", style = \"rounded,dotted\"]");
    }
    for edge in &machine.edges {
        let to = match edge.to {
            Target::State(number) => format!("s{number}"),
            Target::Unknown => "unknown".to_string(),
            Target::End => "end".to_string(),
        };
        // Blanks keep the words off the lines.
        let label = quoted(&format!(" {} ", edge.cause));
        let look = match edge.cause.is_handler {
            true => ", style = dashed",
            false => "",
        };
        line(&format!("s{} -> {to} [label = {label}{look}]", edge.from));
    }
    text.push_str("}\n");
    text
}

/// A text in quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
