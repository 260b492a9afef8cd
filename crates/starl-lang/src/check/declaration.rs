//! Declarations: their values, bodies and effects.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::arguments::Parameters;
use super::body::{Body, Where};
use super::report::{article, did_you_mean, joined, listed, made};
use super::resolution::Symbol;
use super::returns::always_returns;
use super::scope::Entity;
use super::shape::Letters;
use super::state::{Behaviour, Checker, Needed, Progress};
use super::surroundings::Surroundings;
use super::tables::{Builtin, PRIMITIVES, Primitive, Signature};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::*;
use crate::syntax::ast::{self, AstNode, Named};

/// The word that names a primitive where one is bound, and its place.
pub(super) fn constructor(node: &ast::BindingDeclaration) -> Option<(String, Span)> {
    let callee = match node.value()? {
        ast::Expression::Call(call) => call.callee()?,
        other => other,
    };
    match callee {
        ast::Expression::Name(name) => Some((name.text(), name.span())),
        _ => None,
    }
}

impl Checker {
    /// Checks the contents of declarations.
    pub fn check_declarations(&mut self) {
        for id in self.constants_by_need() {
            self.check_constant(id);
        }
        for number in 0..self.nodes.functions.len() {
            self.check_function(FunctionId(number as u32));
        }
        self.file = 0;
        self.check_parameters();
        self.check_variables();
        self.check_shared();
        self.check_bindings();
        let behaviour = core::mem::take(&mut self.nodes.behaviour);
        for part in &behaviour {
            match part {
                Behaviour::Init(role, node) => self.check_init(*role, node),
                Behaviour::Action(role, node) => self.check_action(*role, node),
                Behaviour::Handler(role, node) => self.check_handler(*role, node),
                Behaviour::Check(node) => self.check_check(node),
                Behaviour::Property(node) => self.check_property(node),
            }
        }
        self.nodes.behaviour = behaviour;
        self.check_keys();
    }

    /// Checks something in a body of its own; gives its locals too.
    pub fn in_body<T>(
        &mut self,
        place: Where,
        check: impl FnOnce(&mut Self) -> T,
    ) -> (T, Vec<Local>) {
        let outer = core::mem::replace(&mut self.body, Body::new(place));
        let result = check(self);
        let body = core::mem::replace(&mut self.body, outer);
        if self.file == 0 {
            let unread = body.unread();
            self.unused_locals
                .extend(unread.map(|(code, local)| (code, local.span, local.name.clone())));
        }
        self.resolve_locals(&body.locals);
        (result, body.locals)
    }

    /// Checks a constant, unless that is done or under way.
    pub fn check_constant(&mut self, id: ConstantId) {
        if self.constants[id.index()] != Progress::Untouched {
            return;
        }
        self.constants[id.index()] = Progress::UnderWay;
        let (file, node) = self.nodes.constants[id.index()].clone();
        let outer_file = core::mem::replace(&mut self.file, file);
        let outer_user = self.user.replace(Needed::Constant(id));
        let (value, locals) = self.in_body(Where::Constant, |checker| {
            let value = match node.ty() {
                Some(ty) => {
                    let ty = checker.written(&ty);
                    checker.expect(node.value(), &ty, "the value")
                }
                None => checker.value(node.value(), None, "the value"),
            };
            checker.note_dimension(Entity::Constant(id), [&value]);
            value
        });
        let constant = &mut self.program[id];
        constant.ty = value.ty.clone();
        constant.value = value;
        constant.locals = locals;
        self.constants[id.index()] = Progress::Done;
        self.user = outer_user;
        self.file = outer_file;
    }

    fn check_function(&mut self, id: FunctionId) {
        let (file, node) = self.nodes.functions[id.index()].clone();
        self.file = file;
        self.user = Some(Needed::Function(id));
        let parameters = core::mem::take(&mut self.program[id].locals);
        let result = self.program[id].result.clone();
        let (body, locals) = self.in_body(Where::Function, |checker| {
            checker.body.result = Some(result.clone());
            // Calls of the function itself look its parameters up.
            checker.program[id].locals.clone_from(&parameters);
            for parameter in parameters {
                let local = checker
                    .body
                    .add(parameter.name, parameter.ty, parameter.span, None);
                checker.body.fixed[local.index()] = Some("a parameter");
            }
            match node.value() {
                Some(value) => {
                    let span = value.span();
                    let value = checker.expect(Some(value), &result, "the result");
                    let kind = StatementKind::Return(Some(value));
                    Vec::from([Statement { kind, span }])
                }
                None => {
                    let body = checker.block(node.body());
                    if node.body().is_some() && !always_returns(&body) {
                        checker.report_missing_return(id);
                    }
                    body
                }
            }
        });
        self.program[id].locals = locals;
        self.program[id].body = body;
        self.user = None;
    }

    fn report_missing_return(&mut self, id: FunctionId) {
        let function = &self.program[id];
        let message = format!("`{}` may end without a result", function.name);
        let problem = Diagnostic::new(Code::MissingReturn, function.site.span, message);
        let expected = self.name_of(&function.result);
        let note = "every path through a function must end with `return`";
        self.report(problem.expected(article(&expected)).note(note));
    }

    fn check_parameters(&mut self) {
        for number in 0..self.nodes.parameters.len() {
            let node = self.nodes.parameters[number].clone();
            let ty = self.program.parameters[number].ty.clone();
            let ((default, range), locals) = self.in_body(Where::Constant, |checker| {
                let range = node
                    .range()
                    .and_then(|range| checker.check_range(&range, &ty));
                let value = node.value();
                let default = value.map(|value| checker.expect(Some(value), &ty, "the default"));
                let values = range.iter().flatten().chain(&default);
                checker.note_dimension(Entity::Parameter(ParameterId(number as u32)), values);
                (default, range)
            });
            let parameter = &mut self.program.parameters[number];
            (parameter.default, parameter.range) = (default, range);
            parameter.locals = locals;
        }
    }

    /// The bounds of a parameter or a variable of this type.
    fn check_range(&mut self, node: &ast::ParameterRange, ty: &Type) -> Option<[Expression; 2]> {
        if !matches!(ty, Type::Int | Type::Float | Type::Duration | Type::Error) {
            let name = self.name_of(ty);
            let message = format!("a value of the type {name} has no range");
            let problem = Diagnostic::new(Code::InvalidRange, node.span(), message);
            self.report(problem.note("an Int, a Float or a Duration has"));
            return None;
        }
        let range = node.value()?;
        let is_range =
            |pair: &ast::BinaryExpression| pair.operator() == Some(ast::BinaryOperator::Range);
        match range {
            ast::Expression::Binary(pair) if is_range(&pair) => Some([
                self.expect(pair.left(), ty, "the lower bound"),
                self.expect(pair.right(), ty, "the end of the range"),
            ]),
            other => {
                let message = "this is not a valid range";
                let problem = Diagnostic::new(Code::InvalidRange, other.span(), message);
                self.report(problem.note("`a..b` is from `a` to before `b`"));
                None
            }
        }
    }

    fn check_variables(&mut self) {
        for number in 0..self.nodes.variables.len() {
            let Some(node) = self.nodes.variables[number].clone() else {
                continue;
            };
            let id = VariableId(number as u32);
            let ty = self.program[id].ty.clone();
            let (initial, locals) = self.in_body(Where::Initial(id), |checker| {
                let value = checker.expect(Some(node.value()?), &ty, "the first value");
                checker.note_dimension(Entity::Variable(id), [&value]);
                Some(value)
            });
            if initial.is_none() && !self.program.has_default(&ty) && ty != Type::Error {
                let name = self.program[id].name.clone();
                let message = format!("`{name}` needs an initial value");
                let problem = Diagnostic::new(Code::NoDefault, self.program[id].site.span, message);
                let of = self.name_of(&ty);
                let note =
                    format!("{of} has no default; or declare it as `{of}?`, which begins as none");
                self.report(problem.note(note));
            }
            let variable = &mut self.program[id];
            variable.initial = initial;
            variable.locals = locals;
            if let Some(range) = node.range() {
                self.check_variable_range(id, &range, &ty);
            }
        }
    }

    /// A variable's range is a check.
    fn check_variable_range(&mut self, id: VariableId, node: &ast::ParameterRange, ty: &Type) {
        if self.program[id].role.is_some() {
            let message = "a variable of a role has no range";
            let problem = Diagnostic::new(Code::InvalidRange, node.span(), message);
            self.report(problem.note("declare it outside of the role"));
            return;
        }
        let (range, locals) = self.in_body(Where::Guard, |checker| checker.check_range(node, ty));
        let Some([from, before]) = range else { return };
        let span = node.span();
        let compared = |operator, with| {
            let variable = made(ExpressionKind::Variable(id), ty.clone(), span);
            joined(operator, variable, with, Type::Bool, span)
        };
        let (least, most) = (
            compared(Operator::GreaterEqual, from),
            compared(Operator::Less, before),
        );
        let condition = joined(Operator::And, least, most, Type::Bool, span);
        let site = self.site(span);
        self.program.checks.push(Check {
            locals,
            condition,
            site,
        });
    }

    fn check_shared(&mut self) {
        for number in 0..self.nodes.shared.len() {
            let node = self.nodes.shared[number].clone();
            let ty = self.program.shared[number].ty.clone();
            let (initial, locals) = self.in_body(Where::Constant, |checker| {
                let value = checker.expect(Some(node.value()?), &ty, "the first value");
                checker.note_dimension(Entity::Shared(SharedId(number as u32)), [&value]);
                Some(value)
            });
            if let Some(value) = initial.as_ref().filter(|_| node.is_single_writer()) {
                let message = "a single-writer variable has no initial value";
                let problem = Diagnostic::new(Code::WrongType, value.span, message);
                self.report(
                    problem.note("an element is none until its robot has written it, as in `init`"),
                );
            }
            let shared = &mut self.program.shared[number];
            shared.initial = initial;
            shared.locals = locals;
        }
    }

    fn check_bindings(&mut self) {
        for number in 0..self.nodes.bindings.len() {
            let node = self.nodes.bindings[number].clone();
            let Some(ast::Expression::Call(call)) = node.value() else {
                continue;
            };
            let arguments: Vec<ast::Argument> = call.arguments().collect();
            let Some(primitive) = self.program.bindings[number].primitive else {
                self.unknown_primitive(&node);
                continue;
            };
            let word = constructor(&node);
            if let (Some((_, at)), Some(symbol)) = (word, Symbol::primitive(primitive)) {
                self.resolve(at, symbol);
            }
            let signature = Signature::read(primitive.constructor);
            self.resolve_arguments(&arguments, primitive.constructor, &signature);
            let (values, locals) = self.in_body(Where::Binding, |checker| {
                let arranged =
                    checker.arrange(&Parameters::of(&signature), &arguments, call.span());
                let mut letters = Letters::new();
                checker.shaped_arguments(&signature, arranged.values, &mut letters, call.span())
            });
            let binding = &mut self.program.bindings[number];
            binding.arguments = values;
            binding.locals = locals;
        }
    }

    fn unknown_primitive(&mut self, node: &ast::BindingDeclaration) {
        let Some((word, span)) = constructor(node) else {
            // The parser reports anything that is not a call.
            if let Some(ast::Expression::Call(call)) = node.value()
                && let Some(callee) = call.callee()
            {
                let message = "this is not a primitive";
                let problem = Diagnostic::new(Code::UnknownPrimitive, callee.span(), message);
                let names = PRIMITIVES.iter().map(Primitive::name);
                self.report(problem.note(format!("there are {}", listed(names))));
            }
            return;
        };
        if self.is_probe(span) {
            self.note_probe(Surroundings::Primitive);
        }
        let message = format!("there is no primitive `{word}`");
        let problem = Diagnostic::new(Code::UnknownPrimitive, span, message);
        let names = || PRIMITIVES.iter().map(Primitive::name);
        let ty = match self.declared(0, &word) {
            Some(Entity::Function(id)) => Some(self.program[id].result.clone()),
            Some(Entity::Record(id)) => Some(Type::Record(id)),
            _ => Builtin::named(&word).map(|builtin| {
                let result = self.shape_type(&builtin.signature().result, &Letters::new());
                result.unwrap_or(Type::Error)
            }),
        };
        let problem = match (ty, node.name()) {
            (Some(ty), Some(name)) => {
                let note = "a variable is declared with its type: `name: Type = value`";
                let ty = self.name_of(&ty);
                let form = format!("write `{}: {ty}`", name.text());
                problem
                    .note(note)
                    .replace(form, Span::empty(name.span().end), format!(": {ty}"))
            }
            _ => {
                let problem = match word.as_str() {
                    "Motion" => problem.replace("did you mean `ReachAvoid`?", span, "ReachAvoid"),
                    _ => did_you_mean(problem, span, &word, names()),
                };
                problem.note(format!("there are {}", super::report::listed(names())))
            }
        };
        self.report(problem);
    }
}
