//! Calls: of functions, built-in ones, records, methods and primitives.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::report::{article, broken, counted, did_you_mean, made, something};
use super::scope::Entity;
use super::shape::Letters;
use super::state::{Checker, Needed};
use super::tables::{Builtin, Primitive, Shape, Signature};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, FunctionId, RecordId, Root, Type};
use crate::syntax::ast::{self, AstNode};

/// Arguments sorted by parameters.
pub(super) struct Arranged {
    pub values: Vec<Option<ast::Expression>>,
    /// Those beyond the parameters, with their names.
    pub rest: Vec<(Option<String>, ast::Expression)>,
}

/// What may be called with which arguments.
pub(super) struct Parameters<'a> {
    /// What is called, for messages.
    pub callee: &'a str,
    /// Names, and whether each may be left out.
    pub names: Vec<(&'a str, bool)>,
    pub takes_values: bool,
    pub takes_fields: bool,
}

impl<'a> Parameters<'a> {
    pub fn of(signature: &'a Signature) -> Self {
        Self {
            callee: signature.name,
            names: (signature.parameters.iter())
                .map(|parameter| (parameter.name, parameter.is_optional))
                .collect(),
            takes_values: signature.takes_values,
            takes_fields: signature.takes_fields,
        }
    }
}

impl Checker {
    /// A call.
    pub fn call(&mut self, node: &ast::CallExpression, span: Span) -> Expression {
        let arguments: Vec<ast::Argument> = node.arguments().collect();
        match node.callee() {
            Some(ast::Expression::Name(name)) => self.call_name(&name, &arguments, span),
            Some(ast::Expression::Field(field)) => self.call_member(&field, &arguments, span),
            Some(callee) => {
                let value = self.infer(Some(callee), None);
                self.not_callable(&value);
                self.check_anyway(&arguments);
                broken(span)
            }
            None => broken(span),
        }
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
        let scope = &self.files[self.file as usize].scope;
        let declared = scope.get(&name).map(|declared| declared.entity);
        let callable = matches!(
            declared,
            Some(Entity::Function(_) | Entity::Record(_) | Entity::Broken)
        );
        if let Some(entity) = declared.filter(|_| callable && !local) {
            return self.call_entity(entity, &name, arguments, span);
        }
        if let Some(builtin) = Builtin::named(&name) {
            return self.call_builtin(builtin, at, arguments, span);
        }
        let common = &self.files[super::prelude::FILE as usize].scope;
        if let Some(declared) = common.get(&name).copied() {
            return self.call_entity(declared.entity, &name, arguments, span);
        }
        if local || declared.is_some() {
            let value = self.name(&name, at, None);
            self.not_callable(&value);
        } else {
            self.unknown_function(&name, at);
        }
        self.check_anyway(arguments);
        broken(span)
    }

    fn unknown_function(&mut self, name: &str, span: Span) {
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

    /// A call of what a file declares.
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
            Entity::Broken => {
                self.check_anyway(arguments);
                broken(span)
            }
            _ => {
                let message = format!("`{name}` is {} and cannot be called", entity.what());
                self.error(Code::NotCallable, span, message);
                self.check_anyway(arguments);
                broken(span)
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
        let record = &self.program[id];
        let name = record.name.clone();
        let fields: Vec<(String, Type)> = (record.fields.iter())
            .map(|field| (field.name.clone(), field.ty.clone()))
            .collect();
        let values = self.typed_arguments(&name, &fields, arguments, span);
        made(ExpressionKind::Record(values), Type::Record(id), span)
    }

    /// An argument for each parameter, all of which must be given.
    fn typed_arguments(
        &mut self,
        callee: &str,
        parameters: &[(String, Type)],
        arguments: &[ast::Argument],
        span: Span,
    ) -> Vec<Expression> {
        let names = Parameters {
            callee,
            names: parameters
                .iter()
                .map(|(name, _)| (name.as_str(), false))
                .collect(),
            takes_values: false,
            takes_fields: false,
        };
        let arranged = self.arrange(&names, arguments, span);
        (arranged.values.into_iter().zip(parameters))
            .map(|(value, (name, ty))| match value {
                Some(value) => self.expect(Some(value), ty, &format!("the argument `{name}`")),
                None => broken(span),
            })
            .collect()
    }

    fn call_builtin(
        &mut self,
        builtin: Builtin,
        at: Span,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Expression {
        let signature = builtin.signature();
        if !signature.is_call {
            let message = format!("`{}` is not called", signature.name);
            let problem = Diagnostic::new(Code::NotCallable, at, message);
            let brackets = Span::new(at.end, span.end);
            self.report(problem.replace("remove the brackets", brackets, ""));
            return self.name(signature.name, at, None);
        }
        if !self.allowed(builtin.purity(), signature.name, at) {
            self.check_anyway(arguments);
            let ty = self.shape_type(&signature.result, &Letters::new());
            return made(ExpressionKind::Error, something(ty), span);
        }
        let arranged = self.arrange(&Parameters::of(&signature), arguments, span);
        let mut letters = Letters::new();
        let values = self.shaped_arguments(&signature, arranged.values, &mut letters, span);
        let rest: Vec<_> = (arranged.rest.into_iter())
            .map(|(name, value)| (name, self.value(Some(value), None, "this")))
            .collect();
        if builtin == Builtin::Log {
            self.check_format(&values, rest.len());
        }
        let ty = self.shape_type(&signature.result, &letters);
        let kind = ExpressionKind::Builtin {
            builtin,
            arguments: values,
            rest,
        };
        made(kind, ty.unwrap_or(Type::Error), span)
    }

    /// Arguments by the shapes of a signature's parameters; those left out are none.
    pub fn shaped_arguments(
        &mut self,
        signature: &Signature,
        values: Vec<Option<ast::Expression>>,
        letters: &mut Letters,
        span: Span,
    ) -> Vec<Option<Expression>> {
        let mut checked = Vec::with_capacity(values.len());
        for (value, parameter) in values.into_iter().zip(&signature.parameters) {
            checked.push(match value {
                Some(value) => {
                    let role = format!("the argument `{}`", parameter.name);
                    Some(self.shaped(value, &parameter.shape, letters, &role))
                }
                None if parameter.is_optional => None,
                None => Some(broken(span)),
            });
        }
        checked
    }

    fn shaped(
        &mut self,
        value: ast::Expression,
        shape: &Shape,
        letters: &mut Letters,
        role: &str,
    ) -> Expression {
        if let Some(expected) = self.shape_type(shape, letters) {
            return self.expect(Some(value), &expected, role);
        }
        let value = self.value(Some(value), None, role);
        let before = letters.clone();
        if self.shape_matches(shape, &value.ty, letters) {
            return value;
        }
        *letters = before;
        let code = if matches!(value.ty, Type::Optional(_)) {
            Code::MayBeNone
        } else {
            Code::WrongType
        };
        let message = match code {
            Code::MayBeNone => format!("{role} may be none"),
            _ => format!("{role} has the wrong type"),
        };
        let problem = Diagnostic::new(code, value.span, message);
        let expected = self.shape_name(shape, letters);
        let found = self.name_of(&value.ty);
        self.report(problem.expected(expected).found(found));
        broken(value.span)
    }

    /// Sorts arguments by parameters and reports what does not fit.
    pub fn arrange(
        &mut self,
        parameters: &Parameters<'_>,
        arguments: &[ast::Argument],
        span: Span,
    ) -> Arranged {
        let mut values: Vec<Option<ast::Expression>> =
            parameters.names.iter().map(|_| None).collect();
        let mut rest = Vec::new();
        let mut position = 0;
        let mut surplus = None;
        for argument in arguments {
            let Some(value) = argument.value() else {
                continue;
            };
            let Some(name) = argument.name() else {
                match values.get_mut(position) {
                    Some(place @ None) => *place = Some(value),
                    Some(_) => {}
                    None if parameters.takes_values => rest.push((None, value)),
                    None => surplus = surplus.or(Some((argument.span(), value))),
                }
                position += 1;
                continue;
            };
            let (text, at) = (name.text(), name.span());
            match parameters.names.iter().position(|(own, _)| *own == text) {
                Some(number) if values[number].is_none() => values[number] = Some(value),
                Some(_) => {
                    let message = format!("`{text}` is given twice");
                    self.error(Code::ArgumentCount, at, message);
                }
                None if parameters.takes_fields => rest.push((Some(text), value)),
                None => {
                    let message = format!("`{}` has no parameter `{text}`", parameters.callee);
                    let problem = Diagnostic::new(Code::ArgumentName, at, message);
                    let names = parameters.names.iter().map(|(name, _)| *name);
                    let problem = did_you_mean(problem, at, &text, names);
                    self.report(problem);
                    // What it was meant for is not missing.
                    return Arranged { values, rest };
                }
            }
        }
        let given = arguments.len();
        if let Some((at, _)) = surplus {
            self.wrong_count(parameters, given, at);
        } else if let Some((name, _)) = (parameters.names.iter().zip(&values))
            .find(|((_, optional), value)| !optional && value.is_none())
            .map(|(parameter, _)| *parameter)
        {
            let message = format!("`{}` needs `{name}`", parameters.callee);
            let at = Span::new(span.end.saturating_sub(1), span.end);
            let problem = Diagnostic::new(Code::ArgumentCount, at, message);
            let problem = self.with_count(problem, parameters, given);
            self.report(problem);
        }
        Arranged { values, rest }
    }

    fn wrong_count(&mut self, parameters: &Parameters<'_>, given: usize, at: Span) {
        let message = format!("`{}` takes no such argument", parameters.callee);
        let problem = Diagnostic::new(Code::ArgumentCount, at, message);
        let problem = self.with_count(problem, parameters, given);
        self.report(problem);
    }

    fn with_count(
        &self,
        problem: Diagnostic,
        parameters: &Parameters<'_>,
        given: usize,
    ) -> Diagnostic {
        let most = parameters.names.len();
        let least = parameters
            .names
            .iter()
            .filter(|(_, optional)| !optional)
            .count();
        let expected = if least == most {
            counted(most, "argument")
        } else {
            format!("{least} to {}", counted(most, "argument"))
        };
        let names: Vec<String> = (parameters.names.iter())
            .map(|(name, optional)| format!("{name}{}", if *optional { "?" } else { "" }))
            .collect();
        let form = format!("{}({})", parameters.callee, names.join(", "));
        problem
            .expected(expected)
            .found(given.to_string())
            .note(form)
    }

    /// Looks for errors in the arguments of what cannot be called.
    pub fn check_anyway(&mut self, arguments: &[ast::Argument]) {
        for argument in arguments {
            if let Some(value) = argument.value().filter(|value| !self.needs_hint(value)) {
                self.infer(Some(value), None);
            }
        }
    }

    pub fn not_callable(&mut self, value: &Expression) {
        if value.ty == Type::Error {
            return;
        }
        let message = format!("{} cannot be called", article(&self.name_of(&value.ty)));
        self.error(Code::NotCallable, value.span, message);
    }

    /// Warns if the `{}` of a text do not match the values after it.
    fn check_format(&mut self, arguments: &[Option<Expression>], values: usize) {
        let Some(Some(format)) = arguments.first() else {
            return;
        };
        let ExpressionKind::String(text) = &format.kind else {
            return;
        };
        let places = text.matches("{}").count();
        if places != values {
            let message = format!(
                "the text has {places} `{{}}`, for {}",
                counted(values, "value")
            );
            self.error(Code::FormatValues, format.span, message);
        }
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
                None => {
                    self.check_anyway(arguments);
                    broken(span)
                }
            },
            Some(Entity::Binding(id)) => self.call_primitive(id, name, at, arguments, span),
            Some(Entity::Enum(id)) => {
                let value = self.qualified_variant(id, name, at);
                self.not_callable(&value);
                broken(span)
            }
            Some(_) => {
                self.check_anyway(arguments);
                broken(span)
            }
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
            self.check_anyway(arguments);
            return broken(span);
        };
        let signature = member.signature();
        if !signature.is_call {
            let message = format!("`{name}` is not called");
            let problem = Diagnostic::new(Code::NotCallable, at, message);
            let brackets = Span::new(at.end, span.end);
            self.report(problem.replace("remove the brackets", brackets, ""));
            self.check_anyway(arguments);
            return self.primitive_value(id, member, Vec::new(), &signature, at, span);
        }
        let arranged = self.arrange(&Parameters::of(&signature), arguments, span);
        let values = self.shaped_arguments(&signature, arranged.values, &mut Letters::new(), span);
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
            self.check_anyway(arguments);
            return broken(span);
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
