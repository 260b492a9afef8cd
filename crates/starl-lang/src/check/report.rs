//! How the checker reports problems: consequences of a reported error are not reported.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::asked;
use super::scope::Entity;
use super::state::Checker;
use crate::diagnostic::{Code, Diagnostic, Edit, Fix, Span, closest};
use crate::ir::{Expression, ExpressionKind, Operator, Type};

impl Checker {
    /// Reports a problem of the current file.
    pub fn report(&mut self, mut problem: Diagnostic) {
        let file = &mut self.files[self.file as usize];
        if problem.code == Code::MayBeNone && problem.fix.is_none() {
            let root = file.checked.parse.syntax();
            if let Some(asked) = asked::before(&root, &file.checked.source, problem.span) {
                let words = "this tests for none, but does not name the value";
                problem = problem.label(asked.span, words).fix(asked.fix);
            }
        }
        file.checked.diagnostics.push(problem);
    }

    /// Reports the problem of a whole expression.
    pub fn refuse(&mut self, problem: Diagnostic) -> Expression {
        let span = problem.span;
        self.report(problem);
        broken(span)
    }

    /// Reports a problem with a short message.
    pub fn error(&mut self, code: Code, span: Span, message: impl Into<String>) {
        self.report(Diagnostic::new(code, span, message));
    }

    /// Reports a second declaration of a name, such as the second of `actions`.
    pub fn duplicate(&mut self, what: &str, name: &str, span: Span, first: Span) {
        let message = format!("there are two {what} `{name}`");
        let problem = Diagnostic::new(Code::DuplicateName, span, message);
        self.report(problem.label(first, "the first one"));
    }

    /// A type as a person writes it.
    pub fn name_of(&self, of: &Type) -> String {
        self.program.type_name(of)
    }

    /// The meaning that a file gives to a name.
    pub fn declared(&self, file: u32, name: &str) -> Option<Entity> {
        let declared = self.files[file as usize].scope.get(name)?;
        Some(declared.entity)
    }

    /// The text of the present file at a place.
    pub fn text(&self, span: Span) -> &str {
        span.of(&self.files[self.file as usize].checked.source)
    }

    /// Whether the word occurs in a part of the file with syntax errors, so that it may be declared there.
    pub fn may_be_unread(&self, word: &str) -> bool {
        self.files[self.file as usize].unread.contains(word)
    }
}

/// An expression with an error that was reported.
pub(super) fn broken(span: Span) -> Expression {
    Expression {
        kind: ExpressionKind::Error,
        ty: Type::Error,
        span,
    }
}

/// An expression.
pub(super) fn made(kind: ExpressionKind, ty: Type, span: Span) -> Expression {
    Expression { kind, ty, span }
}

/// Adds the name that was probably meant as a fix.
pub(super) fn did_you_mean<'a>(
    problem: Diagnostic,
    span: Span,
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Diagnostic {
    match closest(word, candidates) {
        Some(meant) => problem.replace(format!("did you mean `{meant}`?"), span, meant),
        None => problem,
    }
}

/// A fix that puts text before and after a place.
pub(super) fn around(message: impl Into<String>, span: Span, before: &str, after: &str) -> Fix {
    let edits = [(span.start, before), (span.end, after)];
    Fix {
        message: message.into(),
        edits: (edits.into_iter())
            .filter(|(_, text)| !text.is_empty())
            .map(|(at, text)| Edit::new(Span::empty(at), text))
            .collect(),
    }
}

/// `one` or `many` by number: "1 argument", "2 arguments".
pub(super) fn counted(number: usize, one: &str) -> String {
    if number == 1 {
        format!("1 {one}")
    } else {
        format!("{number} {one}s")
    }
}

/// Words as code, joined by commas.
pub(super) fn listed<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("`{word}`")).collect();
    words.join(", ")
}

/// The name of a type with its article.
pub(super) fn article(name: &str) -> String {
    let article = if name.starts_with(['A', 'E', 'I', 'O', 'a', 'e', 'i', 'o']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {name}")
}

/// The type of a call that cannot stand where it does; one that gives nothing needs no second report.
pub(super) fn something(ty: Option<Type>) -> Type {
    ty.filter(|ty| *ty != Type::Nothing).unwrap_or(Type::Error)
}

/// Two expressions with an operator between them.
pub(super) fn joined(
    operator: Operator,
    left: Expression,
    right: Expression,
    ty: Type,
    span: Span,
) -> Expression {
    let kind = ExpressionKind::Binary {
        operator,
        left: Box::new(left),
        right: Box::new(right),
    };
    made(kind, ty, span)
}
