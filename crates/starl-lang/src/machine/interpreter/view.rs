//! The context of an instruction on objects: the windows of the running function, the state's objects and the host. It
//! also meters memory.
//!
//! Memory is counted as if no value were shared, so that a program's limits do not depend on other holders of its
//! values. A full count after every instruction would be slow: the meter adds up growth until the sum could exceed the
//! budget, and only then counts all values.

use crate::machine::error::Fault;
use crate::machine::host::Host;
use crate::machine::interpreter::workspace::{OBJECT_WINDOW, Registers};
use crate::machine::operand::{
    self, FIRST_STATE_OPERAND, In, ObjectIn, ObjectInOut, ObjectOut, Type,
};
use crate::machine::program::Program;
use crate::machine::types::{Layout, Parts};
use crate::machine::value::object::{Block, Object};

/// The memory that an activation may use.
#[derive(Clone, Copy, Debug)]
pub(in crate::machine) struct Meter {
    /// Instructions that are left.
    pub fuel: u64,
    /// Bytes that the state and all values in registers may have together.
    pub budget: usize,
    /// Bytes that may be added before they have to be summed up.
    pub spare: usize,
}

/// The parts of the machine that an instruction on objects works on.
pub(in crate::machine) struct View<'a> {
    pub program: &'a Program,
    pub registers: &'a mut Registers,
    /// The object registers of all running functions.
    pub objects: &'a mut [Object],
    /// Where those of the function begin that runs now.
    pub object_base: usize,
    pub state: &'a mut [Object],
    pub host: &'a mut dyn Host,
    pub meter: &'a mut Meter,
}

/// The cost of copying or moving this many bytes.
pub(in crate::machine) fn shift(bytes: usize) -> u64 {
    (bytes / 64) as u64
}

/// Writes scalars to registers from this one on.
#[inline]
pub(in crate::machine) fn write_scalars(
    registers: &mut Registers,
    first: usize,
    scalars: &[u64],
) -> Result<(), Fault> {
    let place = registers.get_mut(first..first + scalars.len());
    place.ok_or(Fault::Malformed)?.copy_from_slice(scalars);
    Ok(())
}

/// The object that an operand names.
#[inline]
pub(in crate::machine) fn object_at<'a>(
    objects: &'a [Object],
    base: usize,
    state: &'a [Object],
    operand: u8,
) -> Result<&'a Object, Fault> {
    let place = match operand.checked_sub(FIRST_STATE_OPERAND) {
        Some(variable) => state.get(usize::from(variable)),
        None => objects.get(base + usize::from(operand)),
    };
    place.ok_or(Fault::Malformed)
}

/// The place of the object that an operand names.
#[inline]
pub(in crate::machine) fn object_at_mut<'a>(
    objects: &'a mut [Object],
    base: usize,
    state: &'a mut [Object],
    operand: u8,
) -> Result<&'a mut Object, Fault> {
    let place = match operand.checked_sub(FIRST_STATE_OPERAND) {
        Some(variable) => state.get_mut(usize::from(variable)),
        None => objects.get_mut(base + usize::from(operand)),
    };
    place.ok_or(Fault::Malformed)
}

impl<'a> View<'a> {
    pub fn scalar(&self, register: In) -> u64 {
        self.registers[register.place()]
    }

    pub fn set_bool(&mut self, to: operand::Out, value: bool) {
        self.registers[to.place()] = u64::from(value);
    }

    /// The object that an operand names.
    pub fn read(&self, operand: ObjectIn) -> Result<&Object, Fault> {
        object_at(self.objects, self.object_base, self.state, operand.0)
    }

    /// The place of the object that an operand names.
    pub fn place(&mut self, operand: u8) -> Result<&mut Object, Fault> {
        object_at_mut(self.objects, self.object_base, self.state, operand)
    }

    /// Puts a new or shared object into a place and counts its memory.
    pub fn put(&mut self, to: ObjectOut, object: Object) -> Result<u64, Fault> {
        let bytes = object.bytes();
        *self.place(to.0)? = object;
        self.allocate(bytes)
    }

    /// As [`View::put`], for an object that others hold too.
    pub fn share(&mut self, to: ObjectOut, object: Object) -> Result<u64, Fault> {
        let cost = shift(object.bytes());
        Ok(cost + self.put(to, object)?)
    }

    /// Changes an object in place and counts the memory that it grows by. The change returns its cost.
    pub fn change(
        &mut self,
        operand: ObjectInOut,
        change: impl FnOnce(&mut Object, &View<'a>) -> Result<u64, Fault>,
    ) -> Result<u64, Fault> {
        // The object is taken out of its place while it is changed, so that it has no second holder.
        let mut object = core::mem::take(self.place(operand.0)?);
        let before = object.bytes();
        let result = change(&mut object, self);
        let grown = object.bytes().saturating_sub(before);
        *self.place(operand.0)? = object;
        let cost = result?;
        Ok(cost + self.allocate(grown)?)
    }

    /// The layouts of a type's parts.
    pub fn parts(&self, kind: Type) -> Result<&'a Parts, Fault> {
        self.program.parts_of(kind).ok_or(Fault::Malformed)
    }

    /// The registers of a value of this layout.
    pub fn block(
        &self,
        scalars: operand::Block,
        objects: operand::ObjectBlock,
        layout: &Layout,
    ) -> Result<Block<'_>, Fault> {
        self.block_of(scalars, layout.scalars.len(), objects, layout.objects.len())
    }

    /// The registers of a value with this number of scalars and objects.
    pub fn block_of(
        &self,
        scalars: operand::Block,
        width: usize,
        objects: operand::ObjectBlock,
        object_width: usize,
    ) -> Result<Block<'_>, Fault> {
        let (start, object_start) = (scalars.place(), self.object_base + objects.place());
        let scalars = self.registers.get(start..start + width);
        let objects = self.objects.get(object_start..object_start + object_width);
        match (scalars, objects) {
            (Some(scalars), Some(objects)) => Ok(Block { scalars, objects }),
            _ => Err(Fault::Malformed),
        }
    }

    /// Counts memory that is added; gives what the counting costs.
    pub fn allocate(&mut self, bytes: usize) -> Result<u64, Fault> {
        match self.meter.spare.checked_sub(bytes) {
            Some(rest) => {
                self.meter.spare = rest;
                Ok(0)
            }
            None => self.count_afresh(),
        }
    }

    #[cold]
    fn count_afresh(&mut self) -> Result<u64, Fault> {
        let end = (self.object_base + OBJECT_WINDOW).min(self.objects.len());
        // The rest of the window is empty.
        let used = (self.object_base + self.program.object_registers).min(end);
        let running = self.objects.get(..used).unwrap_or_default();
        let all = running.iter().chain(self.state.iter());
        let bytes: usize = all.map(Object::bytes).sum();
        match self.meter.budget.checked_sub(bytes) {
            Some(spare) => {
                self.meter.spare = spare;
                Ok((end + self.state.len()) as u64 / 8)
            }
            None => Err(Fault::OutOfMemory {
                budget: self.meter.budget as u64,
            }),
        }
    }
}
