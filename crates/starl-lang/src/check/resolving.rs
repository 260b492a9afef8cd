//! Records the meanings of names: see [`super::resolution`].

use super::resolution::Symbol;
use super::scope::Entity;
use super::state::Checker;
use crate::diagnostic::Span;
use crate::ir::{Local, LocalId};

impl Checker {
    /// Records the meaning of a name in the current file.
    pub fn resolve(&mut self, span: Span, symbol: Symbol) {
        let site = self.site(span);
        self.resolutions.uses.push((site, symbol));
    }

    /// The same for a declaration.
    pub fn resolve_entity(&mut self, span: Span, entity: Entity) {
        if let Some(symbol) = entity.symbol() {
            self.resolve(span, symbol);
        }
    }

    /// The same for a local of the present body.
    pub fn resolve_local(&mut self, span: Span, local: LocalId) {
        let site = self.site(self.body.locals[local.index()].span);
        self.resolve(span, Symbol::Local(site));
    }

    /// Notes the locals of a body that was checked.
    pub fn resolve_locals(&mut self, locals: &[Local]) {
        for local in locals {
            // The robot that a property is about by itself has no name in the text.
            if self.text(local.span) == local.name {
                let site = self.site(local.span);
                self.resolutions.locals.push((site, local.ty.clone()));
            }
        }
    }
}
