//! The meanings of all names in the files, for editors.
//!
//! The checker records each name when it resolves it, so that no name is resolved again for the editor. If it resolves
//! a name twice, there are two records. Names in a part with errors are recorded if they are known.

use super::scope::Entity;
use super::tables::{Builtin, Event, Member, Method, PRIMITIVES, Primitive};
use crate::ir::{
    BindingId, ConstantId, EnumId, FunctionId, ParameterId, RecordId, SharedId, Site, Type,
    VariableId,
};

/// The meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symbol {
    /// An enum.
    Enum(EnumId),
    /// A variant of an enum, by its number. Roles are variants too.
    Variant(EnumId, u16),
    /// A record or a message.
    Record(RecordId),
    /// A field of a record or a message, by its number.
    Field(RecordId, u32),
    /// A parameter of the program.
    Parameter(ParameterId),
    /// A constant.
    Constant(ConstantId),
    /// A state variable.
    Variable(VariableId),
    /// A shared variable.
    Shared(SharedId),
    /// A bound primitive.
    Binding(BindingId),
    /// A function.
    Function(FunctionId),
    /// A local or a parameter of a function, by the place of its name.
    Local(Site),
    /// An action, by its number.
    Action(u32),
    /// A property, by its number.
    Property(u32),
    /// An input, by the number of its first handler.
    Input(u32),
    /// The program or a library, by the number of its file.
    File(u32),
    /// A built-in function or name.
    Builtin(Builtin),
    /// A built-in type.
    Type(&'static str),
    /// A method of a built-in type.
    Method(Method),
    /// A kind of primitive, by its number in [`PRIMITIVES`].
    Primitive(usize),
    /// A method or flag of a kind of primitive, by their numbers.
    Member(usize, usize),
    /// Something that a kind of primitive reports, by their numbers.
    Event(usize, usize),
    /// `x`, `y` or `z` of a point.
    Coordinate(&'static str),
    /// An attribute that properties may read of every robot.
    RobotMember(&'static str),
    /// The parameter of something that is built in, where an argument is given by its name: the
    /// signature as text, and the name.
    Argument(&'static str, &'static str),
}

impl Symbol {
    /// The kind of primitive.
    pub(super) fn primitive(primitive: &'static Primitive) -> Option<Self> {
        number_of(primitive).map(Self::Primitive)
    }

    /// The method or flag of a kind of primitive.
    pub(super) fn member(primitive: &'static Primitive, member: &Member) -> Option<Self> {
        let mut members = primitive.members.iter();
        let number = members.position(|other| other.name() == member.name());
        Some(Self::Member(number_of(primitive)?, number?))
    }

    /// An event of a kind of primitive.
    pub(super) fn event(primitive: &'static Primitive, event: &Event) -> Option<Self> {
        let mut events = primitive.events.iter();
        let number = events.position(|other| other.name() == event.name());
        Some(Self::Event(number_of(primitive)?, number?))
    }
}

fn number_of(primitive: &Primitive) -> Option<usize> {
    PRIMITIVES
        .iter()
        .position(|other| other.name() == primitive.name())
}

/// The names of all files with their meanings.
#[derive(Clone, Debug, Default)]
pub struct Resolutions {
    /// Names that are used, in the order in which they were looked at.
    pub uses: alloc::vec::Vec<(Site, Symbol)>,
    /// Locals and parameters of functions where they are declared, with their types.
    pub locals: alloc::vec::Vec<(Site, Type)>,
}

impl Entity {
    /// The symbol of this entity for editors.
    pub fn symbol(self) -> Option<Symbol> {
        Some(match self {
            Self::Enum(id) => Symbol::Enum(id),
            Self::Record(id) => Symbol::Record(id),
            Self::Parameter(id) => Symbol::Parameter(id),
            Self::Constant(id) => Symbol::Constant(id),
            Self::Variable(id) => Symbol::Variable(id),
            Self::Shared(id) => Symbol::Shared(id),
            Self::Binding(id) => Symbol::Binding(id),
            Self::Function(id) => Symbol::Function(id),
            Self::Library(file) => Symbol::File(file),
            Self::Broken => return None,
        })
    }
}
