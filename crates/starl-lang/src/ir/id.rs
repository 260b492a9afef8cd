//! The numbers by which parts of a program refer to declarations.

use core::ops::{Index, IndexMut};

use super::{Binding, Constant, Enum, Function, Parameter, Program, Record, Shared, Variable};

macro_rules! ids {
    ($($(#[$doc:meta])+ $name:ident: $table:ident[$entry:ident],)+) => {$(
        $(#[$doc])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The number as an index into the program's table.
            #[must_use]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl Index<$name> for Program {
            type Output = $entry;

            fn index(&self, id: $name) -> &$entry {
                &self.$table[id.index()]
            }
        }

        impl IndexMut<$name> for Program {
            fn index_mut(&mut self, id: $name) -> &mut $entry {
                &mut self.$table[id.index()]
            }
        }
    )+};
}

ids! {
    /// An enum.
    EnumId: enums[Enum],
    /// A record or a message.
    RecordId: records[Record],
    /// A parameter.
    ParameterId: parameters[Parameter],
    /// A constant.
    ConstantId: constants[Constant],
    /// A state variable.
    VariableId: variables[Variable],
    /// A shared variable.
    SharedId: shared[Shared],
    /// A bound primitive.
    BindingId: bindings[Binding],
    /// A function.
    FunctionId: functions[Function],
}

/// A local variable, by its place among those of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LocalId(pub u32);

impl LocalId {
    /// The number as an index into the body's locals.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}
