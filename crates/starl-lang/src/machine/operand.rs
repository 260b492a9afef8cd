//! Operands of instructions. The type of an operand says what the instruction does with it, so that
//! the verifier, the assembler and the disassembler need no table of their own.
//!
//! Invariant: an instruction is at most eight bytes; operands are one byte for registers, two or
//! four for numbers.

use serde::{Deserialize, Serialize};

/// The first object operand that names a state variable instead of a register.
pub const FIRST_STATE_OPERAND: u8 = 128;

/// The use of one operand by an instruction, as the verifier sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// Reads this many scalar registers from the first on.
    Reads(u8, u8),
    /// Writes this many scalar registers from the first on.
    Writes(u8, u8),
    /// Reads and writes a scalar register.
    Changes(u8),
    /// Reads an object operand.
    ReadsObject(u8),
    /// Changes an object operand in place.
    ChangesObject(u8),
    /// Writes an object operand; the instruction's own rule says of which type.
    WritesObject(u8),
    /// May continue at this instruction.
    JumpsTo(u32),
    /// A constant, index or width that the instruction's own rule checks.
    Number,
}

/// An operand: printed, parsed and described to the verifier.
pub trait Operand: Copy {
    /// The text form.
    fn write(self, out: &mut dyn core::fmt::Write) -> core::fmt::Result;
    /// Reads an operand from a word of text; `label` finds the place of a label.
    fn read(word: &str, label: &dyn Fn(&str) -> Option<u32>) -> Option<Self>;
    /// The use of the operand.
    fn used(self) -> Use;
    /// The same, at another place if it is the target of a jump.
    #[must_use]
    fn with_target(self, place: &dyn Fn(u32) -> u32) -> Self {
        let _ = place;
        self
    }
}

macro_rules! register {
    ($($(#[$doc:meta])* $name:ident, $prefix:literal, |$register:ident| $used:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub struct $name(pub u8);

        impl $name {
            /// Its place in the window of registers.
            #[inline(always)]
            pub const fn place(self) -> usize {
                self.0 as usize
            }
        }

        impl Operand for $name {
            fn write(self, out: &mut dyn core::fmt::Write) -> core::fmt::Result {
                write!(out, concat!($prefix, "{}"), self.0)
            }

            fn read(word: &str, _: &dyn Fn(&str) -> Option<u32>) -> Option<$name> {
                word.strip_prefix($prefix)?.parse().ok().map($name)
            }

            fn used(self) -> Use {
                let $register = self.0;
                $used
            }
        }
    )*};
}

register! {
    /// A scalar register that is read.
    In, "r", |register| Use::Reads(register, 1);
    /// A scalar register that is written.
    Out, "r", |register| Use::Writes(register, 1);
    /// A scalar register that is read and written.
    InOut, "r", |register| Use::Changes(register);
    /// The first of two scalar registers that an optional scalar is written to.
    PairOut, "r", |register| Use::Writes(register, 2);
    /// The first of three scalar registers that hold a point and are read.
    PointIn, "r", |register| Use::Reads(register, 3);
    /// The first of three scalar registers that a point is written to.
    PointOut, "r", |register| Use::Writes(register, 3);
    /// The first of the scalar registers of a block: how many, and whether they are read or
    /// written, follows from the types that the instruction works on.
    Block, "r", |_register| Use::Number;
    /// The first of the object registers of a block, see [`Block`].
    ObjectBlock, "b", |_register| Use::Number;
}

macro_rules! object {
    ($($(#[$doc:meta])* $name:ident, $used:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub struct $name(pub u8);

        impl Operand for $name {
            fn write(self, out: &mut dyn core::fmt::Write) -> core::fmt::Result {
                match self.0.checked_sub(FIRST_STATE_OPERAND) {
                    Some(variable) => write!(out, "s{variable}"),
                    None => write!(out, "b{}", self.0),
                }
            }

            fn read(word: &str, _: &dyn Fn(&str) -> Option<u32>) -> Option<$name> {
                if let Some(variable) = word.strip_prefix("s") {
                    let variable: u8 = variable.parse().ok()?;
                    variable.checked_add(FIRST_STATE_OPERAND).map($name)
                } else {
                    let register: u8 = word.strip_prefix("b")?.parse().ok()?;
                    (register < FIRST_STATE_OPERAND).then_some($name(register))
                }
            }

            fn used(self) -> Use {
                Use::$used(self.0)
            }
        }
    )*};
}

object! {
    /// An object that is read: register `b0` to `b127`, or state variable `s0` to `s127`.
    ObjectIn, ReadsObject;
    /// An object that is written, see [`ObjectIn`].
    ObjectOut, WritesObject;
    /// An object that is changed in place, see [`ObjectIn`].
    ObjectInOut, ChangesObject;
}

macro_rules! number {
    ($($(#[$doc:meta])* $name:ident($type:ty), $prefix:literal, |$number:ident| $used:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub struct $name(pub $type);

        impl Operand for $name {
            fn write(self, out: &mut dyn core::fmt::Write) -> core::fmt::Result {
                write!(out, concat!($prefix, "{}"), self.0)
            }

            fn read(word: &str, label: &dyn Fn(&str) -> Option<u32>) -> Option<$name> {
                let _ = label;
                word.strip_prefix($prefix)?.parse().ok().map($name)
            }

            fn used(self) -> Use {
                let $number = self.0;
                let _ = $number;
                $used
            }
        }
    )*};
}

number! {
    /// An integer in the instruction itself.
    Immediate(i32), "", |number| Use::Number;
    /// A small integer in the instruction itself.
    Short(i16), "", |number| Use::Number;
    /// How many registers, or the first register that is not meant.
    Count(u8), "#", |number| Use::Number;
    /// An index into the scalar constants.
    Constant(u32), "c", |number| Use::Number;
    /// An index into the constant texts.
    Text(u32), "t", |number| Use::Number;
    /// An index into the scalar part of the state.
    Slot(u32), "v", |number| Use::Number;
    /// An index into the scalar part of the state, for instructions that have little room.
    ShortSlot(u8), "v", |number| Use::Number;
    /// An index into the object part of the state.
    ObjectSlot(u32), "s", |number| Use::Number;
    /// An index into the object types.
    Type(u16), "type", |number| Use::Number;
    /// An index into the enums.
    EnumIndex(u16), "enum", |number| Use::Number;
    /// An index into the functions.
    FunctionIndex(u32), "f", |number| Use::Number;
    /// An index into the imports.
    ImportIndex(u32), "h", |number| Use::Number;
}

/// Where to continue: an index into the whole program's instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Target(pub u32);

impl Operand for Target {
    fn write(self, out: &mut dyn core::fmt::Write) -> core::fmt::Result {
        write!(out, "@{}", self.0)
    }

    fn read(word: &str, label: &dyn Fn(&str) -> Option<u32>) -> Option<Target> {
        label(word.strip_prefix('@')?).map(Target)
    }

    fn used(self) -> Use {
        Use::JumpsTo(self.0)
    }

    fn with_target(self, place: &dyn Fn(u32) -> u32) -> Target {
        Target(place(self.0))
    }
}

macro_rules! choice {
    ($($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident $word:literal),* $(,)? })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum $name {
            $($(#[$variant_doc])* $variant),*
        }

        impl Operand for $name {
            fn write(self, out: &mut dyn core::fmt::Write) -> core::fmt::Result {
                out.write_str(match self {
                    $($name::$variant => $word),*
                })
            }

            fn read(word: &str, _: &dyn Fn(&str) -> Option<u32>) -> Option<$name> {
                match word {
                    $($word => Some($name::$variant),)*
                    _ => None,
                }
            }

            fn used(self) -> Use {
                Use::Number
            }
        }
    )*};
}

choice! {
    /// How a Float becomes an Int.
    Rounding {
        /// Towards zero.
        Truncate "truncate",
        /// Downwards.
        Floor "floor",
        /// Upwards.
        Ceiling "ceiling",
        /// To the nearest, halves away from zero.
        Nearest "nearest",
    }

    /// A function of one Float; angles are radians.
    Unary {
        /// Square root; NaN of negative numbers.
        SquareRoot "square_root",
        /// Sine.
        Sine "sine",
        /// Cosine.
        Cosine "cosine",
        /// Tangent.
        Tangent "tangent",
        /// Arc sine.
        ArcSine "arc_sine",
        /// Arc cosine.
        ArcCosine "arc_cosine",
        /// Arc tangent.
        ArcTangent "arc_tangent",
        /// e to the power.
        Exponential "exponential",
        /// Natural logarithm.
        Logarithm "logarithm",
        /// Downwards to a whole number.
        Floor "floor",
        /// Upwards to a whole number.
        Ceiling "ceiling",
        /// To the nearest whole number, halves away from zero.
        Round "round",
        /// The angle in (-pi, pi] that points the same way.
        WrapAngle "wrap_angle",
    }

    /// A function of two Floats.
    Binary {
        /// Direction of (right, left), radians: `left` is y, `right` is x.
        ArcTangent "arc_tangent",
        /// `left` to the power `right`.
        Power "power",
        /// Length of (left, right).
        Hypotenuse "hypotenuse",
        /// Remainder of the division, with the sign of `left`.
        Remainder "remainder",
    }

    /// How a text is changed.
    TextChange {
        /// To small letters.
        Lower "lower",
        /// To capital letters.
        Upper "upper",
        /// Without white space at both ends.
        Trim "trim",
    }

    /// An end of a text.
    TextEnd {
        /// Its start.
        Start "start",
        /// Its end.
        End "end",
    }

    /// How a scalar is written into a text.
    Format {
        /// `true` or `false`.
        Bool "bool",
        /// Decimal.
        Int "int",
        /// Shortest decimal that reads back the same, with a point.
        Float "float",
        /// Seconds, to the millisecond.
        Time "time",
        /// The largest unit that leaves a whole number.
        Duration "duration",
        /// `robot` and the number.
        Robot "robot",
    }
}
