//! Finds the context of the probe: see [`super::surroundings`].

use alloc::string::String;
use alloc::vec::Vec;

use super::body::Where;
use super::state::Checker;
use super::surroundings::{Reach, Surroundings};
use super::tables::Purity;
use crate::diagnostic::Span;
use crate::ir::Type;
use crate::syntax::ast::{self, AstNode};

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
