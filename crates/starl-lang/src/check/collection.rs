//! Lists, sets and maps as they are written, comprehensions, and indexing.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;

use super::report::{broken, made};
use super::state::Checker;
use super::tables::Builtin;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{
    Comprehension, Element, Expression, ExpressionKind, LoopVariables, RobotMember, Type,
};
use crate::syntax::ast;

impl Checker {
    /// `[a, b]` or `[f(x) for x in xs]`.
    pub fn list(
        &mut self,
        node: &ast::ListExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let hint = match there(expected) {
            Some(Type::List(element)) => Some(&**element),
            _ => None,
        };
        if let Some(clause) = node.comprehension() {
            return self.comprehension(&clause, span, |checker| {
                let element = checker.value(node.elements().next(), hint, "an element");
                (Type::list(element.ty.clone()), Element::One(element))
            });
        }
        let elements: Vec<_> = node.elements().collect();
        if elements.is_empty() && hint.is_none() {
            return self.unclear(span, expected, "list", "let x: List[Int] = []");
        }
        let (elements, element) = self.elements(elements, hint);
        made(ExpressionKind::List(elements), Type::list(element), span)
    }

    /// `{a, b}`, `{k: v}` or a comprehension with braces.
    pub fn brace(
        &mut self,
        node: &ast::BraceExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        if node.is_map() {
            return self.map(node, span, expected);
        }
        let hint = match there(expected) {
            Some(Type::Set(element)) => Some(&**element),
            _ => None,
        };
        if let Some(clause) = node.comprehension() {
            return self.comprehension(&clause, span, |checker| {
                let element = checker.value(node.elements().next(), hint, "an element");
                let ty = checker.key_type(&element);
                (Type::set(ty), Element::One(element))
            });
        }
        let elements: Vec<_> = node.elements().collect();
        if elements.is_empty() && hint.is_none() {
            if let Some(Type::Map(..)) = there(expected) {
                let problem = Diagnostic::new(Code::WrongType, span, "`{}` is the empty set");
                return self.refuse(problem.replace("write `{:}`, the empty map", span, "{:}"));
            }
            return self.unclear(span, expected, "set", "let x: Set[Int] = {}");
        }
        let (elements, element) = self.elements(elements, hint);
        let fits = self.check_key(&element, span);
        let element = if fits { element } else { Type::Error };
        made(ExpressionKind::Set(elements), Type::set(element), span)
    }

    fn map(
        &mut self,
        node: &ast::BraceExpression,
        span: Span,
        expected: Option<&Type>,
    ) -> Expression {
        let (mut key, mut value) = match there(expected) {
            Some(Type::Map(key, value)) => (Some((**key).clone()), Some((**value).clone())),
            _ => (None, None),
        };
        if let Some(clause) = node.comprehension() {
            return self.comprehension(&clause, span, |checker| {
                let entry = node.entries().next();
                let entry = entry.as_ref();
                let at = checker.value(entry.and_then(|e| e.key()), key.as_ref(), "a key");
                let is = checker.value(entry.and_then(|e| e.value()), value.as_ref(), "a value");
                let ty = Type::map(checker.key_type(&at), is.ty.clone());
                (ty, Element::Entry(at, is))
            });
        }
        let mut entries = Vec::new();
        for entry in node.entries() {
            let at = match &key {
                Some(ty) => self.expect(entry.key(), ty, "the key"),
                None => self.value(entry.key(), None, "the key"),
            };
            let is = match &value {
                Some(ty) => self.expect(entry.value(), ty, "the value"),
                None => self.value(entry.value(), None, "the value"),
            };
            if key.is_none() {
                key = Some(self.key_type(&at));
            }
            value.get_or_insert_with(|| is.ty.clone());
            entries.push((at, is));
        }
        match (key, value) {
            (Some(key), Some(value)) => {
                made(ExpressionKind::Map(entries), Type::map(key, value), span)
            }
            _ => self.unclear(span, expected, "map", "let x: Map[String, Int] = {:}"),
        }
    }

    /// The type of a key, if it can be one.
    fn key_type(&mut self, key: &Expression) -> Type {
        if self.check_key(&key.ty, key.span) {
            key.ty.clone()
        } else {
            Type::Error
        }
    }

    /// An empty collection of which nothing is known.
    fn unclear(
        &mut self,
        span: Span,
        expected: Option<&Type>,
        what: &str,
        form: &str,
    ) -> Expression {
        let problem = if let Some(ty) = expected {
            if *ty == Type::Error {
                return broken(span);
            }
            let message = format!("a {what} has the wrong type here");
            let problem = Diagnostic::new(Code::WrongType, span, message);
            problem
                .expected(self.name_of(ty))
                .found(format!("an empty {what}"))
        } else {
            let message = format!("the type of the elements of this {what} is unknown");
            let problem = Diagnostic::new(Code::UnclearType, span, message);
            problem.note(format!("declare its type, as in `{form}`"))
        };
        self.refuse(problem)
    }

    /// Elements of one type: the one that is expected, else that of the first that has one.
    fn elements(
        &mut self,
        nodes: Vec<ast::Expression>,
        hint: Option<&Type>,
    ) -> (Vec<Expression>, Type) {
        let mut known = hint.cloned();
        let mut elements: Vec<Option<Expression>> = nodes.iter().map(|_| None).collect();
        // Those that say nothing of their own type come last.
        for late in [false, true] {
            for (node, element) in nodes.iter().zip(&mut elements) {
                if element.is_some() || !late && known.is_none() && self.needs_hint(node) {
                    continue;
                }
                let node = Some(node.clone());
                let value = match &known {
                    Some(ty) => self.expect(node, ty, "the element"),
                    None => self.value(node, None, "the element"),
                };
                if known.is_none() && value.ty != Type::Error {
                    known = Some(value.ty.clone());
                }
                *element = Some(value);
            }
        }
        let elements = elements.into_iter().flatten().collect();
        (elements, known.unwrap_or(Type::Error))
    }

    fn comprehension(
        &mut self,
        clause: &ast::ComprehensionClause,
        span: Span,
        element: impl FnOnce(&mut Self) -> (Type, Element),
    ) -> Expression {
        let mark = self.body.enter();
        let collection = self.infer(clause.collection(), None);
        let variables: LoopVariables = self.loop_variables(clause.variables(), &collection);
        let condition = clause
            .condition()
            .map(|condition| self.expect(Some(condition), &Type::Bool, "the condition"));
        let (ty, element) = element(self);
        let key = clause.key().map(|key| self.sorting_key(key));
        if let Some(by) = clause.by()
            && !matches!(ty, Type::List(_))
        {
            let what = "sets and maps have an order of their own; only a list can be sorted `by`";
            let problem = Diagnostic::new(Code::Misplaced, by.text_range().into(), what);
            self.report(problem.note("write it in square brackets: `[x for x in xs by key]`"));
        }
        self.body.leave(mark);
        let comprehension = Comprehension {
            element,
            variables,
            collection,
            condition,
            key,
        };
        made(
            ExpressionKind::Comprehension(Box::new(comprehension)),
            ty,
            span,
        )
    }

    /// `min(x for x in xs by key)` or `max(...)`
    pub fn best(
        &mut self,
        builtin: Builtin,
        argument: &ast::Argument,
        clause: &ast::ComprehensionClause,
        span: Span,
    ) -> Expression {
        let made_list = self.comprehension(clause, span, |checker| {
            let element = checker.value(argument.value(), None, "an element");
            (Type::list(element.ty.clone()), Element::One(element))
        });
        let (ExpressionKind::Comprehension(comprehension), Type::List(element)) =
            (made_list.kind, made_list.ty)
        else {
            return broken(span);
        };
        if let (None, Element::One(value)) = (&comprehension.key, &comprehension.element)
            && !self.program.is_ordered(&element)
        {
            let message = format!("`{}` does not compare these", builtin.name());
            let problem = Diagnostic::new(Code::WrongType, value.span, message);
            let found = self.name_of(&element);
            let problem = problem.expected("what `<` compares").found(found);
            self.report(problem.note("give a key to compare: `x for x in xs by key`"));
            return broken(span);
        }
        let is_greatest = builtin == Builtin::Max;
        let kind = ExpressionKind::Best {
            comprehension,
            is_greatest,
        };
        made(kind, Type::optional(*element), span)
    }

    /// The key by which a list is sorted, of a type that `<` compares.
    fn sorting_key(&mut self, node: ast::Expression) -> Expression {
        let key = self.value(Some(node), None, "the key");
        if self.program.is_ordered(&key.ty) {
            return key;
        }
        let problem = Diagnostic::new(Code::WrongType, key.span, "`by` cannot sort by this");
        let problem = problem
            .expected("what `<` compares")
            .found(self.name_of(&key.ty));
        let note = "leave out those without a key: `if some k = ... by k`";
        let is_optional = matches!(key.ty, Type::Optional(_));
        self.refuse(problem.note_if(is_optional.then_some(note)))
    }

    /// `base[index]`.
    pub fn index(&mut self, node: &ast::IndexExpression, span: Span) -> Expression {
        let base = self.infer(node.base(), None);
        match base.ty.clone() {
            Type::List(element) => {
                let index = self.expect(node.index(), &Type::Int, "the index");
                self.check_index(&index, base.span, span);
                let (base, index) = (Box::new(base), Box::new(index));
                made(ExpressionKind::Index { base, index }, *element, span)
            }
            Type::Map(key, value) => {
                let key = Box::new(self.expect(node.index(), &key, "the key"));
                let (shared, of) = match base.kind {
                    ExpressionKind::SharedMap(shared) => (shared, None),
                    ExpressionKind::OfRobot {
                        robot,
                        member: RobotMember::Shared(shared),
                    } if self.program[shared].is_single_writer => (shared, Some(robot)),
                    _ => {
                        let base = Box::new(base);
                        return made(ExpressionKind::Lookup { base, key }, *value, span);
                    }
                };
                let kind = ExpressionKind::SharedElement {
                    shared,
                    robot: key,
                    of,
                };
                made(kind, Type::optional(*value), span)
            }
            Type::Error => {
                self.infer(node.index(), None);
                broken(span)
            }
            _ => {
                self.not_indexable(&base);
                broken(span)
            }
        }
    }

    /// Warns of an index below 0, a run-time error, of the list at `base`; the whole expression is at `whole`.
    pub fn check_index(&mut self, index: &Expression, base: Span, whole: Span) {
        let is_negative = match &index.kind {
            ExpressionKind::Int(number) => *number < 0,
            ExpressionKind::Negate(inner) => matches!(inner.kind, ExpressionKind::Int(1..)),
            _ => false,
        };
        if !is_negative {
            return;
        }
        let message = "no element has an index below 0";
        let problem = Diagnostic::new(Code::NegativeIndex, index.span, message);
        let problem =
            problem.note("the last element is `xs.last()`, an optional, or `xs[xs.size() - 1]`");
        let is_last = self.text(index.span) == "-1";
        let list = self.text(base).to_string();
        self.report(match is_last {
            true => problem.write(whole, format!("{list}[{list}.size() - 1]")),
            false => problem,
        });
    }

    /// Reports a value without elements by index or key.
    pub fn not_indexable(&mut self, base: &Expression) {
        let found = self.name_of(&base.ty);
        let message = format!("`[...]` does not apply to {found}");
        let problem = Diagnostic::new(Code::NotIndexable, base.span, message);
        self.report(match base.ty {
            Type::Optional(_) => problem.note("it may be none; test it with `if some x = ...`"),
            Type::Set(_) => problem.note("a set has no indices; test with `in`"),
            Type::Record(id) if self.program[id].is_tuple() => {
                problem.note("the parts of a tuple are `.0`, `.1` and so on")
            }
            _ => problem.note("it applies to lists and maps"),
        });
    }
}

/// The type of what is there, where an optional is expected.
fn there(expected: Option<&Type>) -> Option<&Type> {
    match expected {
        Some(Type::Optional(inner)) => Some(inner),
        _ => expected,
    }
}
