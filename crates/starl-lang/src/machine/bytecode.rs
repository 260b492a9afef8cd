//! Compiled programs as they are stored.

use crate::machine::host::Import;
use crate::machine::instruction::Instruction;
use crate::machine::types::{ObjectType, Type};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// A compiled program as the compiler writes it; nothing in it is trusted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bytecode {
    /// The program's name.
    pub name: String,
    /// All functions' instructions, one function after the other.
    pub code: Vec<Instruction>,
    /// The source positions of instructions: the first instruction of each run with one position, in ascending order.
    pub spans: Vec<(u32, Span)>,
    /// The source files, by the numbers that spans have; none of bytecode that was written by hand.
    pub files: Vec<SourceFile>,
    /// Scalar constants.
    pub constants: Vec<u64>,
    /// Constant texts.
    pub texts: Vec<String>,
    /// Enums.
    pub enums: Vec<Enum>,
    /// Types of objects; each refers to earlier ones only.
    pub types: Vec<ObjectType>,
    /// The imported functions of the host.
    pub imports: Vec<Import>,
    /// State variables; their layout is that of the [`State`](crate::machine::State).
    pub variables: Vec<Variable>,
    /// Functions, in the order of their code.
    pub functions: Vec<Function>,
    /// A procedure without arguments and results that gives parameters their default values. The
    /// host may then give them others, before the start.
    pub defaults: Option<u32>,
    /// A procedure without arguments and results that runs once: it gives variables their values and
    /// binds primitives, then runs the program's `init`.
    pub start: Option<u32>,
    /// Actions in the order of the text.
    pub actions: Vec<Action>,
    /// Handlers in the order of the text.
    pub handlers: Vec<Handler>,
    /// Primitives, in the order of their instance numbers.
    pub primitives: Vec<Binding>,
    /// Properties in the order of the text.
    pub properties: Vec<Property>,
    /// The models that primitives name.
    pub models: Vec<Model>,
}

impl Bytecode {
    /// The instructions of these functions and of all that they call, function by function.
    pub fn reachable(&self, functions: &[u32]) -> Vec<&Instruction> {
        let mut found = Vec::new();
        let mut seen = vec![false; self.functions.len()];
        let mut left = functions.to_vec();
        while let Some(number) = left.pop() {
            let index = number as usize;
            let (Some(function), Some(seen)) = (self.functions.get(index), seen.get_mut(index))
            else {
                continue;
            };
            if core::mem::replace(seen, true) {
                continue;
            }
            let code = self
                .code
                .get(function.entry as usize..function.end as usize);
            for instruction in code.unwrap_or_default() {
                if let Instruction::Call { function, .. } = instruction {
                    left.push(function.0);
                }
                found.push(instruction);
            }
        }
        found
    }
}

/// A model: the content of a file that a primitive names.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Model {
    /// Its path, as the program has it.
    pub path: String,
    /// An ONNX file.
    pub bytes: Vec<u8>,
}

/// A piece of a source file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Span {
    /// Which file: 0 is the program, others are what it imports.
    pub file: u32,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

/// A source file with the data for positions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourceFile {
    /// Its name, for instance `race.starl`.
    pub name: String,
    /// The byte at which each line begins, in ascending order.
    pub lines: Vec<u32>,
}

impl SourceFile {
    /// The line and the column of a byte, both from 1; the column counts bytes.
    pub fn line_and_column(&self, byte: u32) -> (u32, u32) {
        let line = self.lines.partition_point(|&start| start <= byte);
        let start = line.checked_sub(1).and_then(|line| self.lines.get(line));
        let column = byte - start.copied().unwrap_or(0);
        (line.max(1) as u32, column + 1)
    }
}

/// A variable of the state.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its type.
    pub kind: Type,
    /// Whether the host gives it a value before the start.
    pub parameter: Parameter,
    /// The values that the host may set; any value of its type if none.
    pub range: Option<Range>,
    /// Whether the host saves it if the robot has storage; the start requests the saved value.
    pub is_stable: bool,
}

/// The range of an Int, a Float or a Duration, as scalars; the end is exclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Range {
    /// The least.
    pub from: u64,
    /// The first beyond the greatest.
    pub before: u64,
}

/// Whether the host gives a variable its value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// It does not: the program does.
    #[default]
    No,
    /// It may; [`Bytecode::defaults`] gives it one.
    Optional,
    /// It must: there is no default.
    Required,
}

/// An enum.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Enum {
    /// Its name.
    pub name: String,
    /// The names of its variants; a variant's number is its place here.
    pub variants: Vec<String>,
}

/// The permissions of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FunctionKind {
    /// No state, no host: what is written `function`. May be called by all.
    Function,
    /// Reads the state and calls queries: the guard of an action. Its first result is a Bool, the
    /// others are the bindings, which are the arguments of the effect.
    Guard,
    /// Does anything: an effect, a handler, the start. May be called by procedures.
    Procedure,
    /// Reads states of robots that are its arguments, and calls queries; its result is a Bool.
    Property,
}

/// A function.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Its permissions.
    pub kind: FunctionKind,
    /// Its first instruction.
    pub entry: u32,
    /// The instruction after its last.
    pub end: u32,
    /// How many scalar registers it uses, at most 256.
    pub registers: u16,
    /// How many object registers it uses, at most 128.
    pub object_registers: u8,
    /// The types of its arguments, which are in its first registers when it begins.
    pub arguments: Vec<Type>,
    /// The types of its results, which are in its first registers when it ends.
    pub results: Vec<Type>,
}

/// A guarded action.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Action {
    /// Its name.
    pub name: String,
    /// Its guard.
    pub guard: u32,
    /// The procedure that it runs when the guard holds; its arguments are the guard's bindings.
    pub effect: u32,
    /// The primitives that it must have for itself while it runs: linearizable variables.
    pub atomic: Vec<u32>,
    /// Whether it is a check: its guard holds when the invariant is violated, and its effect restarts the program.
    /// Checks precede all other actions.
    pub is_check: bool,
    /// The time for which its guard must have held: a function like a guard whose results are a Bool and a Duration.
    pub hold: Option<u32>,
    /// The least time from one firing to the next, in the same way.
    pub every: Option<u32>,
}

impl Action {
    /// Whether it waits for a time.
    pub fn is_timed(&self) -> bool {
        self.hold.is_some() || self.every.is_some()
    }
}

/// A handler of an event. Arguments of its procedure: for a message the sender, a robot, and then the fields of the
/// message; for a primitive's event or an input its fields.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Handler {
    /// The name of the message, event or input.
    pub event: String,
    /// Its origin.
    pub origin: Origin,
    /// The procedure.
    pub function: u32,
}

/// The origin of an event.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// A robot sends a message.
    Message,
    /// This primitive reports it.
    Primitive(u32),
    /// An operator gives an order with these fields, in the order of the procedure's arguments.
    Input(Vec<String>),
}

/// A primitive bound to a name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Binding {
    /// The name in the program, for instance `mux`.
    pub name: String,
    /// The kind of primitive, for instance `Mutex`.
    pub kind: String,
}

/// A property.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Property {
    /// Its name.
    pub name: String,
    /// The claim.
    pub claim: Claim,
    /// For each robot (1), each pair of robots (2) and so on; 0 for a claim about the whole fleet.
    pub robots: u8,
    /// The assumption under which the property is judged: a function like those of the claim.
    pub assumption: Option<u32>,
    /// Nanoseconds for which it may be false after a fault has overwritten variables; none for the usual.
    pub recovery: Option<u64>,
    /// Whether robots that are down count too.
    pub is_despite_crashes: bool,
}

impl Property {
    /// Whether the verdict may change with time alone.
    pub(crate) fn is_timed(&self) -> bool {
        self.assumption.is_some() || matches!(self.claim, Claim::EventuallyAlways { .. })
    }
}

/// The claim of a property; numbers are functions of kind property.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// It holds at all times.
    Always(u32),
    /// It holds at some time, this many nanoseconds after the start at the latest.
    Eventually {
        /// The condition.
        holds: u32,
        /// Nanoseconds; none for without limit.
        within: Option<u64>,
    },
    /// It holds from some time on, this many nanoseconds after the start and after each fault at the latest.
    EventuallyAlways {
        /// The condition.
        holds: u32,
        /// Nanoseconds; none for without limit.
        within: Option<u64>,
    },
    /// Whenever the first holds, the second holds at some time afterwards, this many nanoseconds
    /// later at most.
    LeadsTo {
        /// The cause.
        cause: u32,
        /// The consequence.
        consequence: u32,
        /// Nanoseconds; none for without limit.
        within: Option<u64>,
    },
}
