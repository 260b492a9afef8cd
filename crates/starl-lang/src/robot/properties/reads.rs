//! The variables that a property reads: for the excuse of overwritten variables, and for the report of a violation.

use super::fleet::Fleet;
use crate::machine::{
    Bytecode, Claim, Import, Instruction, Layout, ObjectType, Program, Type, Value,
};
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::RobotId;

/// The variables that a property reads.
#[derive(Clone, Debug, Default)]
pub struct Reads {
    /// Variables of the state, by their places in the program.
    variables: Vec<usize>,
    /// Shared variables.
    shared: Vec<Shared>,
    /// Whether it reads if robots have finished.
    finished: bool,
}

/// A shared variable that is read.
#[derive(Clone, Debug, PartialEq)]
struct Shared {
    name: String,
    /// Whether each robot writes an element of its own.
    is_single_writer: bool,
    /// The type of the variable or of an element.
    kind: Type,
}

impl Reads {
    /// Whether it reads variables, which a fault may overwrite.
    pub fn has_variables(&self) -> bool {
        !self.variables.is_empty() || !self.shared.is_empty()
    }

    /// Those that a claim reads.
    pub fn of(bytecode: &Bytecode, claim: Claim) -> Reads {
        let second = match claim {
            Claim::LeadsTo { consequence, .. } => Some(consequence),
            _ => None,
        };
        let functions = [Some(first_function(claim)), second];
        let functions = functions.into_iter().flatten();
        let functions = functions.filter_map(|index| bytecode.functions.get(index as usize));
        let instructions = functions.flat_map(|f| {
            let range = f.entry as usize..f.end as usize;
            bytecode.code.get(range).unwrap_or_default()
        });
        let (mut scalars, mut objects, mut shared) = (Vec::new(), Vec::new(), Vec::new());
        let mut finished = false;
        for instruction in instructions {
            match instruction {
                Instruction::LoadOther { variable, .. }
                | Instruction::LoadOtherPoint { variable, .. } => scalars.push(variable.0 as usize),
                Instruction::LoadOtherObject { variable, .. } => objects.push(variable.0 as usize),
                Instruction::CallHost { import, .. } => {
                    let import = bytecode.imports.get(import.0 as usize);
                    finished |= import.is_some_and(|import| import.name == "robot.finished");
                    let found = import.and_then(|import| Shared::of(bytecode, import));
                    shared.extend(found.filter(|found| !shared.contains(found)));
                }
                _ => {}
            }
        }
        let mut next = (0, 0);
        let mut variables = Vec::new();
        for (index, variable) in bytecode.variables.iter().enumerate() {
            let layout = Layout::of([&variable.kind]);
            let end = (next.0 + layout.scalars.len(), next.1 + layout.objects.len());
            if scalars.iter().any(|slot| (next.0..end.0).contains(slot))
                || objects.iter().any(|slot| (next.1..end.1).contains(slot))
            {
                variables.push(index);
            }
            next = end;
        }
        Reads {
            variables,
            shared,
            finished,
        }
    }

    /// Their values on a robot, with their names; of all variables of the state if it reads none.
    pub fn values(
        &self,
        program: &Program,
        fleet: &dyn Fleet,
        robot: RobotId,
    ) -> Vec<(String, Value)> {
        let names: Vec<&str> = (program.bytecode().variables.iter().enumerate())
            .filter(|(index, _)| !self.has_variables() || self.variables.contains(index))
            .map(|(_, variable)| &variable.name[..])
            .collect();
        let state = fleet.state_of(robot);
        let values = state.into_iter().flat_map(|state| program.values(state));
        let own = values.filter(|(name, _)| names.contains(name));
        let own = own.map(|(name, value)| (name.into(), value));
        let shared = self.shared.iter();
        let shared = shared.filter_map(|shared| {
            let value = shared.value(program, fleet, robot)?;
            Some((shared.name.clone(), value))
        });
        let finished = (self.finished).then(|| Value::Bool(fleet.has_finished(robot)));
        let finished = finished.map(|value| ("finished".into(), value));
        finished.into_iter().chain(own).chain(shared).collect()
    }
}

impl Shared {
    /// The shared variable that an import of a property reads.
    fn of(bytecode: &Bytecode, import: &Import) -> Option<Shared> {
        let member = import.name.strip_prefix("shared.")?;
        let kind = match import.results.first()? {
            Type::Optional(kind) => (**kind).clone(),
            Type::Object(index) => match bytecode.types.get(usize::from(*index))? {
                ObjectType::Map(_, kind) => kind.clone(),
                _ => return None,
            },
            _ => return None,
        };
        Some(Shared {
            name: import.labels.first()?.clone(),
            is_single_writer: member != "read",
            kind,
        })
    }

    fn value(&self, program: &Program, fleet: &dyn Fleet, robot: RobotId) -> Option<Value> {
        let memory = fleet.memory(robot)?;
        let kinds = core::slice::from_ref(&self.kind);
        let decode = |bytes: &[u8]| {
            let (scalars, objects) = program.decode(kinds, bytes)?;
            Value::read(program, &self.kind, &scalars, &objects)
        };
        if self.is_single_writer {
            let elements = memory.all(&self.name);
            let elements =
                elements.filter_map(|(owner, bytes)| Some((Value::Robot(owner), decode(bytes)?)));
            return Some(Value::Map(elements.collect()));
        }
        let candidates = crate::robot::primitives::candidates(memory, &self.name);
        let found = candidates.into_iter().flatten().find_map(decode);
        Some(found.unwrap_or(Value::None))
    }
}

/// The function that a claim evaluates first.
pub(super) fn first_function(claim: Claim) -> u32 {
    match claim {
        Claim::Always(holds)
        | Claim::Eventually { holds, .. }
        | Claim::EventuallyAlways { holds, .. } => holds,
        Claim::LeadsTo { cause, .. } => cause,
    }
}
