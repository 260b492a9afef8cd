//! Assignable places: variables and their parts.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::body::Where;
use super::member::Part;
use super::resolution::Symbol;
use super::scope::Entity;
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, LocalId, Place, Root, SharedId, Step, Type};
use crate::syntax::ast::{self, AstNode};

/// A local variable, or one that is declared.
#[derive(Clone, Copy)]
pub(super) enum Variable {
    Local(LocalId),
    Entity(Entity),
}

fn place(root: Root, ty: Type, span: Span) -> Place {
    Place {
        root,
        path: Vec::new(),
        ty,
        span,
    }
}

fn no_place(span: Span) -> Place {
    place(Root::Error, Type::Error, span)
}

impl Checker {
    /// The target of an assignment, or of a method that changes its receiver.
    pub fn place(&mut self, target: &ast::Expression) -> Place {
        let span = target.span();
        match target {
            ast::Expression::Name(node) => self.named_place(&node.text(), span),
            ast::Expression::Parenthesized(node) => match node.inner() {
                Some(inner) => self.place(&inner),
                None => no_place(span),
            },
            ast::Expression::Field(node) => self.field_place(node, span),
            ast::Expression::Index(node) => self.indexed_place(node, span),
            _ => {
                // As the target of an assignment the parser reports it.
                let value = self.infer(Some(target.clone()), None);
                if value.ty != Type::Error {
                    let message = "this is not a variable, so the change would be lost";
                    self.error(Code::NotWritable, span, message);
                }
                no_place(span)
            }
        }
    }

    fn named_place(&mut self, name: &str, span: Span) -> Place {
        if let Some(local) = self.body.find(name) {
            self.resolve_local(span, local);
            return self.local_place(local, span);
        }
        if name == "role" && self.program.roles.is_some() {
            let message = "the role is changed as a whole, by `role = ...`";
            self.error(Code::NotWritable, span, message);
            return no_place(span);
        }
        let entity = self.declared(self.file, name);
        if let Some(entity) = entity {
            self.resolve_entity(span, entity);
        }
        match entity {
            Some(Entity::Variable(id)) => {
                if !self.may_write(name, span) {
                    return no_place(span);
                }
                self.usage.written.insert(Entity::Variable(id));
                place(Root::Variable(id), self.program[id].ty.clone(), span)
            }
            Some(Entity::Shared(id)) => self.shared_place(id, name, span),
            Some(Entity::Broken) => no_place(span),
            Some(entity) => {
                let message = format!("`{name}` is {} and cannot be changed", entity.what());
                self.error(Code::NotWritable, span, message);
                no_place(span)
            }
            None => self.other_place(name, span),
        }
    }

    fn other_place(&mut self, name: &str, span: Span) -> Place {
        if self.is_probe(span) {
            self.note_probed_value(None);
        }
        if Builtin::named(name).is_some() {
            let message = format!("`{name}` is knowledge of the robot and cannot be changed");
            self.error(Code::NotWritable, span, message);
        } else if !self.may_be_unread(name) {
            let message = format!("there is no variable `{name}`");
            let problem = Diagnostic::new(Code::UnknownName, span, message);
            if let Some(problem) = self.without_self(&problem, name, span) {
                self.report(problem);
                return no_place(span);
            }
            if super::hints::habit(name).is_some() {
                let problem = self.hint(problem, name, span);
                self.report(problem);
                return no_place(span);
            }
            let variables = self.files[self.file as usize].scope.iter();
            let variables = variables
                .filter(|(_, declared)| {
                    matches!(declared.entity, Entity::Variable(_) | Entity::Shared(_))
                })
                .map(|(name, _)| name.as_str());
            let locals = self.body.names.iter().map(|(name, _)| name.as_str());
            let problem = super::report::did_you_mean(problem, span, name, locals.chain(variables));
            self.report(match problem.fix {
                None => problem.note(format!("declare a new one with `let {name} = ...`")),
                Some(_) => problem,
            });
        }
        no_place(span)
    }

    fn local_place(&mut self, local: LocalId, span: Span) -> Place {
        let ty = self.body.locals[local.index()].ty.clone();
        if let Some(what) = self.body.fixed[local.index()] {
            let name = self.body.locals[local.index()].name.clone();
            let message = format!("`{name}` is {what} and cannot be changed");
            let problem = Diagnostic::new(Code::NotWritable, span, message);
            self.report(problem.note(format!("a copy can: `let copy = {name}`")));
            return no_place(span);
        }
        let Some((whole, field)) = self.body.part(local) else {
            return place(Root::Local(local), ty, span);
        };
        let mut place = place(Root::Local(whole), ty, span);
        place.path.push(Step::Field(field));
        place
    }

    /// Whether the state can be written here; reports it if not.
    fn may_write(&mut self, name: &str, span: Span) -> bool {
        if self.body.place == Where::Effect {
            return true;
        }
        let what = self.body.place.what();
        let message = format!("{what} cannot change the variable `{name}`");
        let problem = Diagnostic::new(Code::StateOutOfReach, span, message);
        self.report(problem.note("only `init`, effects and handlers change the state"));
        false
    }

    fn shared_place(&mut self, id: SharedId, name: &str, span: Span) -> Place {
        if !self.may_write(name, span) {
            return no_place(span);
        }
        self.usage.written.insert(Entity::Shared(id));
        self.body.touched.push((id, span));
        if self.program[id].is_single_writer {
            let message = format!("each robot writes its own element of `{name}`");
            let problem = Diagnostic::new(Code::ForeignElement, span, message);
            let end = Span::empty(span.end);
            self.report(problem.replace(format!("write `{name}[me]`"), end, "[me]"));
            return no_place(span);
        }
        place(Root::Shared(id), self.program[id].ty.clone(), span)
    }

    /// The single-writer variable that an expression names.
    fn single_writer(&self, base: &ast::Expression) -> Option<(SharedId, String)> {
        let ast::Expression::Name(node) = base else {
            return None;
        };
        let name = node.text();
        if self.body.find(&name).is_some() {
            return None;
        }
        match self.declared(self.file, &name)? {
            Entity::Shared(id) if self.program[id].is_single_writer => Some((id, name)),
            _ => None,
        }
    }

    fn indexed_place(&mut self, node: &ast::IndexExpression, span: Span) -> Place {
        let Some(base) = node.base() else {
            return no_place(span);
        };
        if let Some((id, name)) = self.single_writer(&base) {
            self.resolve(base.span(), Symbol::Shared(id));
            return self.own_element(id, &name, node, span);
        }
        let whole = self.place(&base);
        match whole.ty.clone() {
            Type::List(element) => {
                let index = self.expect(node.index(), &Type::Int, "the index");
                self.check_index(&index, whole.span, span);
                self.part(whole, Step::Index(index), *element, span)
            }
            Type::Map(key, value) => {
                let key = self.expect(node.index(), &key, "the key");
                self.part(whole, Step::Key(key), *value, span)
            }
            Type::Error => {
                self.infer(node.index(), None);
                no_place(span)
            }
            ty => {
                let base = super::report::made(ExpressionKind::Error, ty, whole.span);
                self.not_indexable(&base);
                no_place(span)
            }
        }
    }

    /// `name[me]` of a single-writer variable.
    fn own_element(
        &mut self,
        id: SharedId,
        name: &str,
        node: &ast::IndexExpression,
        span: Span,
    ) -> Place {
        if !self.may_write(name, span) {
            return no_place(span);
        }
        self.usage.written.insert(Entity::Shared(id));
        self.body.touched.push((id, span));
        let index: Expression = self.expect(node.index(), &Type::Robot, "the index");
        let is_own = matches!(
            index.kind,
            ExpressionKind::Builtin {
                builtin: Builtin::Me,
                ..
            }
        );
        if !is_own && index.ty != Type::Error {
            let message = format!("a robot writes only its own element of `{name}`");
            let problem = Diagnostic::new(Code::ForeignElement, index.span, message);
            let problem = problem.write(index.span, "me");
            let note = "use `allwrite` for a variable that all robots write, or send a message";
            self.report(problem.note(note));
            return no_place(span);
        }
        place(Root::OwnElement(id), self.program[id].ty.clone(), span)
    }

    fn field_place(&mut self, node: &ast::FieldExpression, span: Span) -> Place {
        let (Some(base), Some(word)) = (node.base(), node.field()) else {
            return no_place(span);
        };
        if let Some(entity) = self.namespace(&base) {
            if entity != Entity::Broken {
                let message = format!("the attributes of {} cannot be changed", entity.what());
                self.error(Code::NotWritable, span, message);
            }
            return no_place(span);
        }
        let whole = self.place(&base);
        if whole.ty == Type::Error {
            return no_place(span);
        }
        let part = self.part_named(&whole.ty, word.text(), word.text_range().into());
        if let Some((part, ty)) = part {
            let step = match part {
                Part::Field(field) => Step::Field(field),
                Part::Coordinate(axis) => Step::Coordinate(axis),
            };
            return self.part(whole, step, ty, span);
        }
        // It cannot be read either, and that is what there is to say.
        self.infer(Some(ast::Expression::Field(node.clone())), None);
        no_place(span)
    }

    /// The variable that an expression is, or is a part of.
    pub fn root(&self, base: &ast::Expression) -> Option<Variable> {
        match base {
            ast::Expression::Name(node) => {
                let name = node.text();
                if let Some(local) = self.body.find(&name) {
                    return Some(Variable::Local(local));
                }
                self.declared(self.file, &name).map(Variable::Entity)
            }
            ast::Expression::Field(node) => self.root(&node.base()?),
            ast::Expression::Index(node) => self.root(&node.base()?),
            ast::Expression::Parenthesized(node) => self.root(&node.inner()?),
            _ => None,
        }
    }

    /// Whether the variable is known to be read.
    pub fn is_read(&self, variable: Variable) -> bool {
        match variable {
            Variable::Local(local) => self.body.is_read(local),
            Variable::Entity(entity) => self.usage.used.contains(&entity),
        }
    }

    /// Takes back that the variable is read.
    pub fn forget_read(&mut self, variable: Variable) {
        match variable {
            Variable::Local(local) => self.body.forget_read(local),
            Variable::Entity(entity) => {
                self.usage.used.remove(&entity);
            }
        }
    }

    /// A part of a place.
    fn part(&mut self, mut whole: Place, step: Step, ty: Type, span: Span) -> Place {
        match whole.root {
            Root::OwnElement(_) => {
                let message = "an element of a shared variable is written as a whole";
                self.error(Code::NotWritable, span, message);
                return no_place(span);
            }
            Root::Shared(id) if self.nodes.shared[id.index()].value().is_none() => {
                let message = "this may be none, so it has no part to assign";
                let problem = Diagnostic::new(Code::MayBeNone, whole.span, message);
                self.report(problem.note("it never is none if the variable has an initial value"));
                return no_place(span);
            }
            _ => {}
        }
        whole.path.push(step);
        whole.ty = ty;
        whole.span = span;
        whole
    }
}
