//! The verifier's conditions for each instruction, and the facts that hold after it.
//!
//! The rules for scalars and jumps follow from the operands' types. The rules that depend on the types of values are
//! here, instruction by instruction.

use crate::machine::bytecode::FunctionKind;
use crate::machine::instruction::Instruction;
use crate::machine::operand::Use;
use crate::machine::types::{ObjectType, Parts};
use crate::machine::verify::flow::{Broken, Context, Next, Rules};

pub(super) const WRONG_TYPE: Broken = "an object is not of the type that the instruction works on";
const NO_TYPE: Broken = "there is no such type";

impl Rules for Context<'_> {
    fn step(&mut self, function: usize, instruction: &Instruction) -> Result<Next, Broken> {
        let mut next = Next {
            target: None,
            falls_through: true,
        };
        // All reads come before all writes.
        let mut read = Ok(());
        instruction.uses(&mut |used| {
            let result = match used {
                Use::Reads(first, count) => self.reads(first, usize::from(count)),
                Use::Changes(register) => self.reads(register, 1),
                Use::ReadsObject(operand) => self.object(operand).map(|_| ()),
                Use::ChangesObject(operand) => self.changed(operand).map(|_| ()),
                Use::JumpsTo(target) => {
                    next.target = Some(target);
                    Ok(())
                }
                Use::Writes(..) | Use::WritesObject(_) | Use::Number => Ok(()),
            };
            if read.is_ok() {
                read = result;
            }
        });
        read?;
        self.particular(function, instruction, &mut next)?;
        let mut written = Ok(());
        instruction.uses(&mut |used| {
            if let Use::Writes(first, count) = used {
                let result = self.writes(first, usize::from(count));
                if written.is_ok() {
                    written = result;
                }
            }
        });
        written?;
        Ok(next)
    }
}

impl Context<'_> {
    fn particular(
        &mut self,
        function: usize,
        instruction: &Instruction,
        next: &mut Next,
    ) -> Result<(), Broken> {
        use Instruction::*;
        match *instruction {
            Jump { .. } => next.falls_through = false,
            CopyBlock { to, from, count } => {
                self.reads(from.0, usize::from(count.0))?;
                self.writes(to.0, usize::from(count.0))?;
            }
            Constant { constant, .. } => {
                let constants = &self.bytecode.constants;
                exists(
                    constants.get(constant.0 as usize),
                    "there is no such constant",
                )?;
            }
            Load { variable, .. } => self.state_scalars(variable.0, 1)?,
            LoadPoint { variable, .. } => self.state_scalars(variable.0, 3)?,
            JumpIfStateNot { variable, .. } => self.state_scalars(variable.0.into(), 1)?,
            Store { variable, .. } => {
                self.may_write_state()?;
                self.state_scalars(variable.0, 1)?;
            }
            StorePoint { variable, .. } => {
                self.may_write_state()?;
                self.state_scalars(variable.0, 3)?;
            }
            LoadOther { variable, .. } => self.other_scalars(variable.0, 1)?,
            LoadOtherPoint { variable, .. } => self.other_scalars(variable.0, 3)?,
            LoadOtherObject { to, variable, .. } => {
                self.is_property()?;
                let kind = self.state_object_type(variable.0)?;
                self.write_object(to.0, kind)?;
            }
            Call {
                scalars,
                objects,
                function,
            } => self.call(scalars.0, objects.0, function.0)?,
            CallHost {
                scalars,
                objects,
                import,
            } => self.call_host(scalars.0, objects.0, import.0)?,
            Return { keep, until } => {
                let results = &self.tables.results[function];
                self.reads_block(0, 0, results)?;
                self.leaves(until.0, next)?;
                if usize::from(keep.0) != results.objects.len() {
                    return Err("a return keeps more or fewer objects than there are results");
                }
            }
            ReturnScalar { until, .. } => {
                let results = &self.tables.results[function];
                if results.scalars.len() != 1 || !results.objects.is_empty() {
                    return Err("the function's result is not one scalar");
                }
                self.leaves(until.0, next)?;
            }
            ReturnFalse { until } => {
                if self.function.kind != FunctionKind::Guard {
                    return Err("only guards may return false without their bindings");
                }
                self.leaves(until.0, next)?;
            }
            _ => return self.particular_to_objects(instruction),
        }
        Ok(())
    }

    fn state_scalars(&self, first: u32, count: u32) -> Result<(), Broken> {
        self.may_read_state()?;
        self.scalars_exist(first, count)
    }

    fn other_scalars(&self, first: u32, count: u32) -> Result<(), Broken> {
        self.is_property()?;
        self.scalars_exist(first, count)
    }

    fn scalars_exist(&self, first: u32, count: u32) -> Result<(), Broken> {
        let end = first.checked_add(count);
        match end.is_some_and(|end| end as usize <= self.tables.state.scalars.len()) {
            true => Ok(()),
            false => Err("there is no such scalar in the state"),
        }
    }

    fn is_property(&self) -> Result<(), Broken> {
        match self.function.kind {
            FunctionKind::Property => Ok(()),
            _ => Err("only properties may read the states of other robots"),
        }
    }

    fn leaves(&self, until: u8, next: &mut Next) -> Result<(), Broken> {
        next.falls_through = false;
        match until == self.function.object_registers {
            true => Ok(()),
            false => Err("a return does not empty the function's object registers"),
        }
    }

    fn call(&mut self, scalars: u8, objects: u8, index: u32) -> Result<(), Broken> {
        let index = index as usize;
        let callee = self.bytecode.functions.get(index);
        let callee = callee.ok_or("there is no such function")?;
        let allowed = match callee.kind {
            FunctionKind::Function => true,
            FunctionKind::Procedure => self.function.kind == FunctionKind::Procedure,
            FunctionKind::Guard | FunctionKind::Property => false,
        };
        if !allowed {
            return Err("the function may not call a function of that kind");
        }
        let tables = self.tables;
        self.calls(
            scalars,
            objects,
            &tables.arguments[index],
            &tables.results[index],
        )
    }

    fn call_host(&mut self, scalars: u8, objects: u8, index: u32) -> Result<(), Broken> {
        let index = index as usize;
        let import = self.bytecode.imports.get(index);
        let import = import.ok_or("there is no such import")?;
        let allowed = match self.function.kind {
            FunctionKind::Function => false,
            FunctionKind::Guard | FunctionKind::Property => import.query,
            FunctionKind::Procedure => true,
        };
        if !allowed {
            return Err("the function may not call this import");
        }
        let (arguments, results) = &self.tables.imports[index];
        // The host's window is as wide as the wider of the two.
        let width = arguments.scalars.len().max(results.scalars.len());
        let object_width = arguments.objects.len().max(results.objects.len());
        if usize::from(scalars) + width > usize::from(self.function.registers)
            || usize::from(objects) + object_width > usize::from(self.function.object_registers)
        {
            return Err("a register is beyond those that the function has");
        }
        self.calls(scalars, objects, arguments, results)
    }
}

impl<'a> Context<'a> {
    pub fn kind(&self, index: u16) -> Result<&'a ObjectType, Broken> {
        self.bytecode.types.get(usize::from(index)).ok_or(NO_TYPE)
    }

    pub fn parts(&self, index: u16) -> Result<&'a Parts, Broken> {
        self.tables.parts.get(usize::from(index)).ok_or(NO_TYPE)
    }

    pub fn list_parts(&self, index: u16) -> Result<&'a Parts, Broken> {
        match self.kind(index)? {
            ObjectType::List(_) => self.parts(index),
            _ => Err(WRONG_TYPE),
        }
    }

    pub fn set_parts(&self, index: u16) -> Result<&'a Parts, Broken> {
        match self.kind(index)? {
            ObjectType::Set(_) => self.parts(index),
            _ => Err(WRONG_TYPE),
        }
    }

    pub fn map_parts(&self, operand: u8, index: u16) -> Result<&'a Parts, Broken> {
        same(self.object(operand)?, index)?;
        match self.kind(index)? {
            ObjectType::Map(..) => self.parts(index),
            _ => Err(WRONG_TYPE),
        }
    }

    /// An operand is an object of this type.
    pub fn is(&self, operand: u8, object: &ObjectType) -> Result<(), Broken> {
        match self.kind(self.object(operand)?)? == object {
            true => Ok(()),
            false => Err(WRONG_TYPE),
        }
    }

    pub fn alike(&self, left: &Parts, right: &Parts) -> Result<(), Broken> {
        match left == right {
            true => Ok(()),
            false => Err(WRONG_TYPE),
        }
    }

    /// The index of a type that is there once, such as the text.
    pub fn find(&self, object: &ObjectType) -> Result<u16, Broken> {
        let index = self.bytecode.types.iter().position(|kind| kind == object);
        index.map(|index| index as u16).ok_or(NO_TYPE)
    }
}

pub(super) fn same(left: u16, right: u16) -> Result<(), Broken> {
    if left == right {
        Ok(())
    } else {
        Err(WRONG_TYPE)
    }
}

pub(super) fn exists<T>(found: Option<T>, reason: Broken) -> Result<(), Broken> {
    found.map(|_| ()).ok_or(reason)
}
