//! The control variable of a program: its value shows the stage of each robot to an observer of many robots.
//!
//! Programs after the thesis keep that in a variable of an enum, as `loc` in its figure 2.1.

use crate::machine::{Bytecode, Layout, Parameter, State, Type, Variable};
use alloc::string::String;

/// A variable of an enum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Its place among the scalars of the state.
    scalar: usize,
    /// Its enum, by its place among those of the program.
    kind: u16,
}

impl Stage {
    /// The first enum variable that is not a parameter; if there is none, the variable `role`.
    pub fn of(bytecode: &Bytecode) -> Option<Stage> {
        let mut scalar = 0;
        let mut role = None;
        for (number, variable) in bytecode.variables.iter().enumerate() {
            if let Type::Enum(kind) = variable.kind {
                let stage = Stage { scalar, kind };
                if variable.parameter == Parameter::No {
                    return Some(stage);
                }
                role = role.or_else(|| is_role(number, variable).then_some(stage));
            }
            scalar += Layout::of([&variable.kind]).scalars.len();
        }
        role
    }

    /// The name of its value; none if a fault has given it an invalid value.
    pub fn read<'a>(&self, bytecode: &'a Bytecode, state: &State) -> Option<&'a str> {
        let variants = &bytecode.enums.get(usize::from(self.kind))?.variants;
        let value = usize::try_from(*state.scalars.get(self.scalar)?).ok()?;
        variants.get(value).map(String::as_str)
    }
}

/// Scenarios set the role as they set parameters.
fn is_role(number: usize, variable: &Variable) -> bool {
    number == 0 && variable.name == "role"
}
