//! Warnings about the program's states: the values of its enum variables, and the actions between them.
//!
//! A state is entered by an assignment of its name. It is left by actions and handlers that assign another value and
//! may run in that state. A variable that gets an unknown value has no such warnings.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::vec::Vec;

use super::feasible::{finite_variables, truth};
use super::scope::Entity;
use super::state::Checker;
use super::transitions::{Given, Transitions, first_values};
use crate::diagnostic::{Code, Diagnostic, has_errors};
use crate::ir::*;

/// The uses of the program's Bools and variables of enums.
struct Control {
    /// By action.
    actions: Vec<Transitions>,
    /// By handler.
    handlers: Vec<Transitions>,
    /// The values that each variable gets, for those of which all can be determined.
    entered: BTreeMap<VariableId, BTreeSet<u16>>,
    /// For each variable the actions that write it.
    writers: BTreeMap<VariableId, Vec<usize>>,
}

impl Checker {
    /// Warns of actions that are never enabled and of states that no action leaves.
    pub fn warn_of_control(&mut self) {
        let own = &self.files[0].checked;
        if !self.is_readable() || has_errors(&own.diagnostics) || self.program.is_library {
            return;
        }
        self.file = 0;
        let control = Control::of(&self.program);
        let mut problems = Vec::new();
        for action in &self.program.actions {
            problems.extend(self.never_enabled(action, &control));
        }
        for (variable, entered) in &control.entered {
            self.states_without_way_out(*variable, entered, &control, &mut problems);
        }
        problems
            .into_iter()
            .for_each(|problem| self.report(problem));
    }

    fn never_enabled(&self, action: &Action, control: &Control) -> Option<Diagnostic> {
        let problem = || {
            let message = format!("the action `{}` is never enabled", action.name);
            let problem = Diagnostic::new(Code::NeverEnabled, action.site.span, message);
            problem.label(action.guard.span, "this is never true")
        };
        if truth(&action.guard, None) == Some(false) {
            return Some(problem());
        }
        for variable in finite_variables(&action.guard) {
            let Some(entered) = control.entered.get(&variable) else {
                continue;
            };
            let holds = |value| truth(&action.guard, Some((variable, value))) != Some(false);
            if entered.iter().any(|value| holds(*value)) {
                continue;
            }
            let Type::Enum(id) = self.program[variable].ty else {
                continue;
            };
            let variants = self.program[id].variants.iter().enumerate();
            let needed: Vec<&str> = variants
                .filter(|(value, _)| holds(*value as u16))
                .map(|(_, variant)| variant.name.as_str())
                .collect();
            let name = &self.program[variable].name;
            return Some(if needed.is_empty() {
                problem()
            } else {
                problem().note(format!(
                    "`{name}` is never {}",
                    super::report::listed(needed)
                ))
            });
        }
        None
    }

    fn states_without_way_out(
        &self,
        variable: VariableId,
        entered: &BTreeSet<u16>,
        control: &Control,
        problems: &mut Vec<Diagnostic>,
    ) {
        let roles = &self.program.roles;
        let is_role = (roles.as_ref()).is_some_and(|roles| roles.variable == variable);
        // A variable that is set once, or that decides nothing, is not a control variable.
        let is_read = self.usage.used.contains(&Entity::Variable(variable));
        let Type::Enum(id) = self.program[variable].ty else {
            return;
        };
        if is_role || !is_read || control.writes(variable) < 2 {
            return;
        }
        for value in entered {
            let Some(variant) = self.program[id].variants.get(usize::from(*value)) else {
                continue;
            };
            if variant.site.file != 0
                || control.is_left(&self.program, variable, *value)
                || control.is_end(&self.program, variable, *value)
                || self.is_goal(variable, *value)
            {
                continue;
            }
            let message = format!("no action leaves the state `{}`", variant.name);
            let problem = Diagnostic::new(Code::NoWayOut, variant.site.span, message);
            let name = &self.program[variable].name;
            let note = format!("once `{name}` is `{}` it stays so", variant.name);
            let end = "if that is the end of the program, call `finish()` there, or say in a property that it is reached `eventually`";
            problems.push(problem.note(note).note(end));
        }
    }

    /// Whether a property says that the program is to come to this state.
    fn is_goal(&self, variable: VariableId, value: u16) -> bool {
        let mut properties = self.program.properties.iter();
        properties.any(|property| match &property.claim {
            Claim::Eventually { holds, .. } | Claim::EventuallyAlways { holds, .. } => {
                names_state(holds, variable, value)
            }
            Claim::LeadsTo { consequence, .. } => names_state(consequence, variable, value),
            Claim::Always(_) => false,
        })
    }
}

impl Control {
    fn of(program: &Program) -> Self {
        let of = |statements: &[Statement]| Transitions::of(statements, program);
        let actions: Vec<Transitions> = (program.actions.iter())
            .map(|action| of(&action.effect))
            .collect();
        let handlers: Vec<Transitions> = (program.handlers.iter())
            .map(|handler| of(&handler.body))
            .collect();
        let roles = program.roles.iter().flat_map(|roles| &roles.roles);
        let entries = roles.filter_map(|role| role.entry.as_ref());
        let starts: Vec<Transitions> = (program.init.iter().chain(entries))
            .map(|procedure| of(&procedure.body))
            .collect();
        let mut all: BTreeMap<VariableId, Given> = first_values(program);
        for (variable, given) in (actions.iter().chain(&handlers).chain(&starts))
            .flat_map(|transitions| &transitions.given)
        {
            let known = all.entry(*variable).or_default();
            known.values.extend(&given.values);
            known.is_open |= given.is_open;
        }
        let told = all.into_iter().filter(|(_, given)| !given.is_open);
        let mut writers: BTreeMap<VariableId, Vec<usize>> = BTreeMap::new();
        for (number, action) in actions.iter().enumerate() {
            for variable in action.given.keys() {
                writers.entry(*variable).or_default().push(number);
            }
        }
        Self {
            entered: told
                .map(|(variable, given)| (variable, given.values))
                .collect(),
            actions,
            handlers,
            writers,
        }
    }

    /// How many actions and handlers write the variable.
    fn writes(&self, variable: VariableId) -> usize {
        let handlers = self.handlers.iter();
        let handlers = handlers.filter(|handler| handler.given.contains_key(&variable));
        self.writers.get(&variable).map_or(0, Vec::len) + handlers.count()
    }

    /// Whether some action or handler leaves the state.
    fn is_left(&self, program: &Program, variable: VariableId, value: u16) -> bool {
        let leaves = |statements: &[Statement]| {
            let assumed = Some((variable, value));
            let mut transitions = Transitions::assuming(statements, program, assumed);
            let given = transitions.given.remove(&variable);
            given.is_some_and(|given| given.values.iter().any(|next| *next != value))
        };
        let writes = |transitions: &Transitions| transitions.given.contains_key(&variable);
        let mut writers = self.writers.get(&variable).into_iter().flatten();
        let mut handlers = program.handlers.iter().zip(&self.handlers);
        writers.any(|number| {
            let action = &program.actions[*number];
            truth(&action.guard, Some((variable, value))) != Some(false) && leaves(&action.effect)
        }) || handlers.any(|(handler, transitions)| writes(transitions) && leaves(&handler.body))
    }

    /// Whether the program is said to be at its end in the state, or where it is entered.
    fn is_end(&self, program: &Program, variable: VariableId, value: u16) -> bool {
        let enters = |transitions: &Transitions| {
            let given = transitions.given.get(&variable);
            given.is_some_and(|given| given.values.contains(&value))
        };
        let mut ends = self
            .actions
            .iter()
            .enumerate()
            .filter(|(_, action)| action.ends);
        ends.any(|(number, action)| {
            let guard = &program.actions[number].guard;
            enters(action) || truth(guard, Some((variable, value))) != Some(false)
        }) || self
            .handlers
            .iter()
            .any(|handler| handler.ends && enters(handler))
    }
}

/// Whether the expression compares the variable of a robot with the value.
fn names_state(expression: &Expression, variable: VariableId, value: u16) -> bool {
    let is_variable = |side: &Expression| {
        matches!(
            side.kind,
            ExpressionKind::OfRobot { member: RobotMember::Variable(of), .. } if of == variable
        )
    };
    let is_value = |side: &Expression| side.kind == ExpressionKind::Variant(value);
    match &expression.kind {
        ExpressionKind::Binary { left, right, .. } => {
            is_variable(left) && is_value(right)
                || is_value(left) && is_variable(right)
                || names_state(left, variable, value)
                || names_state(right, variable, value)
        }
        ExpressionKind::Quantifier { condition, .. } | ExpressionKind::Over { condition, .. } => {
            names_state(condition, variable, value)
        }
        ExpressionKind::In { item, collection } => match &collection.kind {
            ExpressionKind::List(elements) | ExpressionKind::Set(elements) => {
                is_variable(item) && elements.iter().any(is_value)
            }
            _ => false,
        },
        _ => false,
    }
}
