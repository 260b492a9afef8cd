//! The numbers by which parts of a program refer to declarations.

macro_rules! ids {
    ($($(#[$doc:meta])+ $name:ident,)+) => {$(
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
    )+};
}

ids! {
    /// An enum.
    EnumId,
    /// A record or a message.
    RecordId,
    /// A parameter.
    ParameterId,
    /// A constant.
    ConstantId,
    /// A state variable.
    VariableId,
    /// A shared variable.
    SharedId,
    /// A bound primitive.
    BindingId,
    /// A function.
    FunctionId,
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
