//! The contents of registers at each instruction of a function, found by following all paths through it.
//!
//! A data-flow analysis as in the verifier of the Java virtual machine (Lindholm and Yellin 1996, section 4.9), with
//! fewer facts: whether a scalar register was written, and the type of the object in an object register. Where paths
//! meet, a register on which they differ counts as not written.
//!
//! Invariant: facts at an instruction only ever become fewer, so the analysis ends.

use crate::machine::bytecode::{Bytecode, Function, FunctionKind};
use crate::machine::error::LoadError;
use crate::machine::instruction::Instruction;
use crate::machine::interpreter::workspace::{OBJECT_WINDOW, WINDOW};
use crate::machine::operand::{FIRST_STATE_OPERAND, Use};
use crate::machine::types::Layout;
use crate::machine::verify::Tables;
use alloc::vec::Vec;
use core::ops::Range;

/// The type of an object register that was not written.
const UNWRITTEN: u16 = u16::MAX;

/// A rule that is broken.
pub(in crate::machine) type Broken = &'static str;

/// Where an instruction may lead.
pub(in crate::machine) struct Next {
    pub target: Option<u32>,
    pub falls_through: bool,
}

/// Checks of single instructions.
pub(in crate::machine) trait Rules {
    /// Checks an instruction of the function with this index, and learns from it.
    fn step(&mut self, function: usize, instruction: &Instruction) -> Result<Next, Broken>;
}

/// The facts about the registers before an instruction.
#[derive(Clone, PartialEq, Eq)]
pub(in crate::machine) struct Facts {
    scalars: [u64; WINDOW / 64],
    objects: [u16; OBJECT_WINDOW],
}

/// A function and its permissions.
pub(in crate::machine) struct Context<'a> {
    pub bytecode: &'a Bytecode,
    pub tables: &'a Tables,
    pub function: &'a Function,
    pub facts: Facts,
}

impl Facts {
    fn none() -> Facts {
        Facts {
            scalars: [0; WINDOW / 64],
            objects: [UNWRITTEN; OBJECT_WINDOW],
        }
    }

    /// Keeps what the other knows too; whether anything was lost.
    fn meet(&mut self, other: &Facts) -> bool {
        let before = self.clone();
        for (mine, theirs) in self.scalars.iter_mut().zip(&other.scalars) {
            *mine &= theirs;
        }
        for (mine, theirs) in self.objects.iter_mut().zip(&other.objects) {
            if mine != theirs {
                *mine = UNWRITTEN;
            }
        }
        *self != before
    }

    fn written(&self, register: usize) -> bool {
        self.scalars[register / 64] >> (register % 64) & 1 == 1
    }

    fn write(&mut self, register: usize) {
        self.scalars[register / 64] |= 1 << (register % 64);
    }

    fn forget_from(&mut self, register: usize, object: usize) {
        for lost in register..WINDOW {
            self.scalars[lost / 64] &= !(1 << (lost % 64));
        }
        self.objects[object.min(OBJECT_WINDOW)..].fill(UNWRITTEN);
    }
}

impl Context<'_> {
    /// Checks that this number of scalar registers exist and were written.
    pub fn reads(&self, first: u8, count: usize) -> Result<(), Broken> {
        let range = usize::from(first)..usize::from(first) + count;
        if range.end > usize::from(self.function.registers) {
            return Err("a register is beyond those that the function has");
        }
        if range.clone().all(|register| self.facts.written(register)) {
            Ok(())
        } else {
            Err("a register is read that may not have been written")
        }
    }

    /// Checks that this number of scalar registers exist, and marks them as written.
    pub fn writes(&mut self, first: u8, count: usize) -> Result<(), Broken> {
        let range = usize::from(first)..usize::from(first) + count;
        if range.end > usize::from(self.function.registers) {
            return Err("a register is beyond those that the function has");
        }
        range.for_each(|register| self.facts.write(register));
        Ok(())
    }

    /// The type of an object operand.
    pub fn object(&self, operand: u8) -> Result<u16, Broken> {
        if let Some(variable) = operand.checked_sub(FIRST_STATE_OPERAND) {
            return self.state_object(u32::from(variable));
        }
        if operand >= self.function.object_registers {
            return Err("an object register is beyond those that the function has");
        }
        match self.facts.objects[usize::from(operand)] {
            UNWRITTEN => Err("an object register is read that may not have been written"),
            kind => Ok(kind),
        }
    }

    /// The type of an object of the state, which this function may read.
    pub fn state_object(&self, variable: u32) -> Result<u16, Broken> {
        self.may_read_state()?;
        self.state_object_type(variable)
    }

    /// The type of an object of any robot's state.
    pub fn state_object_type(&self, variable: u32) -> Result<u16, Broken> {
        let objects = &self.tables.state.objects;
        let kind = objects.get(variable as usize);
        kind.copied().ok_or("there is no such object in the state")
    }

    /// Checks that an object operand may be changed in place; returns its type.
    pub fn changed(&self, operand: u8) -> Result<u16, Broken> {
        if operand >= FIRST_STATE_OPERAND {
            self.may_write_state()?;
        }
        self.object(operand)
    }

    /// An object operand is written, with an object of this type.
    pub fn write_object(&mut self, operand: u8, kind: u16) -> Result<(), Broken> {
        if operand >= FIRST_STATE_OPERAND {
            self.may_write_state()?;
            return match self.object(operand)? == kind {
                true => Ok(()),
                false => Err("a state variable is written with an object of another type"),
            };
        }
        if operand >= self.function.object_registers {
            return Err("an object register is beyond those that the function has");
        }
        self.facts.objects[usize::from(operand)] = kind;
        Ok(())
    }

    pub fn may_read_state(&self) -> Result<(), Broken> {
        match self.function.kind {
            FunctionKind::Guard | FunctionKind::Procedure => Ok(()),
            _ => Err("the function may not read the state"),
        }
    }

    pub fn may_write_state(&self) -> Result<(), Broken> {
        match self.function.kind {
            FunctionKind::Procedure => Ok(()),
            _ => Err("the function may not change the state"),
        }
    }

    /// A block of this layout is there.
    pub fn reads_block(&self, scalars: u8, objects: u8, layout: &Layout) -> Result<(), Broken> {
        self.reads(scalars, layout.scalars.len())?;
        let held = &self.facts.objects[self.object_range(objects, layout)?];
        match held == layout.objects {
            true => Ok(()),
            false => Err("an object register does not hold the type that is needed"),
        }
    }

    /// The object registers of a block, which must be there.
    fn object_range(&self, first: u8, layout: &Layout) -> Result<Range<usize>, Broken> {
        let range = usize::from(first)..usize::from(first) + layout.objects.len();
        match range.end <= usize::from(self.function.object_registers) {
            true => Ok(range),
            false => Err("an object register is beyond those that the function has"),
        }
    }

    /// A block of this layout is written.
    pub fn writes_block(
        &mut self,
        scalars: u8,
        objects: u8,
        layout: &Layout,
    ) -> Result<(), Broken> {
        self.writes(scalars, layout.scalars.len())?;
        let range = self.object_range(objects, layout)?;
        self.facts.objects[range].copy_from_slice(&layout.objects);
        Ok(())
    }

    /// A call whose windows begin here takes and returns these values; other registers are lost.
    pub fn calls(
        &mut self,
        scalars: u8,
        objects: u8,
        arguments: &Layout,
        results: &Layout,
    ) -> Result<(), Broken> {
        self.reads_block(scalars, objects, arguments)?;
        self.facts
            .forget_from(usize::from(scalars), usize::from(objects));
        self.writes_block(scalars, objects, results)
    }
}

/// Checks the code of one function.
pub(in crate::machine) fn check(
    bytecode: &Bytecode,
    tables: &Tables,
    function: &Function,
) -> Result<(), LoadError> {
    let code = &bytecode.code[function.entry as usize..function.end as usize];
    let mut known: Vec<Option<Facts>> = Vec::new();
    known.resize_with(code.len(), || None);
    let index = bytecode
        .functions
        .partition_point(|f| f.entry < function.entry);
    let mut context = Context {
        bytecode,
        tables,
        function,
        facts: Facts::none(),
    };
    let begun = context.writes_block(0, 0, &tables.arguments[index]);
    begun.map_err(crate::machine::verify::invalid)?;

    let joins = joins(code, function);
    let mut open: Vec<(usize, Facts)> = Vec::from([(0, context.facts.clone())]);
    while let Some((start, facts)) = open.pop() {
        let mut at = start;
        context.facts = facts;
        loop {
            let broken = |reason| LoadError::Invalid {
                position: Some(function.entry + at as u32),
                reason,
            };
            let Some(instruction) = code.get(at) else {
                at = code.len() - 1;
                return Err(LoadError::Invalid {
                    position: Some(function.entry + at as u32),
                    reason: "the function continues past its end",
                });
            };
            // Facts are kept where ways meet.
            if joins[at] {
                let fewer = match &mut known[at] {
                    Some(known) => known.meet(&context.facts),
                    none => {
                        *none = Some(context.facts.clone());
                        true
                    }
                };
                if !fewer {
                    break;
                }
                if let Some(known) = &known[at] {
                    context.facts = known.clone();
                }
            }
            let next = context.step(index, instruction).map_err(broken)?;
            if let Some(target) = next.target {
                let place = (target as usize).wrapping_sub(function.entry as usize);
                if place >= code.len() {
                    return Err(broken("a jump leaves the function"));
                }
                open.push((place, context.facts.clone()));
            }
            if !next.falls_through {
                break;
            }
            at += 1;
        }
    }
    Ok(())
}

/// The instructions that can be come to in more than one way.
fn joins(code: &[Instruction], function: &Function) -> Vec<bool> {
    let mut joins = alloc::vec![false; code.len()];
    if let Some(first) = joins.first_mut() {
        *first = true;
    }
    for instruction in code {
        instruction.uses(&mut |used| {
            if let Use::JumpsTo(target) = used
                && let Some(join) =
                    joins.get_mut((target as usize).wrapping_sub(function.entry as usize))
            {
                *join = true;
            }
        });
    }
    joins
}
