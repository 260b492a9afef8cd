//! The effect of statements on Bools and variables of enums: the values that each may have afterwards, where they are known.
//!
//! All paths through the statements count, except branches whose condition contradicts the value assumed at the start
//! or the values assigned before. Inside loops no value is assumed, because a statement may run after a later one.

use alloc::collections::{BTreeMap, BTreeSet};

use super::feasible::{Assumption, truth};
use super::tables::Builtin;
use crate::ir::*;

/// The effect of some statements.
#[derive(Clone, Debug, Default)]
pub struct Transitions {
    /// The values given to the variables that they write.
    pub given: BTreeMap<VariableId, Given>,
    /// They may say that the program is at its end, has failed, or that the robot is to stop.
    pub ends: bool,
    /// They may say that the program has reached its goal.
    pub finishes: bool,
}

/// The values given to a variable.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// The values that it may get.
    pub values: BTreeSet<u16>,
    /// It may get one that cannot be determined.
    pub is_open: bool,
    /// On some way it is not written.
    pub may_stay: bool,
}

impl Transitions {
    /// The effect of the statements for any values of the variables before.
    #[must_use]
    pub fn of(statements: &[Statement], program: &Program) -> Self {
        Self::assuming(statements, program, None)
    }

    /// The effect of the statements if a variable has this value before.
    #[must_use]
    pub fn assuming(statements: &[Statement], program: &Program, assumed: Assumption) -> Self {
        let mut walk = Walk {
            program,
            assumed,
            loops: 0,
            entering: BTreeSet::new(),
            returned: None,
            done: Self::default(),
        };
        let end = walk.block(statements, Ways::new());
        let given = match (end, walk.returned) {
            (Some(end), Some(returned)) => joined(end, returned),
            (Some(ways), None) | (None, Some(ways)) => ways,
            (None, None) => Ways::new(),
        };
        Self { given, ..walk.done }
    }
}

/// The values of variables on some paths through the statements; a variable that is not in the map keeps its value.
type Ways = BTreeMap<VariableId, Given>;

/// A walk through statements.
struct Walk<'a> {
    program: &'a Program,
    assumed: Assumption,
    /// How many loops are around the place.
    loops: u32,
    /// The roles whose entries are around the place.
    entering: BTreeSet<u16>,
    /// The ways that ended by a `return`.
    returned: Option<Ways>,
    done: Transitions,
}

impl Walk<'_> {
    /// The ways that come to the end of the statements, if any does.
    fn block(&mut self, statements: &[Statement], mut ways: Ways) -> Option<Ways> {
        for statement in statements {
            ways = self.statement(statement, ways)?;
        }
        Some(ways)
    }

    fn statement(&mut self, statement: &Statement, mut ways: Ways) -> Option<Ways> {
        match &statement.kind {
            StatementKind::Assign { place, value } => {
                if let Root::Variable(id) = &place.root
                    && value.ty.is_finite()
                    && place.path.is_empty()
                {
                    let given = self.value(value, &ways);
                    ways.insert(*id, given);
                }
            }
            StatementKind::ChangeRole { value } => return Some(self.change_role(value, ways)),
            StatementKind::If {
                condition,
                then,
                otherwise,
            } => return self.branches(condition, then, otherwise, ways),
            StatementKind::For { body, .. } => {
                self.loops += 1;
                let after = self.block(body, ways.clone());
                self.loops -= 1;
                return Some(match after {
                    Some(after) => joined(ways, after),
                    None => ways,
                });
            }
            StatementKind::Atomic { body, .. } => return self.block(body, ways),
            StatementKind::Return(_) => {
                self.returned = Some(match self.returned.take() {
                    Some(others) => joined(others, ways),
                    None => ways,
                });
                return None;
            }
            StatementKind::Evaluate(Expression {
                kind: ExpressionKind::Builtin { builtin, .. },
                ..
            }) => {
                self.done.ends |=
                    matches!(builtin, Builtin::Finish | Builtin::Fail | Builtin::Stop);
                self.done.finishes |= matches!(builtin, Builtin::Finish);
            }
            StatementKind::Evaluate(_)
            | StatementKind::Let { .. }
            | StatementKind::Update { .. } => {}
        }
        Some(ways)
    }

    fn branches(
        &mut self,
        condition: &Expression,
        then: &[Statement],
        otherwise: &[Statement],
        ways: Ways,
    ) -> Option<Ways> {
        match self.truth(condition, &ways) {
            Some(true) => self.block(then, ways),
            Some(false) => self.block(otherwise, ways),
            None => {
                let held = self.block(then, ways.clone());
                let not_held = self.block(otherwise, ways);
                match (held, not_held) {
                    (Some(held), Some(not_held)) => Some(joined(held, not_held)),
                    (ways, None) | (None, ways) => ways,
                }
            }
        }
    }

    /// A robot that enters another role does what it does on entering.
    fn change_role(&mut self, value: &Expression, mut ways: Ways) -> Ways {
        let Some(roles) = &self.program.roles else {
            return ways;
        };
        let given = self.value(value, &ways);
        let values = match given.is_open {
            true => (0..roles.roles.len() as u16).collect(),
            false => given.values.clone(),
        };
        ways.insert(roles.variable, given);
        // It may have the role already, and then enters nothing.
        let mut after = ways.clone();
        for role in values {
            // A role whose entry leads to itself: what the outer one does counts.
            if !self.entering.insert(role) {
                continue;
            }
            let mut entered = ways.clone();
            for (id, given) in first_values(self.program) {
                if self.program[id].role == Some(role) {
                    entered.insert(id, given);
                }
            }
            let entry = roles.roles.get(usize::from(role));
            let entered = match entry.and_then(|role| role.entry.as_ref()) {
                Some(entry) => {
                    // A `return` ends the entry alone.
                    let outer = self.returned.take();
                    let end = self.block(&entry.body, entered);
                    let returned = core::mem::replace(&mut self.returned, outer);
                    end.into_iter().chain(returned).reduce(joined)
                }
                None => Some(entered),
            };
            if let Some(entered) = entered {
                after = joined(after, entered);
            }
            self.entering.remove(&role);
        }
        after
    }

    /// The values that an expression may have.
    fn value(&self, value: &Expression, ways: &Ways) -> Given {
        let mut given = Given::default();
        self.collect(value, ways, &mut given);
        given
    }

    fn collect(&self, value: &Expression, ways: &Ways, given: &mut Given) {
        match &value.kind {
            ExpressionKind::Variant(number) => {
                given.values.insert(*number);
            }
            ExpressionKind::Conditional {
                condition,
                then,
                otherwise,
            } => {
                let truth = self.truth(condition, ways);
                if truth != Some(false) {
                    self.collect(then, ways, given);
                }
                if truth != Some(true) {
                    self.collect(otherwise, ways, given);
                }
            }
            _ if value.ty == Type::Bool => match self.truth(value, ways) {
                Some(truth) => given.values.extend([u16::from(truth)]),
                None => given.values.extend([0, 1]),
            },
            _ => given.is_open = true,
        }
    }

    /// Whether a condition holds there; none if it may and may not.
    fn truth(&self, condition: &Expression, ways: &Ways) -> Option<bool> {
        let Some((variable, before)) = self.assumed.filter(|_| self.loops == 0) else {
            return truth(condition, None);
        };
        let Some(given) = ways.get(&variable) else {
            return truth(condition, self.assumed);
        };
        if given.is_open {
            return truth(condition, None);
        }
        let stays = given.may_stay.then_some(&before);
        let values = given.values.iter().chain(stays);
        let mut truths = values.map(|value| truth(condition, Some((variable, *value))));
        let first = truths.next()??;
        truths.all(|truth| truth == Some(first)).then_some(first)
    }
}

/// The values on either of two sets of paths.
fn joined(mut some: Ways, others: Ways) -> Ways {
    for (id, given) in &mut some {
        given.may_stay |= !others.contains_key(id);
    }
    for (id, other) in others {
        let given = some.entry(id).or_insert_with(|| Given {
            may_stay: true,
            ..Given::default()
        });
        given.values.extend(other.values);
        given.is_open |= other.is_open;
        given.may_stay |= other.may_stay;
    }
    some
}

/// The first values of Bools and variables of enums; the scenario may give any role.
#[must_use]
pub fn first_values(program: &Program) -> BTreeMap<VariableId, Given> {
    let mut first: BTreeMap<VariableId, Given> = BTreeMap::new();
    let walk = Walk {
        program,
        assumed: None,
        loops: 0,
        entering: BTreeSet::new(),
        returned: None,
        done: Transitions::default(),
    };
    for (number, variable) in program.variables.iter().enumerate() {
        if !variable.ty.is_finite() {
            continue;
        }
        let own = VariableId(number as u32);
        let is_role = (program.roles.as_ref()).is_some_and(|roles| roles.variable == own);
        let given = match &variable.initial {
            Some(value) => walk.value(value, &Ways::new()),
            None if is_role => Given {
                values: (0..program.values_of(own).len() as u16).collect(),
                ..Given::default()
            },
            None => Given {
                values: BTreeSet::from([0]),
                ..Given::default()
            },
        };
        first.insert(own, given);
    }
    first
}
