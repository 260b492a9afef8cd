//! The behaviour of a program: `init` and actions.

use alloc::string::ToString;
use alloc::vec::Vec;

use super::body::Where;
use super::collect::{first_word, name_of};
use super::report::{joined, made};
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::*;
use crate::syntax::ast::{self, AstNode, Documented, Item};

impl Checker {
    pub fn check_init(&mut self, role: Option<u16>, node: &ast::InitDeclaration) {
        let (body, locals) = self.in_body(Where::Effect, |checker| checker.effect(node.body()));
        let procedure = Procedure { locals, body };
        let roles = self.program.roles.as_mut();
        let place = match role {
            None => &mut self.program.init,
            Some(number) => match roles.and_then(|roles| roles.roles.get_mut(number as usize)) {
                Some(role) => &mut role.entry,
                None => return,
            },
        };
        if place.is_some() {
            let span = first_word(node.syntax());
            let problem =
                Diagnostic::new(Code::SecondDeclaration, span, "there is an `init` already");
            self.report(problem.note("put the statements into the first one"));
        } else {
            *place = Some(procedure);
        }
    }

    pub fn check_action(&mut self, role: Option<u16>, node: &ast::ActionDeclaration) {
        let Some(name) = name_of(node) else { return };
        let actions = &self.program.actions;
        let same = actions
            .iter()
            .find(|other| other.role == role && other.name == name.text);
        if let Some(first) = same {
            let first = first.site.span;
            self.duplicate("actions", &name.text, name.span, first);
        }
        let (parts, locals) = self.in_body(Where::Guard, |checker| {
            checker.body.is_action = true;
            // They are asked before the guard has found anything.
            let time = |checker: &mut Self, node: Option<ast::Expression>, what| {
                node.map(|node| checker.expect(Some(node), &Type::Duration, what))
            };
            let hold = node.pre().and_then(|pre| pre.hold());
            let hold = time(checker, hold, "how long the guard has to hold");
            let every = time(checker, node.every(), "the time between two firings");
            let guard = match node.pre() {
                Some(pre) => checker.expect(pre.condition(), &Type::Bool, "the guard"),
                None => made(ExpressionKind::Bool(true), Type::Bool, name.span),
            };
            let bound = checker.body.names.iter();
            let mut bindings: Vec<LocalId> = bound
                .map(|(_, local)| checker.body.part(*local).map_or(*local, |(whole, _)| whole))
                .collect();
            bindings.dedup();
            checker.body.place = Where::Effect;
            let effect = checker.effect(node.eff().and_then(|eff| eff.body()));
            let atomic = checker.linearizable();
            (guard, bindings, effect, atomic, hold, every)
        });
        let (guard, bindings, effect, atomic, hold, every) = parts;
        let guard = match self.in_role(role, name.span) {
            Some(in_role) => {
                let span = guard.span;
                joined(Operator::And, in_role, guard, Type::Bool, span)
            }
            None => guard,
        };
        let site = self.site(name.span);
        self.program.actions.push(Action {
            name: name.text,
            role,
            locals,
            guard,
            bindings,
            hold,
            every,
            effect,
            atomic,
            site,
            documentation: Item::Action(node.clone()).documentation().to_string(),
        });
    }

    /// The statements of an effect.
    pub fn effect(&mut self, node: Option<ast::Block>) -> Vec<Statement> {
        let body = self.block(node);
        self.check_touched();
        body
    }

    /// `check condition`.
    pub fn check_check(&mut self, node: &ast::CheckDeclaration) {
        let (condition, locals) = self.in_body(Where::Guard, |checker| {
            let condition = checker.expect(node.condition(), &Type::Bool, "the check");
            checker.check_touched();
            condition
        });
        let site = self.site(condition.span);
        self.program.checks.push(Check {
            locals,
            condition,
            site,
        });
    }

    /// The linearizable variables that the body touches, in ascending order.
    pub fn linearizable(&self) -> Vec<SharedId> {
        let touched = self.body.touched.iter().map(|(id, _)| *id);
        let is_linearizable =
            |id: &SharedId| self.program[*id].consistency == Consistency::Linearizable;
        let mut touched: Vec<SharedId> = touched.filter(is_linearizable).collect();
        touched.sort_unstable();
        touched.dedup();
        touched
    }

    /// `role == ...`, for what belongs to a role.
    pub fn in_role(&self, role: Option<u16>, span: Span) -> Option<Expression> {
        let variable = self.program.roles.as_ref()?.variable;
        let ty = self.program[variable].ty.clone();
        let left = made(ExpressionKind::Variable(variable), ty.clone(), span);
        let right = made(ExpressionKind::Variant(role?), ty, span);
        Some(joined(Operator::Equal, left, right, Type::Bool, span))
    }
}
