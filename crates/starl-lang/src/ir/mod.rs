//! A program after checking: every name resolved, every expression with its type.
//!
//! The checker makes it, the compiler walks it without looking at the tree again. It is flat: tables
//! of declarations that refer to each other by number ([`EnumId`], [`VariableId`], ...), those of the
//! program, of its libraries and of the prelude together. A body is a tree of [`Statement`]s and
//! [`Expression`]s with a table of its [`Local`]s.
//!
//! Abbreviations of the source are expanded:
//! - a value where an optional is expected is wrapped in [`ExpressionKind::Present`]; there is no other implicit
//!   conversion;
//! - `elif` is an `if` in the `else`, `function f() -> T = e` has a body that returns `e`;
//! - arguments are in the order of the parameters;
//! - an action of a role has `role == ...` as the first part of its guard, a handler's body of a role is an `if`; the
//!   code for entering a role is its [`Role::entry`];
//! - a property without quantifier is one of a robot, and reads its variables by
//!   [`ExpressionKind::OfRobot`] as others do.
//!
//! Invariant of a program without errors: no [`Type::Error`] and no [`ExpressionKind::Error`] occurs,
//! types do not contain themselves, constants and records come after those that they are made of,
//! numbers are in range. Of a program with errors only the last is true: editors use those too.

mod declaration;
mod display;
mod expression;
mod id;
mod site;
mod statement;
mod tables;
mod types;

pub use declaration::*;
pub use expression::*;
pub use id::*;
pub use site::*;
pub use statement::*;
pub use types::*;

use alloc::string::String;
use alloc::vec::Vec;

/// A program, or a library that was checked by itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Its name.
    pub name: String,
    /// Whether it is a library.
    pub is_library: bool,
    /// The files: 0 is the program, 1 the prelude, others are imports.
    pub files: Vec<String>,
    /// Enums.
    pub enums: Vec<Enum>,
    /// Records and messages.
    pub records: Vec<Record>,
    /// Records in an order in which each follows its parts.
    pub record_order: Vec<RecordId>,
    /// The parameters that the scenario sets.
    pub parameters: Vec<Parameter>,
    /// Constants.
    pub constants: Vec<Constant>,
    /// Constants in an order in which each follows those that its value needs.
    pub constant_order: Vec<ConstantId>,
    /// State variables, in the order of the text; the variable `role` comes first, if there are roles.
    pub variables: Vec<Variable>,
    /// Shared variables.
    pub shared: Vec<Shared>,
    /// Primitives bound to names, by their instance numbers.
    pub bindings: Vec<Binding>,
    /// The models of the bindings, each once.
    pub models: Vec<Model>,
    /// Functions, used or not.
    pub functions: Vec<Function>,
    /// The `init` outside of roles; it runs after the variables have their initial values.
    pub init: Option<Procedure>,
    /// The roles.
    pub roles: Option<Roles>,
    /// Actions, in the order of the text, those of roles among them.
    pub actions: Vec<Action>,
    /// The invariants of variables, in the order of the text; the ranges of variables come first.
    pub checks: Vec<Check>,
    /// Handlers, in the order of the text, those of roles among them.
    pub handlers: Vec<Handler>,
    /// Properties, in the order of the text.
    pub properties: Vec<Property>,
}

impl Program {
    /// The type as a person writes it.
    #[must_use]
    pub fn type_name(&self, of: &Type) -> String {
        display::type_name(self, of)
    }

    /// The names of the values of a variable: the variants of its enum, or false and true; of any other type none.
    #[must_use]
    pub fn values_of(&self, variable: VariableId) -> Vec<&str> {
        match self[variable].ty {
            Type::Enum(of) => (self[of].variants.iter())
                .map(|variant| variant.name.as_str())
                .collect(),
            Type::Bool => Vec::from(["false", "true"]),
            _ => Vec::new(),
        }
    }

    /// The name of a message between robots, with the name of its library, so that messages of two libraries are not
    /// confused.
    #[must_use]
    pub fn message_name(&self, message: RecordId) -> String {
        let Record { name, site, .. } = &self[message];
        let library = self.files.get(site.file as usize);
        match library.filter(|_| site.file != 0) {
            Some(library) => alloc::format!("{library}.{name}"),
            None => name.clone(),
        }
    }

    /// Whether the type has a default value, which is all zeros and empty objects. Robots, areas, and types that must
    /// contain one have none.
    #[must_use]
    pub fn has_default(&self, of: &Type) -> bool {
        match of {
            Type::Robot | Type::Area | Type::Range => false,
            Type::Record(record) => self[*record]
                .fields
                .iter()
                .all(|field| field.ty == *of || self.has_default(&field.ty)),
            _ => true,
        }
    }

    /// Whether `<` compares values of the type.
    #[must_use]
    pub fn is_ordered(&self, of: &Type) -> bool {
        match of {
            Type::Int
            | Type::Float
            | Type::String
            | Type::Time
            | Type::Duration
            | Type::Robot
            | Type::Error => true,
            Type::Record(record) if self[*record].is_tuple() => {
                let mut fields = self[*record].fields.iter();
                fields.all(|field| self.is_ordered(&field.ty))
            }
            _ => false,
        }
    }

    /// Whether values of the type can be keys of maps and elements of sets.
    #[must_use]
    pub fn is_key(&self, of: &Type) -> bool {
        match of {
            Type::Bool
            | Type::Int
            | Type::String
            | Type::Robot
            | Type::Enum(_)
            | Type::Time
            | Type::Duration
            | Type::Point
            | Type::Error => true,
            Type::Record(record) => self[*record]
                .fields
                .iter()
                .all(|field| field.ty == *of || self.is_key(&field.ty)),
            _ => false,
        }
    }
}
