//! Warnings of what is declared and not used. Where the program has errors nothing is said: the use
//! may be there.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::scope::Entity;
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span, has_errors};

impl Checker {
    /// Warns of the program's declarations that are not used.
    pub fn warn_of_use(&mut self) {
        if !self.is_readable() || has_errors(&self.files[0].checked.diagnostics) {
            return;
        }
        self.file = 0;
        for (code, span, name) in core::mem::take(&mut self.unused_locals) {
            if !name.starts_with('_') {
                self.error(code, span, format!("`{name}` is never read"));
            }
        }
        let declared: Vec<(String, Entity, Span)> = (self.files[0].scope.iter())
            .map(|(name, declared)| (name.clone(), declared.entity, declared.span))
            .collect();
        for (name, entity, span) in declared {
            self.warn_of_entity(&name, entity, span);
        }
    }

    fn warn_of_entity(&mut self, name: &str, entity: Entity, span: Span) {
        if let Entity::Record(id) = entity
            && self.program[id].is_message
        {
            let (sent, handled) = (
                self.usage.sent.contains(&id.0),
                self.usage.handled.contains(&id.0),
            );
            match (sent, handled) {
                (true, true) => {}
                // A library is there for others to use.
                _ if self.program.is_library => {}
                (true, false) => {
                    let message = format!("no handler receives the message `{name}`");
                    let problem = Diagnostic::new(Code::MessageNotHandled, span, message);
                    self.report(problem.note(format!("a handler begins with `on {name}(...)`")));
                }
                _ => {
                    let message = format!("the message `{name}` is never sent");
                    self.error(Code::MessageNotSent, span, message);
                }
            }
            return;
        }
        if let Entity::Library(file) = entity {
            if !self.usage.imports.contains(&(0, file)) {
                let message = format!("the library `{name}` is not used");
                self.error(Code::UnusedImport, span, message);
            }
            return;
        }
        if self.usage.used.contains(&entity) || name.starts_with('_') {
            return;
        }
        let what = entity.what();
        match entity {
            Entity::Variable(_) | Entity::Shared(_) => {
                let message = format!("`{name}` is never read");
                let problem = Diagnostic::new(Code::NeverRead, span, message);
                let is_written = self.usage.written.contains(&entity);
                self.report(problem.note_if(is_written.then_some("it is only written")));
            }
            Entity::Function(_) | Entity::Constant(_) if self.program.is_library => {}
            Entity::Parameter(_)
            | Entity::Constant(_)
            | Entity::Function(_)
            | Entity::Binding(_) => {
                let message = format!("{what} is not used: `{name}`");
                self.error(Code::UnusedDeclaration, span, message);
            }
            _ => {}
        }
    }
}
