//! A program that can be run: bytecode that was verified and joined to a host.

use crate::machine::bytecode::{Bytecode, Function, Span};
use crate::machine::host::Signature;
use crate::machine::operand;
use crate::machine::types::{Layout, Parts};
use crate::machine::value::object::Object;
use crate::machine::value::state::State;
use alloc::string::String;
use alloc::vec::Vec;

/// The results of a function.
#[derive(Clone, Debug)]
pub(in crate::machine) struct Known {
    pub scalars: Vec<u64>,
    pub objects: Vec<Object>,
    /// The size of the objects as if nothing were shared, bytes.
    pub bytes: usize,
}

/// A program that can be run: verified bytecode whose imports are resolved. Shared by all robots that
/// run it.
#[derive(Clone, Debug)]
pub struct Program {
    pub(in crate::machine) bytecode: Bytecode,
    /// The first instruction of each function.
    pub(in crate::machine) entries: Vec<u32>,
    /// The most object registers that a function has: all beyond them are empty.
    pub(in crate::machine) object_registers: usize,
    /// The layouts of each function's arguments and results.
    pub(in crate::machine) layouts: Vec<(Layout, Layout)>,
    pub(in crate::machine) parts: Vec<Parts>,
    pub(in crate::machine) texts: Vec<Object>,
    pub(in crate::machine) signatures: Vec<Signature>,
    /// The results of functions that always return the same value.
    pub(in crate::machine) known: Vec<Option<Known>>,
    pub(in crate::machine) state: Layout,
}

impl Program {
    /// The bytecode that was verified.
    pub fn bytecode(&self) -> &Bytecode {
        &self.bytecode
    }

    /// The layout of the state.
    pub fn state_layout(&self) -> &Layout {
        &self.state
    }

    /// The layouts of the parts of an object type.
    #[inline]
    pub(in crate::machine) fn parts_of(&self, kind: operand::Type) -> Option<&Parts> {
        self.parts.get(usize::from(kind.0))
    }

    /// The layouts of the parts of each object type.
    pub fn parts(&self) -> &[Parts] {
        &self.parts
    }

    /// A state in which all variables are zero, empty and none; the start gives them their values.
    pub fn new_state(&self) -> State {
        State::new(&self.state)
    }

    /// The source position of an instruction.
    pub fn span(&self, position: u32) -> Option<Span> {
        let spans = &self.bytecode.spans;
        let after = spans.partition_point(|(first, _)| *first <= position);
        Some(spans.get(after.checked_sub(1)?)?.1)
    }

    /// The source position of an instruction as text: `race.starl:12:5`.
    pub fn source(&self, position: u32) -> Option<String> {
        let span = self.span(position)?;
        let file = self.bytecode.files.get(span.file as usize)?;
        let (line, column) = file.line_and_column(span.start);
        Some(alloc::format!("{}:{line}:{column}", file.name))
    }

    /// The function that an instruction belongs to.
    pub fn function_at(&self, position: u32) -> Option<&Function> {
        let after = self.entries.partition_point(|&entry| entry <= position);
        self.bytecode.functions.get(after.checked_sub(1)?)
    }
}
