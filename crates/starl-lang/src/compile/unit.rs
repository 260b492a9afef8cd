//! The shared parts of a compiled program: its tables and its list of functions.
//!
//! A function gets its number at its first use and is compiled later, so that unused functions are left out.

use alloc::boxed::Box;
use alloc::collections::{BTreeMap, VecDeque};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::code::Code;
use super::constant::folded;
use super::problem::{Compiled, Problem};
use super::size::Size;
use super::types::{Types, Unsuitable};
use crate::diagnostic::{self, Span};
use crate::ir::{self, ConstantId, FunctionId, ParameterId, Program, VariableId};
use crate::machine::{FunctionKind, Import, Type};

/// A function that others call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Routine {
    /// One of the program.
    Function(FunctionId),
    /// Computes the value of a constant.
    Constant(ConstantId),
    /// The program's `init`.
    Init,
    /// Runs on entering the robot's current role.
    Enter,
    /// Runs on entering the role with this number.
    EnterRole(u16),
}

/// A function whose code is complete.
pub(super) struct Finished {
    pub name: String,
    pub kind: FunctionKind,
    pub code: Code,
    /// The registers that it uses.
    pub used: Size,
    pub arguments: Vec<Type>,
    pub results: Vec<Type>,
}

/// The tables of a program that is being compiled.
pub(super) struct Unit<'p> {
    pub program: &'p Program,
    pub types: Types<'p>,
    /// The values of constants that are known scalars.
    pub known: Vec<Option<u64>>,
    /// Where variables lie in the state.
    variables: Vec<Size>,
    /// Where parameters lie in the state.
    parameters: Vec<Size>,
    pub constants: Vec<u64>,
    constant_numbers: BTreeMap<u64, u32>,
    pub texts: Vec<String>,
    text_numbers: BTreeMap<String, u32>,
    pub imports: Vec<Import>,
    /// Functions by their numbers; none of one that is not complete.
    pub functions: Vec<Option<Finished>>,
    routines: BTreeMap<Routine, u32>,
    queue: VecDeque<(Routine, u32)>,
    pub problems: Vec<Problem>,
}

impl<'p> Unit<'p> {
    pub fn new(program: &'p Program) -> Self {
        let types = Types::new(program);
        let mut next = Size::NONE;
        let mut place = |ty: &ir::Type| {
            let start = next;
            next = next.plus(types.size(ty));
            start
        };
        let variables = program.variables.iter().map(|v| place(&v.ty)).collect();
        let parameters = program.parameters.iter().map(|p| place(&p.ty)).collect();
        let mut unit = Self {
            program,
            types,
            known: alloc::vec![None; program.constants.len()],
            variables,
            parameters,
            constants: Vec::new(),
            constant_numbers: BTreeMap::new(),
            texts: Vec::new(),
            text_numbers: BTreeMap::new(),
            imports: Vec::new(),
            functions: Vec::new(),
            routines: BTreeMap::new(),
            queue: VecDeque::new(),
            problems: Vec::new(),
        };
        for id in &program.constant_order {
            unit.known[id.index()] = folded(&unit.known, &program[*id].value);
        }
        unit
    }

    /// Where a variable begins in the state.
    pub fn variable(&self, id: VariableId) -> Size {
        self.variables[id.index()]
    }

    /// Where a parameter begins in the state.
    pub fn parameter(&self, id: ParameterId) -> Size {
        self.parameters[id.index()]
    }

    /// The number of a scalar constant.
    pub fn constant(&mut self, bits: u64) -> u32 {
        let next = self.constants.len() as u32;
        let number = *self.constant_numbers.entry(bits).or_insert(next);
        if number == next {
            self.constants.push(bits);
        }
        number
    }

    /// The number of a constant text.
    pub fn text(&mut self, text: &str) -> u32 {
        if let Some(known) = self.text_numbers.get(text) {
            return *known;
        }
        let number = self.texts.len() as u32;
        self.texts.push(text.into());
        self.text_numbers.insert(text.into(), number);
        number
    }

    /// The number of an import.
    pub fn import(&mut self, import: Import) -> u32 {
        if let Some(known) = self.imports.iter().position(|known| *known == import) {
            return known as u32;
        }
        self.imports.push(import);
        (self.imports.len() - 1) as u32
    }

    /// The number of a routine, which will be compiled.
    pub fn routine(&mut self, routine: Routine) -> u32 {
        if let Some(known) = self.routines.get(&routine) {
            return *known;
        }
        let number = self.reserve();
        self.routines.insert(routine, number);
        self.queue.push_back((routine, number));
        number
    }

    /// The next routine to compile, and its number.
    pub fn next_routine(&mut self) -> Option<(Routine, u32)> {
        self.queue.pop_front()
    }

    /// A number for a function.
    pub fn reserve(&mut self) -> u32 {
        self.functions.push(None);
        (self.functions.len() - 1) as u32
    }

    /// Stores a function under its number, or the reason why there is none.
    pub fn define(&mut self, number: u32, function: Compiled<Finished>) {
        match function {
            Ok(function) => self.functions[number as usize] = Some(function),
            Err(problem) => self.problems.push(*problem),
        }
    }

    /// The machine's type of a type that is used at a place.
    pub fn machine_type(&mut self, of: &ir::Type, file: u32, span: Span) -> Compiled<Type> {
        let made = self.types.of(of);
        made.map_err(|why| self.unsuitable(of, why, file, span))
    }

    /// The problem that the machine does not take a type.
    pub fn unsuitable(
        &self,
        of: &ir::Type,
        why: Unsuitable,
        file: u32,
        span: Span,
    ) -> Box<Problem> {
        let name = self.program.type_name(of);
        let values = match name.len() {
            0..=60 => format!("values of {name}"),
            _ => "values of this type".into(),
        };
        match why {
            Unsuitable::Depth => {
                let message = format!("{values} are nested too deeply");
                Problem::new(diagnostic::Code::NestedTooDeep, file, span, message)
                    .note("records, optionals and collections can be nested 32 deep")
            }
            Unsuitable::Number => {
                let message = "the program has too many types";
                Problem::new(diagnostic::Code::TooMuch, file, span, message)
                    .note("there can be 65534 kinds of collections and as many enums")
            }
            Unsuitable::Width => {
                let message = format!("{values} have too many parts");
                Problem::new(diagnostic::Code::TooManyRegisters, file, span, message).note(
                    "a value, or a key with its value, has at most 255 numbers and 127 texts and collections",
                )
            }
        }
    }
}
