//! Types of the host's functions, and the comparison with an import's types.
//!
//! The host's tables are written with these, in the order of the language's own tables.

use crate::machine::{Bytecode, Enum, Import, ObjectType, Type};
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::event::moving::Trouble;
use starl_core::motion::Planner;
use starl_primitives::broadcast::Order;
use starl_primitives::{election, mutex};

/// A type that a function of the host takes or gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Bool,
    Int,
    Float,
    Time,
    Duration,
    /// `RobotId`
    Robot,
    Point,
    /// `String`
    Text,
    Area,
    Obstacles,
    // Enums and records of the prelude.
    Side,
    Planner,
    MotionTrouble,
    ElectionAlgorithm,
    MutexAlgorithm,
    Order,
    Detection,
    Thing,
    List(&'static Shape),
    Set(&'static Shape),
    Map(&'static Shape, &'static Shape),
    /// A value or none.
    Optional(&'static Shape),
    /// Any message, whose name is the import's label.
    Message,
    /// The number of a shared variable, whose name is the import's label.
    Shared,
    /// Any value.
    Any,
}

/// The name, arguments and results of a host function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    pub name: &'static str,
    /// Whether it changes nothing.
    pub query: bool,
    /// The types of its arguments.
    pub parameters: &'static [Shape],
    /// Whether any values with names may follow.
    pub fields: bool,
    /// The type of its result, if it has one.
    pub result: Option<Shape>,
}

impl Signature {
    /// A function that changes nothing and gives a result.
    pub const fn query(
        name: &'static str,
        parameters: &'static [Shape],
        result: Shape,
    ) -> Signature {
        Signature {
            query: true,
            ..Signature::effect(name, parameters, Some(result))
        }
    }

    /// A function that may change something.
    pub const fn effect(
        name: &'static str,
        parameters: &'static [Shape],
        result: Option<Shape>,
    ) -> Signature {
        Signature {
            name,
            query: false,
            parameters,
            fields: false,
            result,
        }
    }
}

/// The sides of a robot, as the prelude has them.
pub const SIDES: [&str; 3] = ["left", "right", "both"];

/// The planners, as the prelude has them.
pub const PLANNERS: [(&str, Planner); 4] = [
    ("auto", Planner::Auto),
    ("rrt", Planner::Rrt),
    ("rrt_connect", Planner::RrtConnect),
    ("rrt_star", Planner::RrtStar),
];

/// The reasons of failed motions, by their names in the prelude.
pub const MOTION_TROUBLES: [(&str, Trouble); 8] = [
    ("in_unsafe_set", Trouble::Unsafe),
    ("wind", Trouble::Wind),
    ("stuck", Trouble::Stuck),
    ("obstacle", Trouble::Obstacle),
    ("off_path", Trouble::OffPath),
    ("no_path", Trouble::NoPath),
    ("no_points", Trouble::NoPoints),
    ("not_finite", Trouble::NotFinite),
];

/// How a leader is elected, as the prelude has it.
pub const ELECTION_ALGORITHMS: [(&str, election::Algorithm); 3] = [
    ("leases", election::Algorithm::Leases),
    ("ballots", election::Algorithm::Ballots),
    ("bully", election::Algorithm::Bully),
];

/// The algorithms of a mutex, as the prelude has them.
pub const MUTEX_ALGORITHMS: [(&str, mutex::Algorithm); 3] = [
    ("permission", mutex::Algorithm::Permission),
    ("quorum", mutex::Algorithm::Quorum),
    ("lease", mutex::Algorithm::Lease),
];

/// The orders of broadcasts, as the prelude has them.
pub const ORDERS: [(&str, Order); 4] = [
    ("unordered", Order::Unordered),
    ("fifo", Order::Fifo),
    ("causal", Order::Causal),
    ("total", Order::Total),
];

/// The types that bytecode declares.
pub struct Declared {
    enums: Vec<Enum>,
    objects: Vec<ObjectType>,
}

impl Declared {
    /// Those of this bytecode.
    pub fn of(bytecode: &Bytecode) -> Declared {
        Declared {
            enums: bytecode.enums.clone(),
            objects: bytecode.types.clone(),
        }
    }

    /// The variants of an enum.
    pub fn variants(&self, index: u16) -> &[String] {
        let declared = self.enums.get(usize::from(index));
        declared.map_or(&[], |declared| &declared.variants)
    }

    /// An object type.
    pub fn object(&self, index: u16) -> Option<&ObjectType> {
        self.objects.get(usize::from(index))
    }

    /// Whether an import has this signature; `leading` arguments precede those of the signature and are Ints.
    pub fn matches(&self, import: &Import, signature: &Signature, leading: usize) -> bool {
        let Some((first, arguments)) = import.arguments.split_at_checked(leading) else {
            return false;
        };
        let count = signature.parameters.len();
        let Some((own, fields)) = arguments.split_at_checked(count) else {
            return false;
        };
        let is_labelled = |shape: &Shape| matches!(shape, Shape::Message | Shape::Shared);
        let takes_label = signature.parameters.iter().any(is_labelled);
        let labels = if takes_label { 1 } else { fields.len() };
        first.iter().all(|kind| *kind == Type::Int)
            && import.query == signature.query
            && (fields.is_empty() || signature.fields)
            && import.labels.len() == labels
            && self.all(signature.parameters, own)
            && match (signature.result, &import.results[..]) {
                (None, []) => true,
                (Some(shape), [kind]) => self.is(shape, kind),
                _ => false,
            }
    }

    /// Whether types are of these shapes, one by one.
    pub fn all(&self, shapes: &[Shape], kinds: &[Type]) -> bool {
        let mut pairs = shapes.iter().zip(kinds);
        shapes.len() == kinds.len() && pairs.all(|(shape, kind)| self.is(*shape, kind))
    }

    fn is(&self, shape: Shape, kind: &Type) -> bool {
        match (shape, kind) {
            (Shape::Any, _)
            | (Shape::Bool, Type::Bool)
            | (Shape::Int | Shape::Shared, Type::Int)
            | (Shape::Float, Type::Float)
            | (Shape::Time, Type::Time)
            | (Shape::Duration, Type::Duration)
            | (Shape::Robot, Type::Robot)
            | (Shape::Point, Type::Point)
            | (Shape::Message, Type::Record(_)) => true,
            (Shape::Side, Type::Enum(index)) => self.variants(*index) == SIDES,
            (Shape::Planner, Type::Enum(index)) => {
                self.variants(*index) == PLANNERS.map(|(name, _)| name)
            }
            (Shape::MotionTrouble, Type::Enum(index)) => {
                self.variants(*index) == MOTION_TROUBLES.map(|(name, _)| name)
            }
            (Shape::ElectionAlgorithm, Type::Enum(index)) => {
                self.variants(*index) == ELECTION_ALGORITHMS.map(|(name, _)| name)
            }
            (Shape::MutexAlgorithm, Type::Enum(index)) => {
                self.variants(*index) == MUTEX_ALGORITHMS.map(|(name, _)| name)
            }
            (Shape::Order, Type::Enum(index)) => {
                self.variants(*index) == ORDERS.map(|(name, _)| name)
            }
            (Shape::Detection, Type::Record(fields)) => {
                let kinds: Vec<Type> = fields.iter().map(|(_, kind)| kind.clone()).collect();
                const PARTS: [Shape; 3] = [
                    Shape::Optional(&Shape::Robot),
                    Shape::Optional(&Shape::Int),
                    Shape::Point,
                ];
                self.all(&PARTS, &kinds)
            }
            (Shape::Thing, Type::Record(fields)) => {
                let kinds: Vec<Type> = fields.iter().map(|(_, kind)| kind.clone()).collect();
                self.all(&[Shape::Int, Shape::Text, Shape::Point], &kinds)
            }
            (Shape::Optional(shape), Type::Optional(kind)) => self.is(*shape, kind),
            (_, Type::Object(index)) => match (shape, self.object(*index)) {
                (Shape::Text, Some(ObjectType::Text))
                | (Shape::Area, Some(ObjectType::Area))
                | (Shape::Obstacles, Some(ObjectType::Obstacles)) => true,
                (Shape::List(shape), Some(ObjectType::List(kind)))
                | (Shape::Set(shape), Some(ObjectType::Set(kind))) => self.is(*shape, kind),
                (Shape::Map(key, value), Some(ObjectType::Map(key_kind, value_kind))) => {
                    self.is(*key, key_kind) && self.is(*value, value_kind)
                }
                _ => false,
            },
            _ => false,
        }
    }
}
