//! Statements.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::arithmetic::{resolve, result};
use super::body::Where;
use super::report::{broken, made};
use super::resolution::Symbol;
use super::returns::always_returns;
use super::state::Checker;
use super::tables::Purity;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{
    Consistency, Expression, ExpressionKind, Root, SharedId, Statement, StatementKind, Type,
};
use crate::syntax::ast::{self, AssignOperator, AstNode, BinaryOperator};

impl Checker {
    /// The statements of a block, in a scope of their own.
    pub fn block(&mut self, block: Option<ast::Block>) -> Vec<Statement> {
        let mark = self.body.enter();
        let mut statements: Vec<Statement> = Vec::new();
        let mut is_over = false;
        for node in block.iter().flat_map(ast::Block::statements) {
            let span = node.span();
            if is_over {
                self.error(Code::Unreachable, span, "this is never reached");
                is_over = false;
            }
            let Some(kind) = self.statement(node) else {
                continue;
            };
            let statement = Statement { kind, span };
            let ends = always_returns(core::slice::from_ref(&statement));
            is_over = ends
                && statements
                    .last()
                    .is_none_or(|last| !always_returns(core::slice::from_ref(last)));
            statements.push(statement);
        }
        self.body.leave(mark);
        statements
    }

    fn statement(&mut self, node: ast::Statement) -> Option<StatementKind> {
        Some(match node {
            ast::Statement::Let(node) => return self.let_statement(&node),
            ast::Statement::Assign(node) => self.assign(&node),
            ast::Statement::If(node) => self.if_statement(&node),
            ast::Statement::For(node) => {
                let mark = self.body.enter();
                let collection = self.infer(node.collection(), None);
                let variables = self.loop_variables(node.variables(), &collection);
                let body = self.block(node.body());
                self.body.leave(mark);
                StatementKind::For {
                    variables,
                    collection,
                    body,
                }
            }
            ast::Statement::Return(node) => self.return_statement(&node),
            ast::Statement::Expression(node) => self.evaluate(&node),
            ast::Statement::Atomic(node) => self.atomic(&node),
        })
    }

    fn let_statement(&mut self, node: &ast::LetStatement) -> Option<StatementKind> {
        let value = match node.ty() {
            Some(ty) => {
                let ty = self.written(&ty);
                self.expect(node.value(), &ty, "the value")
            }
            None => self.value(node.value(), None, "the value"),
        };
        self.check_keys();
        let ty = value.ty.clone();
        let pattern = node.pattern()?;
        match self.bind_pattern(&pattern, ty, Some(Code::UnusedLocal), None) {
            Some(local) => {
                self.body.dimensions[local.index()] = self.dimension(&value);
                Some(StatementKind::Let { local, value })
            }
            None => Some(StatementKind::Evaluate(value)),
        }
    }

    fn assign(&mut self, node: &ast::AssignStatement) -> StatementKind {
        let operator = node.operator();
        if let (Some(AssignOperator::Assign), Some(ast::Expression::Name(name))) =
            (operator, node.target())
            && name.text() == "role"
            && let Some(roles) = &self.program.roles
        {
            let variable = roles.variable;
            let ty = self.program[variable].ty.clone();
            self.resolve(name.span(), Symbol::Variable(variable));
            let value = self.expect(node.value(), &ty, "the role");
            return StatementKind::ChangeRole { value };
        }
        let Some(target) = node.target() else {
            self.infer(node.value(), None);
            return StatementKind::Evaluate(broken(node.span()));
        };
        let place = self.place(&target);
        let operator = match operator {
            Some(AssignOperator::Add) => BinaryOperator::Add,
            Some(AssignOperator::Subtract) => BinaryOperator::Subtract,
            Some(AssignOperator::Multiply) => BinaryOperator::Multiply,
            _ => return self.plain_assign(place, node.value()),
        };
        // A compound assignment also reads its target, so it must be there and of a type that the operator gives back.
        let read = match place.root {
            Root::Shared(id) if self.nodes.shared[id.index()].value().is_none() => {
                Type::optional(place.ty.clone())
            }
            Root::OwnElement(_) => Type::optional(place.ty.clone()),
            _ => place.ty.clone(),
        };
        let value = self.value(node.value(), Some(&read), "the value");
        let fits = result(operator, &read, &value.ty) == Some(read.clone());
        if !fits && read != Type::Error && value.ty != Type::Error {
            // `arithmetic` reports the error; if there is no error the result is of another type.
            let left = made(ExpressionKind::Error, read.clone(), place.span);
            let joined = self.arithmetic(operator, left, value.clone(), node.span());
            self.fit(joined, &read, "the result");
        }
        if matches!(operator, BinaryOperator::Add | BinaryOperator::Subtract) {
            self.check_assigned_dimension(&place, &value);
        }
        match resolve(operator) {
            Some(operator) => StatementKind::Update {
                place,
                operator,
                value,
            },
            None => StatementKind::Evaluate(value),
        }
    }

    fn plain_assign(
        &mut self,
        place: crate::ir::Place,
        value: Option<ast::Expression>,
    ) -> StatementKind {
        let name = self.text(place.span);
        let role = if name.len() <= 40 && !name.contains('\n') {
            format!("the value of `{name}`")
        } else {
            "the value".into()
        };
        let ty = place.ty.clone();
        let value = match ty {
            Type::Error => self.infer_alone(value),
            _ => self.expect(value, &ty, &role),
        };
        self.check_assigned_dimension(&place, &value);
        StatementKind::Assign { place, value }
    }

    fn if_statement(&mut self, node: &ast::IfStatement) -> StatementKind {
        let mut branches = Vec::new();
        for branch in node.branches() {
            let mark = self.body.enter();
            let condition = self.expect(branch.condition(), &Type::Bool, "the condition");
            if let ExpressionKind::Bool(value) = condition.kind {
                let message = format!("this is always {value}");
                self.error(Code::ConstantCondition, condition.span, message);
            }
            let then = self.block(branch.body());
            self.body.leave(mark);
            branches.push((condition, then, branch.span()));
        }
        let mut otherwise = self.block(node.otherwise().and_then(|branch| branch.body()));
        // Each `elif` is an `if` in the `else` of the one before.
        while branches.len() > 1 {
            if let Some((condition, then, span)) = branches.pop() {
                let kind = StatementKind::If {
                    condition,
                    then,
                    otherwise,
                };
                otherwise = Vec::from([Statement { kind, span }]);
            }
        }
        let (condition, then) = match branches.pop() {
            Some((condition, then, _)) => (condition, then),
            None => (broken(node.span()), Vec::new()),
        };
        StatementKind::If {
            condition,
            then,
            otherwise,
        }
    }

    fn return_statement(&mut self, node: &ast::ReturnStatement) -> StatementKind {
        let span = node.span();
        match (self.body.result.clone(), node.value()) {
            (Some(result), Some(value)) => {
                StatementKind::Return(Some(self.expect(Some(value), &result, "the result")))
            }
            (Some(result), None) => {
                let problem =
                    Diagnostic::new(Code::ReturnValue, span, "a function returns a value");
                let expected = self.name_of(&result);
                self.report(problem.expected(expected));
                StatementKind::Return(Some(broken(span)))
            }
            (None, Some(value)) => {
                let at = value.span();
                self.infer(Some(value), None);
                let message = "only a function returns a value";
                let problem = Diagnostic::new(Code::ReturnValue, at, message);
                let rest = Span::new(span.start, at.end);
                self.report(problem.replace("write `return` alone", rest, "return"));
                StatementKind::Return(None)
            }
            (None, None) => StatementKind::Return(None),
        }
    }

    fn evaluate(&mut self, node: &ast::ExpressionStatement) -> StatementKind {
        let value = self.infer(node.expression(), None);
        let span = value.span;
        let is_idle = match &value.kind {
            ExpressionKind::Error | ExpressionKind::Change { .. } => false,
            ExpressionKind::Builtin { builtin, .. } => builtin.purity() != Purity::Effect,
            ExpressionKind::Primitive { member, .. } => member.purity != Purity::Effect,
            _ => true,
        };
        // The parser reports everything that is not a call.
        let is_call = matches!(node.expression(), Some(ast::Expression::Call(_)));
        if is_idle && is_call && !value.ty.has_error() {
            let problem = Diagnostic::new(Code::UnusedValue, span, "the value of this is not used");
            self.report(problem.note_if(sibling(&value)));
        }
        StatementKind::Evaluate(value)
    }

    fn atomic(&mut self, node: &ast::AtomicStatement) -> StatementKind {
        let span = node.span();
        let word = Span::new(span.start, span.start + "atomic".len() as u32);
        if self.body.place != Where::Effect {
            let message = format!("{} cannot be atomic", self.body.place.what());
            self.error(Code::Impure, word, message);
        }
        if self.body.place == Where::Effect && !self.body.is_action {
            let message = "only the effect of an action can be atomic";
            let problem = Diagnostic::new(Code::MisplacedAtomic, word, message);
            self.report(problem.note(
                "`init` and handlers cannot wait; store the request in a variable, and carry it out in an \
                 action",
            ));
        }
        self.body.is_atomic = true;
        let before = self.body.touched.len();
        let body = self.block(node.body());
        let mut shared: Vec<SharedId> = self.body.touched[before..].iter().map(|t| t.0).collect();
        shared.sort_unstable();
        shared.dedup();
        self.check_protected(&shared, word);
        StatementKind::Atomic { shared, body }
    }

    /// Warns if an `atomic` that touches these does not keep others out of one that all write.
    fn check_protected(&mut self, shared: &[SharedId], word: Span) {
        let problem = |message: String| Diagnostic::new(Code::NothingShared, word, message);
        let is_open = |id: &&SharedId| {
            let shared = &self.program[**id];
            !shared.is_single_writer && shared.consistency != Consistency::Linearizable
        };
        if let Some(id) = shared.iter().find(is_open) {
            let name = self.program[*id].name.clone();
            let message = format!("this `atomic` does not keep other robots out of `{name}`");
            let note = format!("declare it `allwrite[linearizable] {name}`");
            self.report(problem(message).note(note));
        } else if shared.iter().all(|id| self.program[*id].is_single_writer) {
            self.body.idle_atomics.push(word);
        } else {
            self.body.has_busy_atomic = true;
        }
    }

    /// Reports the linearizable variables that a body touches without waiting for them.
    pub fn check_touched(&mut self) {
        if self.body.is_atomic {
            // The whole action waits, so without its only `atomic` what its guard reads would be an error.
            if self.body.has_busy_atomic || self.linearizable().is_empty() {
                let message = "this `atomic` touches no variable that all robots write";
                let note = "an effect always runs as a whole; `atomic` is for variables that other robots write too";
                for word in core::mem::take(&mut self.body.idle_atomics) {
                    self.report(Diagnostic::new(Code::NothingShared, word, message).note(note));
                }
            }
            return; // Elsewhere than in an action that is reported.
        }
        let mut touched = self.body.touched.clone();
        touched.sort_unstable_by_key(|&(id, span)| (id, span.start));
        touched.dedup_by_key(|(id, _)| *id);
        for (id, span) in touched {
            let shared = &self.program[id];
            if shared.consistency != Consistency::Linearizable {
                continue;
            }
            let message = format!(
                "`{}` is linearizable and used without `atomic`",
                shared.name
            );
            let note = match self.body.is_action {
                true => {
                    "its latest value is available only in an action with `atomic`: put the statements that use it, or depend on it, under `atomic`"
                }
                false => {
                    "`init` and handlers cannot wait for it; use it in an action with `atomic`"
                }
            };
            self.report(Diagnostic::new(Code::OutsideAtomic, span, message).note(note));
        }
    }
}

/// The method probably intended by a call whose value is dropped.
fn sibling(value: &Expression) -> Option<&'static str> {
    let ExpressionKind::Method { method, .. } = &value.kind else {
        return None;
    };
    match method.name() {
        "union" | "intersection" | "difference" | "reversed" | "sorted" | "slice" => Some(
            "it returns a new value and does not change `x`; write `x = x.method()` to keep the value",
        ),
        _ => None,
    }
}
