//! Which variable the program's control is in.

use alloc::collections::BTreeSet;
use alloc::string::ToString;

use super::Refusal;
use crate::check::feasible::{finite_variables, is_finite};
use crate::check::transitions::Transitions;
use crate::ir::{Program, Type, VariableId};

/// The variable with this name, of an enum or a Bool; without a name the one of an enum that the most guards decide by,
/// of equal ones the one that the most actions write, then the first. The variable `role` is the last choice of those,
/// and a Bool is chosen only where there is no enum.
pub(super) fn variable(program: &Program, name: Option<&str>) -> Result<VariableId, Refusal> {
    let candidates =
        (program.variables.iter().enumerate()).filter(|(_, variable)| is_finite(&variable.ty));
    if let Some(name) = name {
        let mut named = candidates.clone();
        return match named.find(|(_, variable)| variable.name == name) {
            Some((number, _)) => Ok(VariableId(number as u32)),
            None => Err(Refusal::UnknownVariable {
                name: name.to_string(),
                others: candidates.map(|(_, own)| own.name.clone()).collect(),
            }),
        };
    }
    let written = (program.actions.iter())
        .map(|action| Transitions::of(&action.effect, program))
        .collect::<alloc::vec::Vec<_>>();
    let role = program.roles.as_ref().map(|roles| roles.variable);
    let weight = |id: VariableId| {
        let deciding = (program.actions.iter()).filter(|action| {
            let mut named = BTreeSet::new();
            finite_variables(&action.guard, &mut named);
            named.contains(&id)
        });
        let writing = written
            .iter()
            .filter(|transitions| transitions.given.contains_key(&id));
        let is_enum = program[id].ty != Type::Bool;
        (is_enum, Some(id) != role, deciding.count(), writing.count())
    };
    candidates
        .map(|(number, _)| VariableId(number as u32))
        .rev()
        .max_by_key(|id| weight(*id))
        .ok_or(Refusal::NoControlVariable)
}
