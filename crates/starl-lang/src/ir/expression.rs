//! Expressions.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

use super::{BindingId, ConstantId, FunctionId, LocalId, ParameterId, SharedId, Type, VariableId};
use crate::check::{Builtin, Member, Method};
use crate::diagnostic::Span;

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// Its kind, with its parts.
    pub kind: ExpressionKind,
    /// The type of its value.
    pub ty: Type,
    /// Where it is, in the file of the declaration that it belongs to.
    pub span: Span,
}

/// The kind of an expression. Parts are evaluated from left to right.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// One with an error that was reported.
    Error,
    /// `true` or `false`
    Bool(bool),
    /// An Int.
    Int(i64),
    /// A Float; lengths are in metres, angles in radians.
    Float(f64),
    /// A Duration in nanoseconds.
    Duration(u64),
    /// A String.
    String(String),
    /// `none`, of an optional type.
    None,
    /// A value as an optional that has it.
    Present(Box<Expression>),
    /// The variant with this number of the enum that is its type.
    Variant(u16),
    /// A local variable.
    Local(LocalId),
    /// A parameter.
    Parameter(ParameterId),
    /// A constant.
    Constant(ConstantId),
    /// A state variable.
    Variable(VariableId),
    /// `name[r]` of a single-writer variable: an optional, none until the robot's value is known.
    SharedElement {
        /// The variable.
        shared: SharedId,
        /// The robot.
        robot: Box<Expression>,
        /// In properties: the robot whose copy is read.
        of: Option<Box<Expression>>,
    },
    /// All of a single-writer variable that is known: a map by RobotId.
    SharedMap(SharedId),
    /// A multi-writer variable; an optional unless it has an initial value.
    Shared(SharedId),
    /// A call of a function.
    Call {
        /// Which.
        function: FunctionId,
        /// An argument for each parameter.
        arguments: Vec<Expression>,
    },
    /// A call of a built-in function, or the use of a built-in name.
    Builtin {
        /// Which.
        builtin: Builtin,
        /// An argument for each parameter; none where an optional one is left out.
        arguments: Vec<Option<Expression>>,
        /// Further arguments, of functions with any number of them, with their names if they have names.
        rest: Vec<(Option<String>, Expression)>,
    },
    /// A call of a method that changes nothing.
    Method {
        /// The value that it is called on.
        receiver: Box<Expression>,
        /// Which.
        method: Method,
        /// An argument for each parameter.
        arguments: Vec<Expression>,
    },
    /// A call of a method that changes what it is called on. It gives nothing.
    Change {
        /// The changed place.
        place: Box<Place>,
        /// Which.
        method: Method,
        /// An argument for each parameter.
        arguments: Vec<Expression>,
    },
    /// A call of a method of a bound primitive, or the use of a status flag.
    Primitive {
        /// The primitive.
        binding: BindingId,
        /// Which method or flag.
        member: &'static Member,
        /// An argument for each parameter; none where an optional one is left out.
        arguments: Vec<Option<Expression>>,
    },
    /// A record or a message, with a value for each field. Its type says which.
    Record(Vec<Expression>),
    /// A field of a record.
    Field {
        /// The record.
        base: Box<Expression>,
        /// The number of the field.
        field: u32,
    },
    /// A coordinate of a point.
    Coordinate {
        /// The point.
        base: Box<Expression>,
        /// 0 for x, 1 for y, 2 for z.
        axis: u8,
    },
    /// `list[index]`; outside of the list it is a run-time error.
    Index {
        /// The list.
        base: Box<Expression>,
        /// An Int.
        index: Box<Expression>,
    },
    /// `map[key]`; a key that is not there is a run-time error.
    Lookup {
        /// The map.
        base: Box<Expression>,
        /// A key.
        key: Box<Expression>,
    },
    /// `optional!`; none is a run-time error.
    Unwrap(Box<Expression>),
    /// `optional == none`
    IsNone(Box<Expression>),
    /// `optional ?? default`; the default is evaluated only if it is needed.
    Default {
        /// The optional.
        optional: Box<Expression>,
        /// The value if that is none: a value, or an optional again.
        default: Box<Expression>,
    },
    /// `-x` of an Int, a Float or a Point.
    Negate(Box<Expression>),
    /// `not x`
    Not(Box<Expression>),
    /// An operator between two values; the types of the operands say which one exactly.
    Binary {
        /// The operator.
        operator: Operator,
        /// The value before it.
        left: Box<Expression>,
        /// The value after it; of `and` and `or` evaluated only if it decides.
        right: Box<Expression>,
    },
    /// `item in collection`: a list, set, map (its keys), range, or a text in a text.
    In {
        /// The item.
        item: Box<Expression>,
        /// Where.
        collection: Box<Expression>,
    },
    /// `start..end`, the end excluded; only where it is run over or looked in.
    Range {
        /// The first Int.
        start: Box<Expression>,
        /// The Int after the last.
        end: Box<Expression>,
    },
    /// `if condition then a else b`
    Conditional {
        /// The condition.
        condition: Box<Expression>,
        /// The value if it holds.
        then: Box<Expression>,
        /// The value if it does not.
        otherwise: Box<Expression>,
    },
    /// `some x = optional`: whether there is a value; if so the local gets it. It stands only where its
    /// falseness keeps everything that reads the local from being evaluated.
    Bind {
        /// The local.
        local: LocalId,
        /// The optional.
        value: Box<Expression>,
    },
    /// `[a, b]`
    List(Vec<Expression>),
    /// `{a, b}`
    Set(Vec<Expression>),
    /// `{k: v}`
    Map(Vec<(Expression, Expression)>),
    /// A comprehension.
    Comprehension(Box<Comprehension>),
    /// `min(x for x in xs by key)` or `max`: the element of the least or the greatest key, the first of equal ones, as
    /// an optional. Without a key the elements are compared themselves.
    Best {
        /// The elements, of a list.
        comprehension: Box<Comprehension>,
        /// Whether it is `max`.
        is_greatest: bool,
    },
    /// `forall` or `exists`, in properties: over all robots of the fleet.
    Quantifier {
        /// Whether it is `forall`.
        is_universal: bool,
        /// The locals, all RobotIds; one after the other, so that `r, s` are all pairs.
        robots: Vec<LocalId>,
        /// The condition on them.
        condition: Box<Expression>,
    },
    /// `forall` or `exists` over a collection.
    Over {
        /// Whether it is `forall`.
        is_universal: bool,
        /// The locals for what is in the collection.
        variables: LoopVariables,
        /// The collection.
        collection: Box<Expression>,
        /// The condition on each element.
        condition: Box<Expression>,
    },
    /// An attribute of a robot, in properties.
    OfRobot {
        /// The robot.
        robot: Box<Expression>,
        /// The attribute.
        member: RobotMember,
    },
}

/// A collection that is built from another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Comprehension {
    /// The element; the collection's type says what they form.
    pub element: Element,
    /// The variables bound for each element.
    pub variables: LoopVariables,
    /// The source: a list, set, map or range.
    pub collection: Expression,
    /// Which elements are taken, if not all.
    pub condition: Option<Expression>,
    /// For a list: the key by which the elements are in ascending order; equal ones in the order of the source. For
    /// `min` and `max`: what they compare.
    pub key: Option<Expression>,
}

/// The element that a comprehension adds in each step.
#[derive(Clone, Debug, PartialEq)]
pub enum Element {
    /// An element of a list or a set.
    One(Expression),
    /// A key and a value of a map; of equal keys the last counts.
    Entry(Expression, Expression),
}

/// An attribute of a robot that properties can read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RobotMember {
    /// Its state variable.
    Variable(VariableId),
    /// Its parameter.
    Parameter(ParameterId),
    /// Its copy of a shared variable: a map, a value or an optional, as the robot reads it.
    Shared(SharedId),
    /// Where it is: the true position where the host knows it, a Point.
    Position,
    /// Where it looks, a Float in radians.
    Heading,
    /// How it moves, a Point in metres per second.
    Velocity,
    /// Whether its program has finished, a Bool.
    Finished,
    /// Whether it runs, rather than having crashed, a Bool.
    Up,
    /// Its number, a RobotId.
    Id,
}

/// An operator between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// Bools.
    And,
    /// Bools.
    Or,
    /// Two values of one type.
    Equal,
    /// Two values of one type.
    NotEqual,
    /// Two of Int, Float, Duration, Time, String or RobotId.
    Less,
    /// As `Less`.
    LessEqual,
    /// As `Less`.
    Greater,
    /// As `Less`.
    GreaterEqual,
    /// Int + Int, Float + Float, Duration + Duration, Time + Duration, Duration + Time, Point + Point,
    /// String + String, List + List.
    Add,
    /// Int - Int, Float - Float, Duration - Duration, Time - Duration, Time - Time (a Duration),
    /// Point - Point.
    Subtract,
    /// Int * Int, Float * Float, Duration * Int or Float and the reverse, Point * Float and the reverse.
    Multiply,
    /// Int / Int (towards zero), Float / Float, Duration / Int or Float (a Duration), Duration /
    /// Duration (a Float), Point / Float.
    Divide,
    /// Int % Int, with the sign of the left one.
    Remainder,
}

/// The variables that a loop or a comprehension binds for each element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopVariables {
    /// An element of a list, set or range, or a key of a map; none for `_`.
    One(Option<LocalId>),
    /// Key and value of a map; none for `_`.
    Two(Option<LocalId>, Option<LocalId>),
}

/// Something that can be written.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The variable.
    pub root: Root,
    /// The way from the variable to its part.
    pub path: Vec<Step>,
    /// The type of the written value.
    pub ty: Type,
    /// Where it is.
    pub span: Span,
}

/// The variable that is written, or a part of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Root {
    /// An error: the target is not a variable.
    Error,
    /// A local variable.
    Local(LocalId),
    /// A state variable.
    Variable(VariableId),
    /// This robot's element of a single-writer variable; always written whole.
    OwnElement(SharedId),
    /// A multi-writer variable. It is read, changed and written whole if there is a path, which there
    /// is only if it has an initial value.
    Shared(SharedId),
}

/// A step from a value to a part of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// The field of a record with this number.
    Field(u32),
    /// A coordinate of a point: 0 for x, 1 for y, 2 for z.
    Coordinate(u8),
    /// An element of a list; outside of the list it is a run-time error.
    Index(Expression),
    /// The value of a key of a map. As the last step it may be new: an update by `+` or `-` and a method that adds
    /// ([`Method::adds`](crate::check::Method::adds)) then start from the default value of the type. Otherwise, and
    /// before the last step, a missing key is a run-time error.
    Key(Expression),
}
