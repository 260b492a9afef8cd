//! Calls: of functions, built-in ones, records, methods and primitives.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::arguments::Parameters;
use super::report::{around, article, broken, made};
use super::resolution::Symbol;
use super::scope::Entity;
use super::shape::Letters;
use super::state::{Checker, Needed};
use super::tables::{Builtin, Primitive};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, FunctionId, RecordId, Root, Site, Type};
use crate::syntax::ast::{self, AstNode};

impl Checker {
    /// A call.
    pub fn call(&mut self, node: &ast::CallExpression, span: Span) -> Expression {
        let arguments: Vec<ast::Argument> = node.arguments().collect();
        if let Some((argument, clause)) =
            (arguments.iter()).find_map(|argument| Some((argument, argument.comprehension()?)))
        {
            let builtin = match (node.callee(), &arguments[..]) {
                (Some(ast::Expression::Name(name)), [_]) if argument.name().is_none() => {
                    self.extreme(&name)
                }
                _ => None,
            };
            return match builtin {
                Some(builtin) => self.best(builtin, argument, &clause, span),
                None => self.misplaced_comprehension(argument),
            };
        }
        match node.callee() {
            Some(ast::Expression::Name(name)) => self.call_name(&name, &arguments, span),
            Some(ast::Expression::Field(field)) => self.call_member(&field, &arguments, span),
            Some(callee) => {
                let value = self.infer(Some(callee), None);
                self.not_callable(&value);
                self.broken_call(&arguments, span)
            }
            None => broken(span),
        }
    }

    /// The built-in function `min` or `max` that a name stands for.
    fn extreme(&mut self, name: &ast::NameExpression) -> Option<Builtin> {
        let (text, at) = (name.text(), name.span());
        let scope = &self.files[self.file as usize].scope;
        let is_taken = self.body.find(&text).is_some() || scope.contains_key(&text);
        let builtin = Builtin::named(&text).filter(|_| !is_taken)?;
        matches!(builtin, Builtin::Min | Builtin::Max).then(|| {
            self.resolve(at, Symbol::Builtin(builtin));
            builtin
        })
    }

    /// Reports a comprehension among the arguments of something that takes none.
    pub fn misplaced_comprehension(&mut self, argument: &ast::Argument) -> Expression {
        let span = argument.span();
        let message = "only `min` and `max`, without other arguments, take elements like this";
        let problem = Diagnostic::new(Code::Misplaced, span, message);
        self.refuse(problem.fix(around("put it in brackets: a list", span, "[", "]")))
    }

    fn call_name(
        &mut self,
        node: &ast::NameExpression,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        let name = node.text();
        let at = node.span();
        let local = self.body.find(&name).is_some();
        let declared = self.declared(self.file, &name);
        let callable = matches!(
            declared,
            Some(Entity::Function(_) | Entity::Record(_) | Entity::Broken)
        );
        if let Some(entity) = declared.filter(|_| callable && !local) {
            self.resolve_entity(at, entity);
            return self.call_entity(entity, &name, arguments, span);
        }
        if let Some(builtin) = Builtin::named(&name) {
            self.resolve(at, Symbol::Builtin(builtin));
            return self.call_builtin(builtin, at, arguments, span);
        }
        if let Some(entity) = self.declared(super::prelude::FILE, &name) {
            self.resolve_entity(at, entity);
            return self.call_entity(entity, &name, arguments, span);
        }
        if local || declared.is_some() {
            let value = self.name(&name, at, None);
            self.not_callable(&value);
        } else {
            self.unknown_function(&name, at);
        }
        self.broken_call(arguments, span)
    }

    fn unknown_function(&mut self, name: &str, span: Span) {
        if self.is_probe(span) {
            self.note_probed_value(None);
        }
        if self.may_be_unread(name) {
            return;
        }
        if let Some(primitive) = Primitive::named(name) {
            let message = format!("the primitive `{name}` is bound to a name outside of actions");
            let problem = Diagnostic::new(Code::NoValue, span, message);
            self.report(problem.note(format!("such as `name = {}`", primitive.constructor)));
            return;
        }
        let problem = if self.actions.contains(name) {
            let message = format!("the action `{name}` cannot be called");
            let problem = Diagnostic::new(Code::NotCallable, span, message);
            problem.note("an action fires by itself when its guard holds")
        } else {
            let message = format!("there is no function `{name}`");
            let problem = Diagnostic::new(Code::UnknownName, span, message);
            self.suggest(problem, name, span)
        };
        self.report(problem);
    }

    /// A call of a declaration of a file.
    pub fn call_entity(
        &mut self,
        entity: Entity,
        name: &str,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        match entity {
            Entity::Function(id) => self.call_function(id, arguments, span),
            Entity::Record(id) => self.make_record(id, arguments, span),
            Entity::Broken => self.broken_call(arguments, span),
            _ => {
                let message = format!("`{name}` is {} and cannot be called", entity.what());
                self.error(Code::NotCallable, span, message);
                self.broken_call(arguments, span)
            }
        }
    }

    fn call_function(
        &mut self,
        id: FunctionId,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        self.usage.used.insert(Entity::Function(id));
        self.need(Needed::Function(id));
        self.resolve_names(arguments, |checker, name| {
            let function = &checker.program[id];
            let mut parameters = function.locals[..function.parameters as usize].iter();
            let span = parameters.find(|local| local.name == name)?.span;
            let file = function.site.file;
            Some(Symbol::Local(Site { file, span }))
        });
        let function = &self.program[id];
        let result = function.result.clone();
        let name = function.name.clone();
        let parameters: Vec<(String, Type)> = function.locals[..function.parameters as usize]
            .iter()
            .map(|local| (local.name.clone(), local.ty.clone()))
            .collect();
        let arguments = self.typed_arguments(&name, &parameters, arguments, span);
        let kind = ExpressionKind::Call {
            function: id,
            arguments,
        };
        made(kind, result, span)
    }

    fn make_record(&mut self, id: RecordId, arguments: &[ast::Argument], span: Span) -> Expression {
        self.usage.used.insert(Entity::Record(id));
        if self.program[id].is_message {
            self.usage.sent.insert(id.0);
        }
        self.resolve_names(arguments, |checker, name| {
            let mut fields = checker.program[id].fields.iter();
            let number = fields.position(|field| field.name == name)?;
            Some(Symbol::Field(id, number as u32))
        });
        let record = &self.program[id];
        let name = record.name.clone();
        let fields: Vec<(String, Type)> = (record.fields.iter())
            .map(|field| (field.name.clone(), field.ty.clone()))
            .collect();
        let values = self.typed_arguments(&name, &fields, arguments, span);
        made(ExpressionKind::Record(values), Type::Record(id), span)
    }

    pub fn not_callable(&mut self, value: &Expression) {
        if value.ty == Type::Error {
            return;
        }
        let message = format!("{} cannot be called", article(&self.name_of(&value.ty)));
        self.error(Code::NotCallable, value.span, message);
    }

    /// A call with the receiver or primitive that has it.
    fn call_member(
        &mut self,
        field: &ast::FieldExpression,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        let Some(word) = field.field() else {
            self.infer(field.base(), None);
            return broken(span);
        };
        let (name, at) = (word.text(), Span::from(word.text_range()));
        match field.base().and_then(|base| self.namespace(&base)) {
            Some(Entity::Library(file)) => match self.library_entity(file, name, at) {
                Some(entity) => self.call_entity(entity, name, arguments, span),
                None => self.broken_call(arguments, span),
            },
            Some(Entity::Binding(id)) => self.call_primitive(id, name, at, arguments, span),
            Some(Entity::Enum(id)) => {
                let value = self.qualified_variant(id, name, at);
                self.not_callable(&value);
                broken(span)
            }
            Some(_) => self.broken_call(arguments, span),
            None => self.call_method(field, name, at, arguments, span),
        }
    }

    fn call_primitive(
        &mut self,
        id: crate::ir::BindingId,
        name: &str,
        at: Span,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        let Some(member) = self.primitive_member(id, name, at) else {
            return self.broken_call(arguments, span);
        };
        let signature = member.signature();
        if !signature.is_call {
            let message = format!("`{name}` is not called");
            let problem = Diagnostic::new(Code::NotCallable, at, message);
            let brackets = Span::new(at.end, span.end);
            self.report(problem.replace("remove the brackets", brackets, ""));
            self.broken_call(arguments, at);
            return self.primitive_value(id, member, Vec::new(), &signature, at, span);
        }
        self.resolve_arguments(arguments, member.text, &signature);
        let arranged = self.arrange(&Parameters::of(&signature), arguments, span);
        let values = self.shaped_arguments(&signature, arranged.values, &mut Letters::new(), span);
        self.note_evaluation(id, &values);
        self.primitive_value(id, member, values, &signature, at, span)
    }

    /// A call of a method of a value.
    fn call_method(
        &mut self,
        field: &ast::FieldExpression,
        name: &str,
        at: Span,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        // To change something is not to read it.
        let root = field.base().and_then(|base| self.root(&base));
        let was_read = root.is_none_or(|root| self.is_read(root));
        let receiver = self.infer(field.base(), None);
        let Some(method) = self.method(&receiver, name, at) else {
            return self.broken_call(arguments, span);
        };
        let signature = method.signature();
        let mut letters = Letters::new();
        let fits = (signature.receiver.as_ref())
            .is_none_or(|shape| self.shape_matches(shape, &receiver.ty, &mut letters));
        if !fits {
            let found = self.name_of(&receiver.ty);
            let message = format!("`{name}` does not apply to {found}");
            let problem = Diagnostic::new(Code::WrongType, receiver.span, message);
            let expected = signature.receiver.as_ref();
            let expected = expected.map(|shape| self.shape_name(shape, &Letters::new()));
            self.report(problem.expected(expected.unwrap_or_default()));
            letters.clear();
        }
        self.resolve_arguments(arguments, method.text(), &signature);
        let arranged = self.arrange(&Parameters::of(&signature), arguments, span);
        let arguments = self.shaped_arguments(&signature, arranged.values, &mut letters, span);
        let arguments: Vec<Expression> = arguments.into_iter().flatten().collect();
        let ty = self.shape_type(&signature.result, &letters);
        let kind = if method.changes() {
            if let Some(root) = root.filter(|_| !was_read) {
                self.forget_read(root);
            }
            let Some(place) = field.base().map(|base| self.place(&base)) else {
                return broken(span);
            };
            if place.root == Root::Error {
                return broken(span);
            }
            ExpressionKind::Change {
                place: Box::new(place),
                method,
                arguments,
            }
        } else {
            ExpressionKind::Method {
                receiver: Box::new(receiver),
                method,
                arguments,
            }
        };
        made(kind, ty.unwrap_or(Type::Error), span)
    }
}
