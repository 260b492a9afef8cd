//! Handlers of messages and of primitives' events. Handlers of inputs are in `input`.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::body::Where;
use super::report::{counted, did_you_mean, listed};
use super::resolution::Symbol;
use super::scope::Entity;
use super::shape::Letters;
use super::state::Checker;
use super::surroundings::Surroundings;
use super::tables::Event as EventSignature;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Event, Handler, RecordId, Statement, StatementKind, Type};
use crate::syntax::SyntaxToken;
use crate::syntax::ast;

/// The parameters of a handler: their names and types.
type Parts = Vec<(String, Type)>;

impl Checker {
    /// `on Message(from, a)` or `on primitive.event(a)`.
    pub fn check_handler(&mut self, role: Option<u16>, node: &ast::HandlerDeclaration) {
        if let Some(name) = node.input() {
            return self.check_input(role, node, &name);
        }
        let words: Vec<SyntaxToken> = node
            .event()
            .iter()
            .flat_map(ast::EventPath::words)
            .collect();
        let Some(first) = words.first() else { return };
        let start = Span::from(first.text_range());
        let span = words
            .last()
            .map_or(start, |last| start.to(last.text_range().into()));
        let (event, parts) = match words.get(1) {
            Some(name) => match self.imported(first) {
                Some(library) => self.library_event(library, name),
                None => self.primitive_event(first, name),
            },
            None => self.message_event(first),
        };
        let names: Vec<ast::Name> = node.parameters().collect();
        // With a part too few or too many the meaning of the names is unknown.
        let parts =
            parts.filter(|parts| self.check_parts(&event, parts, names.len(), span, first.text()));
        let types = parts.into_iter().flatten().map(|(_, ty)| ty);
        let types = types.chain(core::iter::repeat(Type::Error));
        let parameters = names.into_iter().map(Some).zip(types).collect();
        self.add_handler((event, span), role, node, parameters, None);
    }

    /// Checks the statements of a handler, and adds it to the program. In a role they begin with the question whether the
    /// robot has it. `unread` is the warning if nothing reads a parameter.
    pub(super) fn add_handler(
        &mut self,
        (event, span): (Event, Span),
        role: Option<u16>,
        node: &ast::HandlerDeclaration,
        parameters: Vec<(Option<ast::Name>, Type)>,
        unread: Option<Code>,
    ) {
        let ((parameters, body), locals) = self.in_body(Where::Effect, |checker| {
            let declare = |(name, ty): (Option<ast::Name>, Type)| {
                let local = checker.declare_local(&name?, ty, unread)?;
                checker.body.fixed[local.index()] = Some("a parameter of the handler");
                Some(local)
            };
            let parameters = parameters.into_iter().map(declare).collect();
            (parameters, checker.effect(node.body()))
        });
        let body = match self.in_role(role, span) {
            Some(condition) => {
                let kind = StatementKind::If {
                    condition,
                    then: body,
                    otherwise: Vec::new(),
                };
                Vec::from([Statement { kind, span }])
            }
            None => body,
        };
        let site = self.site(span);
        self.program.handlers.push(Handler {
            event,
            role,
            parameters,
            locals,
            body,
            site,
        });
    }

    fn message_event(&mut self, word: &SyntaxToken) -> (Event, Option<Parts>) {
        let (name, span) = (word.text(), Span::from(word.text_range()));
        let entity = self.declared(0, name);
        if let Some(Entity::Record(id)) = entity
            && self.program[id].is_message
        {
            self.resolve(span, Symbol::Record(id));
            return self.handled(id);
        }
        if self.is_probe(span) {
            self.note_probe(Surroundings::Event);
        }
        if entity == Some(Entity::Broken) || self.may_be_unread(name) {
            return (Event::Error, None);
        }
        let message = match entity {
            Some(entity) => format!("`{name}` is {}, not a message", entity.what()),
            None => format!("there is no message `{name}`"),
        };
        let problem = Diagnostic::new(Code::UnknownEvent, span, message);
        let messages = (self.program.records.iter().enumerate())
            .filter(|(_, record)| record.is_message)
            .map(|(number, record)| (record, self.program.message_name(RecordId(number as u32))));
        let messages: Vec<_> = messages.collect();
        let of_library = messages.iter().find(|(record, _)| record.name == name);
        let problem = match of_library {
            Some((_, full)) => problem.replace(format!("did you mean `{full}`?"), span, full),
            None => {
                let names = messages.iter().map(|(_, full)| full.as_str());
                did_you_mean(problem, span, name, names)
            }
        };
        self.report(match (entity, &problem.fix) {
            (Some(Entity::Binding(_)), _) => {
                problem.note("an event of a primitive is written `on name.event(...)`")
            }
            (None, None) => problem
                .note(format!("a message is declared: `message {name}(x: Int)`"))
                .note(format!(
                    "an operator's order is handled by `on input {name}(x: Int)`"
                )),
            _ => problem,
        });
        (Event::Error, None)
    }

    /// The library that a word stands for.
    fn imported(&mut self, word: &SyntaxToken) -> Option<u32> {
        let Entity::Library(library) = self.declared(0, word.text())? else {
            return None;
        };
        self.usage.imports.insert((0, library));
        self.resolve_entity(word.text_range().into(), Entity::Library(library));
        Some(library)
    }

    /// `library.Message`
    fn library_event(&mut self, library: u32, word: &SyntaxToken) -> (Event, Option<Parts>) {
        let (name, span) = (word.text(), Span::from(word.text_range()));
        match self.library_entity(library, name, span) {
            Some(Entity::Record(id)) if self.program[id].is_message => self.handled(id),
            Some(entity) if entity != Entity::Broken => {
                let message = format!("`{name}` is {}, not a message", entity.what());
                self.error(Code::UnknownEvent, span, message);
                (Event::Error, None)
            }
            _ => (Event::Error, None),
        }
    }

    /// A message that is handled, with the sender and its fields.
    fn handled(&mut self, message: RecordId) -> (Event, Option<Parts>) {
        self.usage.handled.insert(message.0);
        self.usage.used.insert(Entity::Record(message));
        let fields = self.program[message].fields.iter();
        let fields = fields.map(|field| (field.name.clone(), field.ty.clone()));
        let sender = ("from".to_string(), Type::Robot);
        let parts = [sender].into_iter().chain(fields).collect();
        (Event::Message(message), Some(parts))
    }

    fn primitive_event(
        &mut self,
        primitive: &SyntaxToken,
        name: &SyntaxToken,
    ) -> (Event, Option<Parts>) {
        let span = Span::from(primitive.text_range());
        let entity = self.declared(0, primitive.text());
        if self.is_probe(span) {
            self.note_probe(Surroundings::Event);
        }
        let Some(Entity::Binding(id)) = entity else {
            if entity != Some(Entity::Broken) && !self.may_be_unread(primitive.text()) {
                let message = format!("there is no primitive `{}`", primitive.text());
                let problem = Diagnostic::new(Code::UnknownEvent, span, message);
                let names = self
                    .program
                    .bindings
                    .iter()
                    .map(|binding| binding.name.as_str());
                let problem = did_you_mean(problem, span, primitive.text(), names);
                self.report(problem);
            }
            return (Event::Error, None);
        };
        self.usage.used.insert(Entity::Binding(id));
        self.resolve(span, Symbol::Binding(id));
        if self.is_probe(name.text_range().into()) {
            self.note_probe(Surroundings::EventOf(Symbol::Binding(id)));
        }
        let Some(kind) = self.program[id].primitive else {
            return (Event::Error, None);
        };
        let Some(event) = kind.event(name.text()) else {
            let at = Span::from(name.text_range());
            let message = format!("{} has no event `{}`", kind.name(), name.text());
            let problem = Diagnostic::new(Code::UnknownEvent, at, message);
            let names = || kind.events.iter().map(EventSignature::name);
            let problem = did_you_mean(problem, at, name.text(), names());
            let is_flag = kind.member(name.text()).is_some();
            self.report(if is_flag {
                let form = format!(
                    "ask for it in a guard: `pre {}.{}`",
                    primitive.text(),
                    name.text()
                );
                problem.note(form)
            } else if kind.events.is_empty() {
                problem.note("it has no events; read its flags in guards")
            } else {
                problem.note(format!("its events are {}", listed(names())))
            });
            return (Event::Error, None);
        };
        if let Some(symbol) = Symbol::event(kind, event) {
            self.resolve(name.text_range().into(), symbol);
        }
        let signature = event.signature();
        let parts = (signature.parameters.iter())
            .map(|part| {
                let ty = self.shape_type(&part.shape, &Letters::new());
                (part.name.to_string(), ty.unwrap_or(Type::Error))
            })
            .collect();
        (Event::Primitive { binding: id, event }, Some(parts))
    }

    /// Whether there is a name for each part; reports too many or too few. Of what a primitive reports
    /// the last parts may be left out.
    fn check_parts(
        &mut self,
        event: &Event,
        parts: &Parts,
        given: usize,
        span: Span,
        name: &str,
    ) -> bool {
        let may_be_fewer = matches!(event, Event::Primitive { .. });
        if given == parts.len() || may_be_fewer && given < parts.len() {
            return true;
        }
        let names: Vec<&str> = parts.iter().map(|(name, _)| name.as_str()).collect();
        let message = format!(
            "a handler of `{}` has {}",
            self.text(span),
            counted(parts.len(), "name")
        );
        let problem = Diagnostic::new(Code::HandlerParameters, span, message);
        let problem = problem.expected(format!("`on {}({})`", self.text(span), names.join(", ")));
        let problem = problem.found(counted(given, "name"));
        self.report(match event {
            Event::Message(_) if given + 1 == parts.len() => {
                problem.note("the first is the sender; write `_` for an unused one")
            }
            _ => problem.note(format!("write `_` for an unused part of `{name}`")),
        });
        false
    }
}
