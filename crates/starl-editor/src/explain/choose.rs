//! Which variable the program's control is in.

use super::Refusal;
use starl_lang::check::feasible::finite_variables;
use starl_lang::check::transitions::Transitions;
use starl_lang::ir::{Program, Type, VariableId};

/// The variable with this name, of an enum or a Bool; without a name the one of an enum that the most guards decide by,
/// of equal ones the one that the most actions write, then the first. The variable `role` is the last choice of those,
/// and a Bool is chosen only where there is no enum.
pub(super) fn variable(program: &Program, name: Option<&str>) -> Result<VariableId, Refusal> {
    let candidates =
        (program.variables.iter().enumerate()).filter(|(_, variable)| variable.ty.is_finite());
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
        .collect::<Vec<_>>();
    let role = program.roles.as_ref().map(|roles| roles.variable);
    let weight = |id: VariableId| {
        let deciding =
            (program.actions.iter()).filter(|action| finite_variables(&action.guard).contains(&id));
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
