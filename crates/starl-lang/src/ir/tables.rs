//! The declarations of a program, by their numbers.

use core::ops::{Index, IndexMut};

use super::*;

macro_rules! tables {
    ($($name:ident: $table:ident[$entry:ident],)+) => {$(
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

tables! {
    EnumId: enums[Enum],
    RecordId: records[Record],
    ParameterId: parameters[Parameter],
    ConstantId: constants[Constant],
    VariableId: variables[Variable],
    SharedId: shared[Shared],
    BindingId: bindings[Binding],
    FunctionId: functions[Function],
}
