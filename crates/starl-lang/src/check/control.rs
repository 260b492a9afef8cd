//! Warnings about the program's states: the values of its enum variables, and the actions between them.
//!
//! A state is entered where the variable gets it by name. It is left by actions and handlers that give
//! the variable another value and may do so in that state. Where the variable gets a value that cannot be
//! told, nothing is said of it.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::vec::Vec;

use super::feasible::truth;
use super::scope::Entity;
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, has_errors};
use crate::ir::*;

/// What the program does with one enum variable.
struct Machine {
    variable: VariableId,
    /// The values that it gets.
    entered: BTreeSet<u16>,
    /// For each action the values that it gives, and whether it ends the program.
    actions: Vec<Given>,
    handlers: Vec<Given>,
}

/// What some statements do with a variable.
#[derive(Default)]
struct Given {
    values: BTreeSet<u16>,
    /// They give it a value that cannot be told.
    is_open: bool,
    /// They say that the program is at its end.
    ends: bool,
}

impl Checker {
    /// Warns of actions that are never enabled and of states that no action leaves.
    pub fn warn_of_control(&mut self) {
        let own = &self.files[0].checked;
        if !self.is_readable() || has_errors(&own.diagnostics) || self.program.is_library {
            return;
        }
        self.file = 0;
        let machines: Vec<Machine> = (0..self.program.variables.len())
            .filter_map(|number| self.machine(VariableId(number as u32)))
            .collect();
        let mut problems = Vec::new();
        for action in &self.program.actions {
            problems.extend(self.never_enabled(action, &machines));
        }
        for machine in &machines {
            self.states_without_way_out(machine, &mut problems);
        }
        problems
            .into_iter()
            .for_each(|problem| self.report(problem));
    }

    /// What is done with a variable, if it is an enum whose values can all be told.
    fn machine(&self, variable: VariableId) -> Option<Machine> {
        if !matches!(self.program[variable].ty, Type::Enum(_)) {
            return None;
        }
        let given = |statements: &[Statement]| {
            let mut given = Given::default();
            given.collect(statements, variable, self.program.roles.as_ref());
            given
        };
        let actions: Vec<Given> = (self.program.actions.iter())
            .map(|action| given(&action.effect))
            .collect();
        let handlers: Vec<Given> = (self.program.handlers.iter())
            .map(|handler| given(&handler.body))
            .collect();
        let roles = self.program.roles.iter().flat_map(|roles| &roles.roles);
        let starts: Vec<Given> = (self.program.init.iter())
            .chain(roles.filter_map(|role| role.entry.as_ref()))
            .map(|procedure| given(&procedure.body))
            .collect();
        let all = || actions.iter().chain(&handlers).chain(&starts);
        if all().any(|given| given.is_open) {
            return None;
        }
        let mut entered: BTreeSet<u16> = all()
            .flat_map(|given| given.values.iter().copied())
            .collect();
        if self
            .program
            .roles
            .as_ref()
            .is_some_and(|roles| roles.variable == variable)
        {
            // The scenario may give any role.
            entered.extend(0..self.program.roles.as_ref()?.roles.len() as u16);
        }
        let mut first = Given::default();
        match &self.program[variable].initial {
            Some(value) => first.value(value),
            None => first.values.extend([0]),
        }
        if first.is_open {
            return None;
        }
        entered.extend(first.values);
        Some(Machine {
            variable,
            entered,
            actions,
            handlers,
        })
    }

    fn never_enabled(&self, action: &Action, machines: &[Machine]) -> Option<Diagnostic> {
        let message = format!("the action `{}` is never enabled", action.name);
        let problem = Diagnostic::new(Code::NeverEnabled, action.site.span, message);
        if truth(&action.guard, None) == Some(false) {
            return Some(problem.label(action.guard.span, "this is never true"));
        }
        for machine in machines {
            let variable = machine.variable;
            let holds = |value| truth(&action.guard, Some((variable, value))) != Some(false);
            if machine.entered.iter().any(|value| holds(*value)) {
                continue;
            }
            let name = &self.program[variable].name;
            let Type::Enum(id) = self.program[variable].ty else {
                continue;
            };
            let problem = problem.label(action.guard.span, "this is never true");
            let variants = self.program[id].variants.iter().enumerate();
            let needed: Vec<&str> = variants
                .filter(|(value, _)| holds(*value as u16))
                .map(|(_, variant)| variant.name.as_str())
                .collect();
            return Some(if needed.is_empty() {
                problem
            } else {
                problem.note(format!(
                    "`{name}` is never {}",
                    super::report::listed(needed)
                ))
            });
        }
        None
    }

    fn states_without_way_out(&self, machine: &Machine, problems: &mut Vec<Diagnostic>) {
        let variable = machine.variable;
        let (name, roles) = (&self.program[variable].name, &self.program.roles);
        let is_role = roles
            .as_ref()
            .is_some_and(|roles| roles.variable == variable);
        let changes = machine.actions.iter().chain(&machine.handlers);
        // A variable that is set once, or that decides nothing, is no control variable.
        let is_control = changes.filter(|given| !given.values.is_empty()).count() > 1;
        if is_role || !is_control || !self.usage.used.contains(&Entity::Variable(variable)) {
            return;
        }
        let Type::Enum(id) = self.program[variable].ty else {
            return;
        };
        for value in &machine.entered {
            let assumed = Some((variable, *value));
            let other = |given: &Given| given.values.iter().any(|next| next != value);
            let is_left =
                (self.program.actions.iter().zip(&machine.actions)).any(|(action, given)| {
                    other(given) && truth(&action.guard, assumed) != Some(false)
                }) || machine.handlers.iter().any(other);
            let ends =
                (self.program.actions.iter().zip(&machine.actions)).any(|(action, given)| {
                    given.ends
                        && (given.values.contains(value)
                            || truth(&action.guard, assumed) != Some(false))
                }) || machine
                    .handlers
                    .iter()
                    .any(|given| given.ends && given.values.contains(value));
            if is_left || ends || self.is_goal(variable, *value) {
                continue;
            }
            let variant = &self.program[id].variants[*value as usize];
            let message = format!("no action leaves the state `{}`", variant.name);
            let problem = Diagnostic::new(Code::NoWayOut, variant.site.span, message);
            let note = format!("once `{name}` is `{}` it stays so", variant.name);
            let end = "if that is the end of the program, call `finish()` there, or say in a property that it is reached `eventually`";
            if variant.site.file == 0 {
                problems.push(problem.note(note).note(end));
            }
        }
    }

    /// Whether a property says that the program is to come to this state.
    fn is_goal(&self, variable: VariableId, value: u16) -> bool {
        self.program
            .properties
            .iter()
            .any(|property| match &property.claim {
                Claim::Eventually { holds, .. } => names_state(holds, variable, value),
                Claim::LeadsTo { consequence, .. } => names_state(consequence, variable, value),
                Claim::Always(_) => false,
            })
    }
}

/// Whether the expression compares the variable of a robot with the value.
fn names_state(expression: &Expression, variable: VariableId, value: u16) -> bool {
    match &expression.kind {
        ExpressionKind::Binary { left, right, .. } => {
            let is_variable = |side: &Expression| {
                matches!(
                    side.kind,
                    ExpressionKind::OfRobot { member: RobotMember::Variable(of), .. } if of == variable
                )
            };
            let is_value = |side: &Expression| side.kind == ExpressionKind::Variant(value);
            is_variable(left) && is_value(right)
                || is_value(left) && is_variable(right)
                || names_state(left, variable, value)
                || names_state(right, variable, value)
        }
        ExpressionKind::Quantifier { condition, .. } => names_state(condition, variable, value),
        ExpressionKind::In { item, collection } => {
            let (ExpressionKind::List(elements) | ExpressionKind::Set(elements)) = &collection.kind
            else {
                return false;
            };
            matches!(
                item.kind,
                ExpressionKind::OfRobot { member: RobotMember::Variable(of), .. } if of == variable
            ) && elements
                .iter()
                .any(|element| element.kind == ExpressionKind::Variant(value))
        }
        _ => false,
    }
}

impl Given {
    fn collect(&mut self, statements: &[Statement], variable: VariableId, roles: Option<&Roles>) {
        for statement in statements {
            match &statement.kind {
                StatementKind::Assign { place, value }
                    if place.root == Root::Variable(variable) =>
                {
                    self.value(value);
                }
                StatementKind::ChangeRole { value }
                    if roles.is_some_and(|roles| roles.variable == variable) =>
                {
                    self.value(value);
                }
                StatementKind::If {
                    then, otherwise, ..
                } => {
                    self.collect(then, variable, roles);
                    self.collect(otherwise, variable, roles);
                }
                StatementKind::For { body, .. } | StatementKind::Atomic { body, .. } => {
                    self.collect(body, variable, roles);
                }
                StatementKind::Evaluate(Expression {
                    kind: ExpressionKind::Builtin { builtin, .. },
                    ..
                }) => {
                    self.ends |= matches!(builtin, Builtin::Finish | Builtin::Fail | Builtin::Stop);
                }
                _ => {}
            }
        }
    }

    fn value(&mut self, value: &Expression) {
        match &value.kind {
            ExpressionKind::Variant(number) => {
                self.values.insert(*number);
            }
            ExpressionKind::Conditional {
                then, otherwise, ..
            } => {
                self.value(then);
                self.value(otherwise);
            }
            _ => self.is_open = true,
        }
    }
}
