//! Local names, and `some x = optional`.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;

use super::body::Where;
use super::report::{broken, counted, made};
use super::scope::Entity;
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{Expression, ExpressionKind, LocalId, Type};
use crate::syntax::ast::{self, AstNode};

impl Checker {
    /// `some x = optional`: the name is known from here on.
    pub fn some(&mut self, node: &ast::SomeExpression, span: Span) -> Expression {
        let value = self.value(node.value(), None, "the optional");
        let inner = match &value.ty {
            Type::Optional(inner) => (**inner).clone(),
            Type::Error => Type::Error,
            _ => {
                let message = "`some` needs an optional, and this always has a value";
                let problem = Diagnostic::new(Code::NotOptional, value.span, message);
                let problem = problem.found(self.name_of(&value.ty));
                self.report(problem.note("name a value with `let x = ...`"));
                value.ty.clone()
            }
        };
        let Some(pattern) = node.pattern() else {
            return broken(span);
        };
        let fixed = Some("the value of an optional");
        let Some(local) = self.bind_pattern(&pattern, inner, Some(Code::UnusedLocal), fixed) else {
            let is_none = made(ExpressionKind::IsNone(Box::new(value)), Type::Bool, span);
            return made(ExpressionKind::Not(Box::new(is_none)), Type::Bool, span);
        };
        let value = Box::new(value);
        made(ExpressionKind::Bind { local, value }, Type::Bool, span)
    }

    /// Declares a local, or the parts of a tuple as locals; none if nothing is named. `fixed` is what it is if it cannot
    /// be assigned to.
    pub fn bind_pattern(
        &mut self,
        pattern: &ast::Pattern,
        ty: Type,
        unread: Option<Code>,
        fixed: Option<&'static str>,
    ) -> Option<LocalId> {
        let tuple = match pattern {
            ast::Pattern::Name(name) => {
                let local = self.declare_local(name, ty, unread)?;
                self.body.fixed[local.index()] = fixed;
                return Some(local);
            }
            ast::Pattern::Tuple(tuple) => tuple,
        };
        let names: Vec<ast::Name> = tuple.names().collect();
        let parts = self.parts_of(&ty, names.len(), tuple.span());
        let whole = self.body.add_whole(ty, tuple.span());
        for (part, name) in names.iter().enumerate() {
            let ty = parts.get(part).cloned().unwrap_or(Type::Error);
            if let Some(local) = self.declare_local(name, ty, unread) {
                self.body.fixed[local.index()] = fixed;
                if !parts.is_empty() {
                    self.body.set_part(local, whole, part as u32);
                }
            }
        }
        Some(whole)
    }

    /// The types of the parts of a tuple that gets `names` names; nothing if it is none, or if there are more or fewer.
    fn parts_of(&mut self, ty: &Type, names: usize, span: Span) -> Vec<Type> {
        let found = self.name_of(ty);
        let problem = match ty {
            Type::Error => return Vec::new(),
            Type::Record(id) if self.program[*id].is_tuple() => {
                let fields = self.program[*id].fields.iter();
                let parts: Vec<Type> = fields.map(|field| field.ty.clone()).collect();
                if parts.len() == names {
                    return parts;
                }
                let (parts, names) = (counted(parts.len(), "part"), counted(names, "name"));
                let message = format!("this tuple has {parts}, not {names}");
                let problem = Diagnostic::new(Code::TupleParts, span, message);
                problem.note("write `_` for a part without a name")
            }
            _ => {
                let message = "only the parts of a tuple get names like these";
                let problem = Diagnostic::new(Code::TupleParts, span, message);
                let expected = format!("a tuple of {}", counted(names, "part"));
                problem.expected(expected)
            }
        };
        self.report(problem.found(found));
        Vec::new()
    }

    /// Declares a local; none for `_`. `unread` is the warning if nothing reads it.
    pub fn declare_local(
        &mut self,
        name: &ast::Name,
        ty: Type,
        unread: Option<Code>,
    ) -> Option<LocalId> {
        let token = name.token()?;
        let (text, span) = (token.text().to_string(), Span::from(token.text_range()));
        if text == "_" {
            return None;
        }
        self.check_hiding(&text, span);
        Some(self.body.add(text, ty, span, unread))
    }

    fn check_hiding(&mut self, name: &str, span: Span) {
        let found = if let Some(local) = self.body.find(name) {
            Some((self.body.locals[local.index()].span, "a local variable"))
        } else if matches!(self.body.place, Where::Function | Where::Constant) {
            // A function does not see the state, so nothing is hidden from it.
            None
        } else {
            let declared = self.files[self.file as usize].scope.get(name);
            declared
                .filter(|declared| {
                    matches!(
                        declared.entity,
                        Entity::Variable(_)
                            | Entity::Shared(_)
                            | Entity::Binding(_)
                            | Entity::Parameter(_)
                            | Entity::Constant(_)
                    )
                })
                .map(|declared| (declared.span, declared.entity.what()))
        };
        if let Some((first, what)) = found {
            let message = format!("the name `{name}` is taken");
            let problem = Diagnostic::new(Code::HiddenName, span, message);
            let problem = problem.label(first, format!("it is {what} here"));
            self.report(problem.note("choose another name"));
        }
    }

    /// The names of a loop or a comprehension, and the types of their values.
    pub fn loop_variables(
        &mut self,
        names: impl Iterator<Item = ast::Pattern>,
        collection: &Expression,
    ) -> crate::ir::LoopVariables {
        use crate::ir::LoopVariables;
        let (one, two) = match &collection.ty {
            Type::List(element) | Type::Set(element) => ((**element).clone(), None),
            Type::Map(key, value) => ((**key).clone(), Some((**value).clone())),
            Type::Range => (Type::Int, None),
            Type::Error => (Type::Error, Some(Type::Error)),
            _ => {
                self.not_a_collection(collection);
                (Type::Error, Some(Type::Error))
            }
        };
        let mut names = names;
        let (first, second) = (names.next(), names.next());
        let first = first.and_then(|name| self.loop_variable(&name, one));
        let Some(second) = second else {
            return LoopVariables::One(first);
        };
        let two = two.unwrap_or_else(|| {
            let message = format!(
                "a {} yields one value at a time",
                self.name_of(&collection.ty)
            );
            let problem = Diagnostic::new(Code::NotCollection, second.span(), message);
            self.report(problem.note("two names are for the keys and values of a map"));
            Type::Error
        });
        LoopVariables::Two(first, self.loop_variable(&second, two))
    }

    fn loop_variable(&mut self, name: &ast::Pattern, ty: Type) -> Option<LocalId> {
        self.bind_pattern(name, ty, None, Some("a loop variable"))
    }

    /// Reports what cannot be run over.
    pub fn not_a_collection(&mut self, collection: &Expression) {
        let found = self.name_of(&collection.ty);
        let message = "this cannot be iterated";
        let problem = Diagnostic::new(Code::NotCollection, collection.span, message);
        let problem = problem
            .expected("a list, a set, a map or a range")
            .found(found);
        self.report(match collection.ty {
            Type::Int => {
                let span = Span::empty(collection.span.start);
                problem.replace("write `0..` before it to count up to it", span, "0..")
            }
            Type::Optional(_) => problem.note("ask first with `if some x = ...`"),
            _ => problem,
        });
    }
}
