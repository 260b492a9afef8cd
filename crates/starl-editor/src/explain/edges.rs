//! The states in which a robot may start, and the steps between states.

use super::{Cause, Edge, Target};
use starl_lang::check::feasible::{finite_variables, truth};
use starl_lang::check::transitions::{Given, Transitions, first_values};
use starl_lang::ir::{Action, Event, Handler, Procedure, Program, VariableId};
use std::collections::BTreeSet;

/// The states in which a robot may be once it has started: after the first values, `init` and the entry
/// of its first role.
pub(super) fn initial(program: &Program, variable: VariableId, states: usize) -> BTreeSet<usize> {
    let all = || (0..states).collect();
    let first = first_values(program).remove(&variable).unwrap_or_default();
    if first.is_open {
        return all();
    }
    let mut present = first.values;
    let roles = program.roles.iter().flat_map(|roles| &roles.roles);
    let entries: Vec<Option<&Procedure>> = roles.map(|role| role.entry.as_ref()).collect();
    let after_init = after(program, variable, &present, program.init.as_ref());
    let Some(after_init) = after_init else {
        return all();
    };
    present = match entries.is_empty() {
        true => after_init,
        false => {
            let mut joined = BTreeSet::new();
            for entry in entries {
                match after(program, variable, &after_init, entry) {
                    Some(values) => joined.extend(values),
                    None => return all(),
                }
            }
            joined
        }
    };
    let numbers = present.into_iter().map(usize::from);
    numbers.filter(|number| *number < states).collect()
}

/// The values after a procedure, none if they cannot be determined.
fn after(
    program: &Program,
    variable: VariableId,
    before: &BTreeSet<u16>,
    procedure: Option<&Procedure>,
) -> Option<BTreeSet<u16>> {
    let Some(procedure) = procedure else {
        return Some(before.clone());
    };
    let mut values = BTreeSet::new();
    for value in before {
        let assumed = Some((variable, *value));
        let mut transitions = Transitions::assuming(&procedure.body, program, assumed);
        match transitions.given.remove(&variable) {
            None => {
                values.insert(*value);
            }
            Some(given) if given.is_open => return None,
            Some(given) => {
                values.extend(given.values);
                values.extend(given.may_stay.then_some(*value));
            }
        }
    }
    Some(values)
}

/// The states that can be reached, and all edges out of these.
pub(super) fn reachable(
    program: &Program,
    variable: VariableId,
    initial: &BTreeSet<usize>,
    states: usize,
) -> (BTreeSet<usize>, Vec<Edge>) {
    let mut reached = initial.clone();
    let mut waiting: Vec<usize> = reached.iter().copied().collect();
    let mut edges = Vec::new();
    while let Some(state) = waiting.pop() {
        let from = edges.len();
        steps(program, variable, state, &mut edges);
        for edge in &edges[from..] {
            let targets = match edge.to {
                Target::State(next) => next..next + 1,
                Target::Unknown => 0..states,
                Target::End => 0..0,
            };
            for next in targets {
                if reached.insert(next) {
                    waiting.push(next);
                }
            }
        }
    }
    // Steps with the same start and end stay in the order of the program.
    edges.sort_by_key(|edge| (edge.from, edge.to));
    (reached, edges)
}

/// The edges out of a state.
fn steps(program: &Program, variable: VariableId, state: usize, edges: &mut Vec<Edge>) {
    let assumed = Some((variable, state as u16));
    for action in &program.actions {
        if truth(&action.guard, assumed) == Some(false) {
            continue;
        }
        let step = Step {
            state,
            cause: action_cause(program, action),
            shows_staying: finite_variables(&action.guard).contains(&variable),
        };
        let transitions = Transitions::assuming(&action.effect, program, assumed);
        step.add(variable, &transitions, edges);
    }
    for handler in &program.handlers {
        let step = Step {
            state,
            cause: handler_cause(program, handler),
            shows_staying: false,
        };
        let transitions = Transitions::assuming(&handler.body, program, assumed);
        step.add(variable, &transitions, edges);
    }
}

/// The effect of an action or handler in one state.
struct Step {
    state: usize,
    cause: Cause,
    /// Whether it is worth saying that the state may stay as it is: of actions that are meant for it.
    shows_staying: bool,
}

impl Step {
    fn add(&self, variable: VariableId, transitions: &Transitions, edges: &mut Vec<Edge>) {
        let stays = Given {
            may_stay: true,
            ..Given::default()
        };
        let given = transitions.given.get(&variable).unwrap_or(&stays);
        let mut targets: BTreeSet<Target> = (given.values.iter())
            .map(|value| Target::State(usize::from(*value)))
            .collect();
        if given.may_stay {
            targets.insert(Target::State(self.state));
        }
        if given.is_open {
            targets.insert(Target::Unknown);
        }
        let is_staying = |target: &Target| *target == Target::State(self.state);
        if transitions.finishes {
            targets.retain(|target| !is_staying(target));
            targets.insert(Target::End);
        }
        targets.retain(|target| self.shows_staying || !is_staying(target));
        edges.extend(targets.into_iter().map(|to| Edge {
            from: self.state,
            to,
            cause: self.cause.clone(),
        }));
    }
}

fn action_cause(program: &Program, action: &Action) -> Cause {
    Cause {
        is_handler: false,
        role: role_name(program, action.role),
        name: action.name.clone(),
    }
}

fn handler_cause(program: &Program, handler: &Handler) -> Cause {
    let name = match &handler.event {
        Event::Error => String::new(),
        Event::Message(record) => program.message_name(*record),
        Event::Primitive { binding, event } => {
            let binding = &program[*binding].name;
            format!("{binding}.{}", event.name())
        }
        Event::Input { name, .. } => format!("input {name}"),
    };
    Cause {
        is_handler: true,
        role: role_name(program, handler.role),
        name,
    }
}

fn role_name(program: &Program, role: Option<u16>) -> Option<String> {
    let roles = program.roles.as_ref()?;
    let role = roles.roles.get(usize::from(role?))?;
    Some(role.name.to_string())
}
