//! The instruction set.
//!
//! A register machine with two windows of registers: `r0` to `r255` hold scalars, 64 bits each, and
//! `b0` to `b127` hold objects. A scalar is a Bool (0 or 1), an Int, a Float (its bits), a Time or a
//! Duration (nanoseconds, as an Int that is never negative), a RobotId or the number of an enum's
//! variant. A Point is three scalars in a row; a record is its fields in a row; an optional is a Bool
//! (is there a value?) followed by the value, all of it zero where there is none. An object is a text,
//! list, set, map, area or obstacles: a value of its own, shared until it is changed. The scalars of a
//! value are in scalar registers and its objects in object registers, both in the order of the text
//! ([`Layout`](crate::machine::Layout)).
//!
//! Operands `s0` to `s127` name objects of the robot's state in place of object registers. The scalars of the state are
//! read by `load` and written by `store`.
//!
//! A call shifts both windows: the callee's `r0` is the caller's register that the call names, so
//! arguments are put there and results are found there, and nothing is copied. Registers of the caller
//! from there on are lost.
//!
//! Every instruction executed costs one unit of fuel; those on objects cost more, as said with them:
//! a *share* of an object is its size in bytes over 64 (it may have to be copied when one of its
//! holders changes it), a *shift* of n bytes is n over 64. Moving a block costs an eighth of its
//! registers.
//!
//! Possible errors are listed with each instruction; the machine stops at an error.

use crate::machine::operand::*;
use serde::{Deserialize, Serialize};

macro_rules! instructions {
    ($($(#[$doc:meta])* $name:ident $word:literal { $($field:ident: $type:ty),* })*) => {
        /// One instruction, eight bytes. The types of the operands say what becomes of them.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[allow(missing_docs, reason = "operands are explained with their instruction")]
        pub enum Instruction {
            $($(#[$doc])* $name { $($field: $type),* }),*
        }

        impl Instruction {
            /// The name in text form.
            pub const fn mnemonic(&self) -> &'static str {
                match self {
                    $(Instruction::$name { .. } => $word),*
                }
            }

            /// Writes the text form: the name, then the operands in the order of the declaration.
            pub fn write(&self, out: &mut dyn core::fmt::Write) -> core::fmt::Result {
                out.write_str(self.mnemonic())?;
                match *self {
                    $(Instruction::$name { $($field),* } => {
                        $(
                            out.write_str(" ")?;
                            $field.write(out)?;
                        )*
                    })*
                }
                Ok(())
            }

            /// Reads the text form, split into words.
            pub fn read(
                words: &[&str],
                label: &dyn Fn(&str) -> Option<u32>,
            ) -> Option<Instruction> {
                let (mnemonic, operands) = words.split_first()?;
                let mut operands = operands.iter();
                let instruction = match *mnemonic {
                    $($word => Instruction::$name {
                        $($field: <$type as Operand>::read(operands.next()?, label)?),*
                    },)*
                    _ => return None,
                };
                operands.next().is_none().then_some(instruction)
            }

            /// Visits the uses of the operands, in order.
            pub fn uses(&self, visit: &mut dyn FnMut(Use)) {
                match *self {
                    $(Instruction::$name { $($field),* } => {
                        $(visit($field.used());)*
                    })*
                }
            }

            /// The same with other targets of jumps.
            #[must_use]
            pub fn with_targets(&self, place: &dyn Fn(u32) -> u32) -> Instruction {
                match *self {
                    $(Instruction::$name { $($field),* } => Instruction::$name {
                        $($field: $field.with_target(place)),*
                    }),*
                }
            }

            /// All names in text form, in the order of the declaration.
            pub const MNEMONICS: &'static [&'static str] = &[$($word),*];
        }
    };
}

instructions! {
    // Moves and constants.

    /// to = from.
    Copy "copy" { to: Out, from: In }
    /// to = from, for `count` registers in a row; the two may overlap.
    CopyBlock "copy_block" { to: Block, from: Block, count: Count }
    /// to = value.
    Int "int" { to: Out, value: Immediate }
    /// to = a scalar constant.
    Constant "load_constant" { to: Out, constant: Constant }

    // The robot's state, scalars.

    /// to = a scalar of the state.
    Load "load" { to: Out, variable: Slot }
    /// to = three scalars of the state.
    LoadPoint "load_point" { to: PointOut, variable: Slot }
    /// A scalar of the state = from.
    Store "store" { variable: Slot, from: In }
    /// Three scalars of the state = from.
    StorePoint "store_point" { variable: Slot, from: PointIn }
    /// to = a scalar of the state of another robot that runs the same program (properties only).
    /// Error: the host knows no such robot.
    LoadOther "load_other" { to: Out, robot: In, variable: Slot }
    /// to = three scalars of the state of another robot, see `load_other`.
    LoadOtherPoint "load_other_point" { to: PointOut, robot: In, variable: Slot }
    /// to = an object of the state of another robot, see `load_other`. A share.
    LoadOtherObject "load_other_object" { to: ObjectOut, robot: In, variable: ObjectSlot }

    // Int. Errors: overflow, division by zero.

    /// to = left + right.
    AddInt "add_int" { to: Out, left: In, right: In }
    /// to = left - right.
    SubtractInt "subtract_int" { to: Out, left: In, right: In }
    /// to = left * right.
    MultiplyInt "multiply_int" { to: Out, left: In, right: In }
    /// to = left / right, towards zero.
    DivideInt "divide_int" { to: Out, left: In, right: In }
    /// to = left % right, with the sign of `left`.
    RemainderInt "remainder_int" { to: Out, left: In, right: In }
    /// to = left + right.
    AddConstant "add_constant" { to: Out, left: In, right: Immediate }
    /// to = left * right.
    MultiplyConstant "multiply_constant" { to: Out, left: In, right: Immediate }
    /// to = left / right, towards zero.
    DivideConstant "divide_constant" { to: Out, left: In, right: Immediate }
    /// to = left % right, with the sign of `left`.
    RemainderConstant "remainder_constant" { to: Out, left: In, right: Immediate }
    /// to = -from.
    NegateInt "negate_int" { to: Out, from: In }
    /// to = |from|.
    AbsoluteInt "absolute_int" { to: Out, from: In }
    /// to = the lesser.
    MinimumInt "minimum_int" { to: Out, left: In, right: In }
    /// to = the greater.
    MaximumInt "maximum_int" { to: Out, left: In, right: In }

    // Time and Duration: Ints that are never negative. Sums are `add_int`.

    /// to = left - right, zero if right is greater: the span between two times or durations.
    SubtractSpan "subtract_span" { to: Out, left: In, right: In }
    /// to = span * times, an Int. Errors: overflow, also if `times` is negative.
    MultiplySpan "multiply_span" { to: Out, span: In, times: In }
    /// to = span * factor, a Float, to the nearest nanosecond. Error: the product is negative, too
    /// great or no number.
    ScaleSpan "scale_span" { to: Out, span: In, factor: In }
    /// to = left / right, a Float. Error: division by zero.
    RatioSpan "ratio_span" { to: Out, left: In, right: In }

    // Float, IEEE 754.

    /// to = left + right.
    AddFloat "add_float" { to: Out, left: In, right: In }
    /// to = left - right.
    SubtractFloat "subtract_float" { to: Out, left: In, right: In }
    /// to = left * right.
    MultiplyFloat "multiply_float" { to: Out, left: In, right: In }
    /// to = left / right.
    DivideFloat "divide_float" { to: Out, left: In, right: In }
    /// to = -from.
    NegateFloat "negate_float" { to: Out, from: In }
    /// to = |from|.
    AbsoluteFloat "absolute_float" { to: Out, from: In }
    /// to = the lesser; the other where one is NaN.
    MinimumFloat "minimum_float" { to: Out, left: In, right: In }
    /// to = the greater; the other where one is NaN.
    MaximumFloat "maximum_float" { to: Out, left: In, right: In }
    /// to = function(from). Costs 8.
    Unary "unary" { to: Out, from: In, function: Unary }
    /// to = function(left, right). Costs 8.
    Binary "binary" { to: Out, left: In, right: In, function: Binary }

    // Conversions.

    /// to = from as a Float, the nearest.
    FloatOfInt "float_of_int" { to: Out, from: In }
    /// to = from as an Int. Error: out of range or no number.
    IntOfFloat "int_of_float" { to: Out, from: In, rounding: Rounding }

    // Bool.

    /// to = not from.
    Not "not" { to: Out, from: In }
    /// to = left and right, both evaluated already.
    And "and" { to: Out, left: In, right: In }
    /// to = left or right, both evaluated already.
    Or "or" { to: Out, left: In, right: In }
    /// to = left == right, for all scalars but Floats.
    Equal "equal" { to: Out, left: In, right: In }
    /// to = left != right, for all scalars but Floats.
    NotEqual "not_equal" { to: Out, left: In, right: In }
    /// to = left < right, for all scalars but Floats.
    LessInt "less_int" { to: Out, left: In, right: In }
    /// to = left <= right, for all scalars but Floats.
    LessEqualInt "less_equal_int" { to: Out, left: In, right: In }
    /// to = left == right; NaN equals nothing.
    EqualFloat "equal_float" { to: Out, left: In, right: In }
    /// to = left < right; false where one is NaN.
    LessFloat "less_float" { to: Out, left: In, right: In }
    /// to = left <= right; false where one is NaN.
    LessEqualFloat "less_equal_float" { to: Out, left: In, right: In }

    // Points, metres.

    /// to = from.
    CopyPoint "copy_point" { to: PointOut, from: PointIn }
    /// to = left + right.
    AddPoint "add_point" { to: PointOut, left: PointIn, right: PointIn }
    /// to = left - right.
    SubtractPoint "subtract_point" { to: PointOut, left: PointIn, right: PointIn }
    /// to = -from.
    NegatePoint "negate_point" { to: PointOut, from: PointIn }
    /// to = from * factor.
    ScalePoint "scale_point" { to: PointOut, from: PointIn, factor: In }
    /// to = from / divisor.
    DividePoint "divide_point" { to: PointOut, from: PointIn, divisor: In }
    /// to = the distance between the two, heights included.
    Distance "distance" { to: Out, left: PointIn, right: PointIn }
    /// to = all coordinates are equal.
    EqualPoint "equal_point" { to: Out, left: PointIn, right: PointIn }

    // Going elsewhere. Targets lie within the same function.

    /// Goes to the target.
    Jump "jump" { target: Target }
    /// Goes to the target if `condition`.
    JumpIf "jump_if" { condition: In, target: Target }
    /// Goes to the target unless `condition`.
    JumpUnless "jump_unless" { condition: In, target: Target }
    /// Goes to the target if left == right, for all scalars but Floats.
    JumpIfEqual "jump_if_equal" { left: In, right: In, target: Target }
    /// Goes to the target if left != right, for all scalars but Floats.
    JumpIfNotEqual "jump_if_not_equal" { left: In, right: In, target: Target }
    /// Goes to the target if left < right, for all scalars but Floats.
    JumpIfLess "jump_if_less" { left: In, right: In, target: Target }
    /// Goes to the target if left <= right, for all scalars but Floats.
    JumpIfLessEqual "jump_if_less_equal" { left: In, right: In, target: Target }
    /// Goes to the target if left == right.
    JumpIfEqualConstant "jump_if_equal_constant" { left: In, right: Short, target: Target }
    /// Goes to the target if left != right.
    JumpIfNotEqualConstant "jump_if_not_equal_constant" { left: In, right: Short, target: Target }
    /// Goes to the target if left < right.
    JumpIfLessConstant "jump_if_less_constant" { left: In, right: Short, target: Target }
    /// Goes to the target if left >= right.
    JumpUnlessLessConstant "jump_unless_less_constant" { left: In, right: Short, target: Target }
    /// Goes to the target if left < right.
    JumpIfLessFloat "jump_if_less_float" { left: In, right: In, target: Target }
    /// Goes to the target unless left < right: also where one is NaN.
    JumpUnlessLessFloat "jump_unless_less_float" { left: In, right: In, target: Target }
    /// Goes to the target if left <= right.
    JumpIfLessEqualFloat "jump_if_less_equal_float" { left: In, right: In, target: Target }
    /// Goes to the target unless left <= right: also where one is NaN.
    JumpUnlessLessEqualFloat "jump_unless_less_equal_float" { left: In, right: In, target: Target }
    /// If a state's scalar is not `right`, goes to the target: the guard of a control variable.
    JumpIfStateNot "jump_if_state_not" { right: Short, target: Target, variable: ShortSlot }
    /// counter = counter + 1; goes to the target if counter < limit. Error: overflow.
    Loop "loop" { counter: InOut, limit: In, target: Target }
    /// Error, none unwrapped, unless `present`.
    Require "require" { present: In }

    // Calls.

    /// Calls a function whose windows begin at the named registers. Error: call depth.
    Call "call" { scalars: Block, objects: ObjectBlock, function: FunctionIndex }
    /// Calls the host, see [`Host`](crate::machine::Host). The host returns the cost beyond one. Error: the host's own.
    CallHost "call_host" { scalars: Block, objects: ObjectBlock, import: ImportIndex }
    /// Ends the function; its results are in the first registers. Object registers from `keep`, the number of
    /// objects among them, up to `until`, the number of object registers that it uses, are emptied.
    Return "return" { keep: Count, until: Count }
    /// Ends a function whose result is one scalar, see `return`.
    ReturnScalar "return_scalar" { from: In, until: Count }
    /// Ends a guard that does not hold; bindings need not be there.
    ReturnFalse "return_false" { until: Count }

    // All objects.

    /// to = from. A share.
    CopyObject "copy_object" { to: ObjectOut, from: ObjectIn }
    /// to = from, which becomes empty.
    MoveObject "move_object" { to: ObjectOut, from: ObjectInOut }
    /// to = the empty object of that type.
    ClearObject "clear_object" { to: ObjectOut, kind: Type }
    /// to = an object of the state, for those beyond the reach of operands. A share.
    LoadObject "load_object" { to: ObjectOut, variable: ObjectSlot }
    /// An object of the state = from, which becomes empty.
    StoreObject "store_object" { variable: ObjectSlot, from: ObjectInOut }
    /// to = left == right, for two objects of type `kind`. Costs the size of the lesser over 64.
    EqualObject "equal_object" { to: Out, left: ObjectIn, right: ObjectIn, kind: Type }
    /// to = left < right: texts by code points, collections by their elements in order. Costs the
    /// size of the lesser over 64.
    LessObject "less_object" { to: Out, left: ObjectIn, right: ObjectIn, kind: Type }
    /// to = how many elements, entries or characters. A text costs its size over 64.
    Size "size" { to: Out, from: ObjectIn }

    // Texts.

    /// to = a constant text. A share.
    Text "load_text" { to: ObjectOut, constant: Text }
    /// text = text, from. Costs the size of `from` over 64.
    AppendText "append_text" { text: ObjectInOut, from: ObjectIn }
    /// text = text, the scalar in text form. Costs 4.
    AppendScalar "append_scalar" { text: ObjectInOut, from: In, format: Format }
    /// text = text, the point as `(x, y, z)`. Costs 12.
    AppendPoint "append_point" { text: ObjectInOut, from: PointIn }
    /// text = text, the name of the variant. Error: there is no such variant.
    AppendVariant "append_variant" { text: ObjectInOut, from: In, of: EnumIndex }
    /// text = text, an object of type `kind` as it would be written in a program; a text without its
    /// quotes. Costs the size of what is added over 8.
    AppendObject "append_object" { text: ObjectInOut, from: ObjectIn, kind: Type }
    /// text = text, the other text as it would be written in a program, with quotes. Costs the size of
    /// what is added over 8.
    AppendQuoted "append_quoted" { text: ObjectInOut, from: ObjectIn }
    /// to = whether `part` is in the text. Costs the sizes of both over 8.
    ContainsText "contains_text" { to: Out, text: ObjectIn, part: ObjectIn }
    /// to = the parts of the text between separators; all of it if the separator is empty. A shift of
    /// the text and 8 for each part.
    SplitText "split_text" { to: ObjectOut, text: ObjectIn, separator: ObjectIn, kind: Type }
    /// to = whether the text has `part` at this end. Costs the size of `part` over 8.
    MatchText "match_text" { to: Out, text: ObjectIn, part: ObjectIn, end: TextEnd }
    /// to = the changed text. Costs the size of the text over 8.
    ChangeText "change_text" { to: ObjectOut, text: ObjectIn, change: TextChange }
    /// to = the text with `by` in place of each `part`, unless that is empty. Costs the sizes of all over 8.
    ReplaceText "replace_text" { to: ObjectOut, text: ObjectIn, part: ObjectIn, by: ObjectIn }
    /// to = the texts of a list with `separator` between them. Costs the size of the result over 8, and 1 for each text.
    JoinTexts "join_texts" { to: ObjectOut, list: ObjectIn, separator: ObjectIn }
    /// to = an optional Int or finite Float: the number that the text is. Costs the size of the text over 8.
    NumberOfText "number_of_text" { to: PairOut, text: ObjectIn, format: Format }

    // Lists; what only reads is for sets too. An element is a block: its scalars from `scalars` on,
    // its objects from `objects` on. Reading an element with objects shares them.

    /// The block = the element. Error: index.
    ListGet "list_get" { list: ObjectIn, index: In, scalars: Block, objects: ObjectBlock }
    /// The element = the block. Error: index.
    ListSet "list_set" { list: ObjectInOut, index: In, scalars: Block, objects: ObjectBlock }
    /// Adds the block at the end.
    ListAdd "list_add" { list: ObjectInOut, scalars: Block, objects: ObjectBlock, kind: Type }
    /// Inserts the block before an index from 0 to the size. A shift of what follows. Error: index.
    ListInsert "list_insert" { list: ObjectInOut, index: In, scalars: Block, objects: ObjectBlock, kind: Type }
    /// Removes the element. A shift of what follows. Error: index.
    ListRemoveAt "list_remove_at" { list: ObjectInOut, index: In }
    /// to = whether a value comes before another one in a sorted list of the type `kind`.
    LessElement "less_element" { to: Out, scalars: Block, objects: ObjectBlock, other: Block, other_objects: ObjectBlock, kind: Type }
    /// to = an optional Int: the first index at which the block stands. A shift of the list.
    ListFind "list_find" { to: PairOut, list: ObjectIn, scalars: Block, objects: ObjectBlock, kind: Type }
    /// list = list, from. A share of `from`.
    ListAppend "list_append" { list: ObjectInOut, from: ObjectIn }
    /// Turns the order round. A shift of the list.
    ListReverse "list_reverse" { list: ObjectInOut }
    /// Sorts, equal elements in the order that they had. A shift of the list times the binary
    /// logarithm of its size.
    ListSort "list_sort" { list: ObjectInOut, kind: Type }
    /// Sorts by the keys, a list of type `kind` with one for each element; elements with equal keys stay in the order
    /// that they had, those without a key go. Costs as sorting the keys, and a shift of the list.
    ListSortBy "list_sort_by" { list: ObjectInOut, keys: ObjectIn, kind: Type }
    /// Keeps the elements from `first` on and before `last`. A shift of the list. Error: index.
    ListSlice "list_slice" { list: ObjectInOut, first: In, last: In }
    /// to = the sum of a list of Ints. A shift of the list. Error: overflow.
    SumInt "sum_int" { to: Out, list: ObjectIn }
    /// to = the sum of a list of Floats, from the first on. A shift of the list.
    SumFloat "sum_float" { to: Out, list: ObjectIn }
    /// to = the set's elements as a list of type `kind`. A share.
    ListOfSet "list_of_set" { to: ObjectOut, set: ObjectIn, kind: Type }
    /// to = the list's elements as a set of type `kind`. Costs as `list_sort`.
    SetOfList "set_of_list" { to: ObjectOut, list: ObjectIn, kind: Type }

    // Sets, whose elements are in ascending order. Finding the block costs 3.

    /// Adds the block if it is not there. A shift of what follows.
    SetAdd "set_add" { set: ObjectInOut, scalars: Block, objects: ObjectBlock, kind: Type }
    /// Removes the block if it is there. A shift of what follows.
    SetRemove "set_remove" { set: ObjectInOut, scalars: Block, objects: ObjectBlock, kind: Type }
    /// to = whether the block is there.
    SetContains "set_contains" { to: Out, set: ObjectIn, scalars: Block, objects: ObjectBlock, kind: Type }
    /// Adds all of `from`. A shift of both.
    SetUnite "set_unite" { set: ObjectInOut, from: ObjectIn, kind: Type }
    /// Keeps what is in `from` too. A shift of both.
    SetIntersect "set_intersect" { set: ObjectInOut, from: ObjectIn, kind: Type }
    /// Removes what is in `from`. A shift of both.
    SetSubtract "set_subtract" { set: ObjectInOut, from: ObjectIn, kind: Type }

    // Maps, whose entries are in ascending order of keys. A key is a block; finding it costs 3.

    /// Sets the value of a key: the block is the key followed by the value. A shift of what follows.
    MapPut "map_put" { map: ObjectInOut, scalars: Block, objects: ObjectBlock, kind: Type }
    /// Adds to the value of a key, an Int, which is 0 if the key is missing. A shift of what follows. Error: overflow.
    MapAdd "map_add" { map: ObjectInOut, scalars: Block, objects: ObjectBlock, amount: In, kind: Type }
    /// As `map_add`.
    MapAddConstant "map_add_constant" { map: ObjectInOut, scalars: Block, objects: ObjectBlock, amount: Short, kind: Type }
    /// to = an optional: the value of the key.
    MapGet "map_get" { map: ObjectIn, scalars: Block, objects: ObjectBlock, to: Block, to_objects: ObjectBlock, kind: Type }
    /// to = the value of the key. Error: key missing.
    MapAt "map_at" { map: ObjectIn, scalars: Block, objects: ObjectBlock, to: Block, to_objects: ObjectBlock, kind: Type }
    /// to = whether there is such a key.
    MapContains "map_contains" { to: Out, map: ObjectIn, scalars: Block, objects: ObjectBlock, kind: Type }
    /// Removes the key and its value if they are there. A shift of what follows.
    MapRemove "map_remove" { map: ObjectInOut, scalars: Block, objects: ObjectBlock, kind: Type }
    /// The block = the key of the entry at `index`, followed by its value. Error: index.
    MapEntry "map_entry" { map: ObjectIn, index: In, scalars: Block, objects: ObjectBlock }
    /// to = the keys, a set of type `kind`. A share.
    MapKeys "map_keys" { to: ObjectOut, map: ObjectIn, kind: Type }
    /// to = the values in the order of the keys, a list of type `kind`. A share.
    MapValues "map_values" { to: ObjectOut, map: ObjectIn, kind: Type }

    // Areas.

    /// to = the circle around `center`; a negative or infinite radius is an error, conversion.
    Circle "circle" { to: ObjectOut, center: PointIn, radius: In }
    /// to = the convex polygon with these corners, a list of Points; two make a wall. Error,
    /// conversion: fewer than two, or not convex. A shift of the list.
    Polygon "polygon" { to: ObjectOut, corners: ObjectIn }
    /// to = whether the point lies in the area or on its boundary; false of an empty area. Costs the
    /// size of the area over 8.
    AreaContains "area_contains" { to: Out, area: ObjectIn, point: PointIn }
}

const _: () = assert!(size_of::<Instruction>() == 8);
