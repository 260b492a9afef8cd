//! The syntactic context at a position, for completing a name in an editor.
//!
//! The editor replaces the name that is being typed by the probe, a name that no declaration has. The checker records
//! the context when it reaches the probe.

use alloc::string::String;
use alloc::vec::Vec;

use super::body::Where;
use super::resolution::Symbol;
use super::state::Checker;
use super::tables::Purity;
use crate::diagnostic::Span;
use crate::ir::{Local, Type};
use crate::syntax::ast::{self, AstNode};

/// The context of a name that is being typed.
#[derive(Clone, Debug, PartialEq)]
pub enum Surroundings {
    /// It is a value, something that is called or something that is assigned to.
    Value(Reach),
    /// It is a part of a value of this type.
    Member {
        /// The type.
        of: Type,
        /// Whether it is in a property.
        in_property: bool,
    },
    /// It is a part of a library, a bound primitive or an enum.
    Part(Symbol),
    /// It is a type.
    Type,
    /// It is a kind of primitive.
    Primitive,
    /// It is a message or a primitive that reports something.
    Event,
    /// It is what this primitive reports.
    EventOf(Symbol),
}

/// The declarations in scope where a value is expected.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// The locals, the innermost last.
    pub locals: Vec<Local>,
    /// The expected type, if any.
    pub expected: Option<Type>,
    /// The highest purity of the built-in functions and primitives that may be used.
    pub purity: Purity,
    /// Whether the state is seen.
    pub sees_state: bool,
    /// Whether parameters are seen.
    pub sees_parameters: bool,
    /// Whether bound primitives are seen.
    pub sees_primitives: bool,
    /// Whether it is in a property.
    pub in_property: bool,
    /// If it is an argument: the parameters that are not given yet.
    pub parameters: Vec<String>,
}

impl Checker {
    /// Whether the name at `span` is the probe.
    pub fn is_probe(&self, span: Span) -> bool {
        self.file == 0 && self.probe == Some(span.start)
    }

    /// Whether the probe is in the expression.
    pub fn holds_probe(&self, expression: &ast::Expression) -> bool {
        let Some(probe) = self.probe.filter(|_| self.file == 0) else {
            return false;
        };
        let span = expression.span();
        span.start <= probe && probe < span.end
    }

    /// Records the context of the probe, when it is first reached.
    pub fn note_probe(&mut self, surroundings: Surroundings) {
        self.surroundings.get_or_insert(surroundings);
    }

    /// Notes of which parameters the probe may be the name, if it is one of the arguments.
    pub fn note_probed_arguments(&mut self, names: &[(&str, bool)], arguments: &[ast::Argument]) {
        let is_probe = |argument: &ast::Argument| match argument.value() {
            Some(ast::Expression::Name(name)) => {
                argument.name().is_none() && self.is_probe(name.span())
            }
            _ => false,
        };
        let Some(at) = arguments.iter().position(is_probe) else {
            return;
        };
        let given: Vec<String> = (arguments.iter())
            .filter_map(|argument| Some(argument.name()?.text()))
            .collect();
        let open = names.iter().skip(at).map(|(name, _)| *name);
        let open = open.filter(|name| given.iter().all(|given| given != name));
        self.probed_parameters = open.map(String::from).collect();
    }

    /// The same where it is a value.
    pub fn note_probed_value(&mut self, expected: Option<&Type>) {
        let place = self.body.place;
        let names = self.body.names.iter();
        let locals = names.map(|(_, local)| self.body.locals[local.index()].clone());
        let purities = [Purity::Effect, Purity::Query, Purity::Pure];
        let sees_state = matches!(
            place,
            Where::Initial(_) | Where::Guard | Where::Effect | Where::Property
        );
        let reach = Reach {
            locals: locals.collect(),
            expected: expected.cloned(),
            purity: (purities.into_iter())
                .find(|purity| place.allows(*purity))
                .unwrap_or(Purity::Pure),
            sees_state,
            sees_parameters: sees_state || place == Where::Binding,
            sees_primitives: matches!(place, Where::Guard | Where::Effect),
            in_property: place == Where::Property,
            parameters: core::mem::take(&mut self.probed_parameters),
        };
        self.note_probe(Surroundings::Value(reach));
    }
}
